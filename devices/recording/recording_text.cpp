#include "devices/recording/recording_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

namespace focalstage {

namespace {

constexpr std::string_view first_line = "# focalstage tracking 1";
constexpr std::string_view columns =
    "frame,time_s,latency_s,arrival_s,id,name,tracked,x_m,y_m,z_m,qx,qy,qz,qw,mean_error_m";
constexpr std::size_t column_count = 15;
constexpr double unit_tolerance = 1e-3;  // of a quaternion's length: one written by hand has few digits

std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

/// A line break would end the row.
std::string on_one_line(std::string name) {
  for (char& c : name) c = c == '\n' || c == '\r' ? ' ' : c;
  return name;
}

using Row = std::vector<std::string>;

/// None where a quote is not closed.
std::optional<Row> row_of(std::string_view line) {
  Row row(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (inside && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      row.back() += line[++i];
    } else if (c == '"') {
      inside = !inside;
    } else if (c == ',' && !inside) {
      row.emplace_back();
    } else {
      row.back() += c;
    }
  }
  if (inside) return std::nullopt;
  return row;
}

template <class Number>
bool read(const std::string& text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

bool read_finite(const std::string& text, double& number) { return read(text, number) && std::isfinite(number); }

/// What a row says of its body, or why it says nothing.
std::string read_body(const Row& row, TrackedBody& body) {
  if (!read(row[4], body.id)) return "id is no whole number";
  body.name = row[5];
  if (row[6] != "0" && row[6] != "1") return "tracked is neither 0 nor 1";
  body.tracked = row[6] == "1";
  if (!body.tracked) return "";
  std::array<double, 8> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!read_finite(row[7 + i], numbers[i])) return "column " + std::to_string(8 + i) + " is no finite number";
  }
  const glm::dquat turn(numbers[6], numbers[3], numbers[4], numbers[5]);
  const double length = glm::length(turn);
  if (std::abs(length - 1.0) > unit_tolerance) return "qx to qw are no rotation: their squares do not add up to 1";
  body.tracker_from_body = {{numbers[0], numbers[1], numbers[2]},
                            std::abs(length - 1.0) > 1e-9 ? glm::normalize(turn) : turn};
  body.mean_error_m = numbers[7];
  return "";
}

std::string read_frame(const Row& row, TrackedFrame& frame) {
  if (!read(row[0], frame.number)) return "frame is no whole number";
  if (!read_finite(row[1], frame.time_s)) return "time_s is no finite number";
  double latency_s = 0.0;
  if (!row[2].empty() && (!read_finite(row[2], latency_s) || latency_s < 0.0)) return "latency_s is no finite number";
  if (!row[2].empty()) frame.latency_s = latency_s;
  if (!read_finite(row[3], frame.arrival_s)) return "arrival_s is no finite number";
  return "";
}

bool same_moment(const TrackedFrame& a, const TrackedFrame& b) {
  return a.number == b.number && a.time_s == b.time_s && a.arrival_s == b.arrival_s && a.latency_s == b.latency_s;
}

/// Takes a row in: a frame of its own, or one more body of the newest.
std::string add_row(const Row& row, TrackerRecording& recording) {
  if (row.size() != column_count) {
    return "it has " + std::to_string(row.size()) + " columns instead of " + std::to_string(column_count);
  }
  TrackedFrame frame;
  if (std::string reason = read_frame(row, frame); !reason.empty()) return reason;
  const bool goes_on = !recording.empty() && same_moment(recording.back(), frame);
  if (!goes_on) {
    if (!recording.empty() && frame.arrival_s < recording.back().arrival_s) return "arrival_s goes back";
    recording.push_back(std::move(frame));
  }
  if (row[4].empty()) return goes_on ? "a frame without bodies has one row" : "";
  TrackedBody body;
  if (std::string reason = read_body(row, body); !reason.empty()) return reason;
  recording.back().bodies.push_back(std::move(body));
  return "";
}

Fault bad_line(const std::string& name, int line, const std::string& reason) {
  return {"recording.format", name + ": line " + std::to_string(line), reason, "see docs/formats/tracking.md"};
}

bool next_line(std::istream& text, std::string& line) {
  if (!std::getline(text, line)) return false;
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

}  // namespace

std::string recording_head() { return std::string(first_line) + "\n" + std::string(columns) + "\n"; }

std::string recording_lines(const TrackedFrame& frame) {
  const std::string moment = std::to_string(frame.number) + "," + text_of(frame.time_s) + "," +
                             (frame.latency_s ? text_of(*frame.latency_s) : "") + "," + text_of(frame.arrival_s) + ",";
  if (frame.bodies.empty()) return moment + ",,,,,,,,,,\n";
  std::string lines;
  for (const TrackedBody& body : frame.bodies) {
    lines += moment + std::to_string(body.id) + "," + quoted(on_one_line(body.name)) + "," + (body.tracked ? "1" : "0");
    const Rigid& pose = body.tracker_from_body;
    for (const double value : {pose.position_m.x, pose.position_m.y, pose.position_m.z, pose.rotation.x,
                               pose.rotation.y, pose.rotation.z, pose.rotation.w, body.mean_error_m}) {
      lines += "," + (body.tracked ? text_of(value) : std::string());
    }
    lines += "\n";
  }
  return lines;
}

Result<TrackerRecording> read_recording(std::istream& text, const std::string& name) {
  std::string line;
  if (!next_line(text, line) || line != first_line) {
    return bad_line(name, 1, "a recording begins with " + std::string(first_line));
  }
  if (!next_line(text, line) || line != columns) return bad_line(name, 2, "the columns are " + std::string(columns));
  TrackerRecording recording;
  for (int number = 3; next_line(text, line); ++number) {
    const std::optional<Row> row = row_of(line);
    if (!row) return bad_line(name, number, "a quote is not closed");
    if (std::string reason = add_row(*row, recording); !reason.empty()) return bad_line(name, number, reason);
  }
  if (recording.empty()) return bad_line(name, 3, "it holds no frame");
  return recording;
}

Result<TrackerRecording> read_recording_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return Fault{"recording.unreadable", path, "the file can't be opened", "see that it exists and is readable"};
  return read_recording(file, path);
}

}  // namespace focalstage
