#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/number_words.h"
#include "io/study/report.h"
#include "io/study/report_words.h"

namespace focalstage {
namespace {

constexpr double width = 640.0;
constexpr double height = 520.0;
constexpr double left = 70.0;
constexpr double right = 20.0;
constexpr double top = 40.0;
constexpr double bottom = 60.0;

// The paper's two, and four more that a colour-blind reader can tell from them (Okabe and Ito).
constexpr std::array<const char*, 6> colors{"#d62728", "#1f77b4", "#009e73", "#e69f00", "#56b4e9", "#cc79a7"};

const char* color_of(int condition) { return colors[static_cast<std::size_t>(condition) % colors.size()]; }

std::string number(double value) { return fixed_text(value, 2); }

/// Both axes show the same range of distances, in metres.
struct Frame {
  double low_m = 0.0;
  double high_m = 1.0;
  double step_m = 0.1;

  double x(double m) const { return left + (m - low_m) / (high_m - low_m) * (width - left - right); }
  double y(double m) const { return height - bottom - (m - low_m) / (high_m - low_m) * (height - top - bottom); }
};

Frame frame_of(const StudyReport& report) {
  double low_m = report.answers.study.targets.front().actual_m;
  double high_m = low_m;
  const auto reach = [&](double m) {
    low_m = std::min(low_m, m);
    high_m = std::max(high_m, m);
  };
  for (const StudyTarget& target : report.answers.study.targets) reach(target.actual_m);
  for (const Response& response : report.answers.responses) {
    if (response.counts() && response.answered()) reach(response.response_m);
  }
  // Five to ten round steps: 1, 2 or 5 times a power of ten.
  const double span_m = std::max(high_m - low_m, 1e-3);
  double step_m = std::pow(10.0, std::floor(std::log10(span_m / 5.0)));
  for (const double factor : {5.0, 2.0}) {
    if (span_m / (step_m * factor) < 4.0) continue;
    step_m *= factor;
    break;
  }
  return {std::floor(low_m / step_m) * step_m, std::ceil(high_m / step_m) * step_m, step_m};
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" + number(y2) +
         "\" " + style + "/>\n";
}

std::string label(double x, double y, const std::string& anchor, const std::string& text,
                  const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\" " + more + ">" +
         escaped(text) + "</text>\n";
}

std::string axes(const Frame& frame) {
  std::string text;
  const int steps = static_cast<int>(std::lround((frame.high_m - frame.low_m) / frame.step_m));
  for (int k = 0; k <= steps; ++k) {
    const double at_m = frame.low_m + k * frame.step_m;
    const std::string grid = "stroke=\"#dddddd\"";
    text += line(frame.x(at_m), top, frame.x(at_m), height - bottom, grid);
    text += line(left, frame.y(at_m), width - right, frame.y(at_m), grid);
    text += label(frame.x(at_m), height - bottom + 18.0, "middle", mm_text(at_m, 0));
    text += label(left - 8.0, frame.y(at_m) + 4.0, "end", mm_text(at_m, 0));
  }
  text += label((left + width - right) / 2.0, height - 16.0, "middle", "actual distance (mm)");
  const double middle = (top + height - bottom) / 2.0;
  text +=
      label(18.0, middle, "middle", "estimated distance (mm)", "transform=\"rotate(-90 18 " + number(middle) + ")\"");
  return text + line(frame.x(frame.low_m), frame.y(frame.low_m), frame.x(frame.high_m), frame.y(frame.high_m),
                     "stroke=\"#888888\" stroke-dasharray=\"5 4\"");
}

std::string points(const StudyReport& report, const Frame& frame) {
  std::string text;
  const double conditions = static_cast<double>(report.answers.study.conditions.size());
  for (const Response& response : report.answers.responses) {
    if (!response.counts() || !response.answered()) continue;
    const double aside = (response.condition - (conditions - 1.0) / 2.0) * 6.0;
    text += "<circle cx=\"" + number(frame.x(response.actual_m) + aside) + "\" cy=\"" +
            number(frame.y(response.response_m)) + "\" r=\"2.5\" fill=\"" + color_of(response.condition) +
            "\" fill-opacity=\"0.45\"/>\n";
  }
  return text;
}

std::string lines(const StudyReport& report, const Frame& frame) {
  if (!report.analysis.regression) return {};
  std::string text;
  double low_m = report.answers.study.targets.front().actual_m;
  double high_m = low_m;
  for (const StudyTarget& target : report.answers.study.targets) {
    low_m = std::min(low_m, target.actual_m);
    high_m = std::max(high_m, target.actual_m);
  }
  for (const FittedLine& fit : report.analysis.regression->lines) {
    const auto y = [&](double x_m) { return frame.y(fit.slope * x_m + fit.intercept_m); };
    text += line(frame.x(low_m), y(low_m), frame.x(high_m), y(high_m),
                 std::string("class=\"fit\" stroke=\"") + color_of(fit.condition) + "\" stroke-width=\"2\"");
  }
  return text;
}

std::string legend(const StudyReport& report) {
  std::string text;
  double y = top + 18.0;
  const auto& regression = report.analysis.regression;
  for (int k = 0; k < static_cast<int>(report.answers.study.conditions.size()); ++k, y += 18.0) {
    std::string words = condition_name(report.answers.study, k);
    if (regression) {
      const FittedLine& fit = regression->lines[static_cast<std::size_t>(k)];
      words += ": y = " + fixed_text(fit.slope, 3) + " x " + (fit.intercept_m < 0.0 ? "- " : "+ ") +
               mm_text(std::abs(fit.intercept_m), 1) + " mm";
    }
    text += "<circle cx=\"" + number(left + 14.0) + "\" cy=\"" + number(y - 4.0) + "\" r=\"4\" fill=\"" + color_of(k) +
            "\"/>\n" + label(left + 24.0, y, "start", words);
  }
  return text;
}

}  // namespace

std::string report_svg(const StudyReport& report) {
  const Frame frame = frame_of(report);
  const std::string title = report.answers.study.name + (report.scripted() ? " - scripted, no human result" : "");
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + fixed_text(width, 0) + "\" height=\"" +
         fixed_text(height, 0) + "\" viewBox=\"0 0 " + fixed_text(width, 0) + " " + fixed_text(height, 0) +
         "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         label(width / 2.0, 22.0, "middle", title, "font-size=\"14\"") + axes(frame) + points(report, frame) +
         lines(report, frame) + legend(report) + "</svg>\n";
}

}  // namespace focalstage
