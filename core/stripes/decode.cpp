#include "core/stripes/decode.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/number_words.h"

namespace focalstage {

namespace {

constexpr int lit_codes = 12;  // white over black
constexpr int saturated_code = 254;
constexpr double least_swing = 4.0;     // codes
constexpr double clear_swing = 40.0;    // codes: nothing is gained by more
constexpr double cells_off = 1.0;       // stripes between code and sine beyond which a pixel is not believed
constexpr double least_share = 0.005;   // of the picture must be told
constexpr double most_jumps = 0.4;      // of the places where one bit alone changes
constexpr double least_agreeing = 0.6;  // of the lit pixels: code and sine
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

/// A sine through the steps at one pixel.
struct Wave {
  double phase = 0.0;  ///< 0 to 1
  double swing = 0.0;  ///< codes
  double middle = 0.0;
};

/// Cosines and sines of the steps.
struct Steps {
  std::vector<double> cosines;
  std::vector<double> sines;

  explicit Steps(int count) {
    for (int i = 0; i < count; ++i) {
      cosines.push_back(std::cos(2.0 * std::numbers::pi * i / count));
      sines.push_back(std::sin(2.0 * std::numbers::pi * i / count));
    }
  }
};

/// Light is middle + swing cos(2 pi (phase - step / steps)).
Wave wave_at(const CaptureView& view, PatternAxis axis, const Steps& steps, std::size_t i) {
  double along = 0.0;
  double across = 0.0;
  double sum = 0.0;
  const int count = view.set().steps;
  for (int step = 0; step < count; ++step) {
    const double code = view.sine(axis, step).gray[i];
    along += code * steps.cosines[static_cast<std::size_t>(step)];
    across += code * steps.sines[static_cast<std::size_t>(step)];
    sum += code;
  }
  double phase = std::atan2(across, along) / (2.0 * std::numbers::pi);
  if (phase < 0.0) phase += 1.0;
  return {phase, 2.0 / count * std::hypot(along, across), sum / count};
}

/// The stripes' numbers in Gray code, per pixel; all bits by which of a pattern and its inverse is brighter.
std::vector<std::uint32_t> gray_codes(const CaptureView& view, PatternAxis axis) {
  const int bits = view.bits(axis);
  std::vector<std::uint32_t> codes(view.size(), 0);
  for (int bit = 0; bit < bits; ++bit) {
    const auto& code = view.code(axis, bit, false).gray;
    const auto& inverse = view.code(axis, bit, true).gray;
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = (codes[i] << 1) | (code[i] > inverse[i] ? 1U : 0U);
  }
  return codes;
}

std::uint32_t binary(std::uint32_t gray) {
  for (std::uint32_t shift = 1; shift < 32; shift <<= 1) gray ^= gray >> shift;
  return gray;
}

std::vector<std::uint8_t> lit(const CaptureView& view) {
  std::vector<std::uint8_t> where(view.size(), 0);
  const auto& white = view.white().gray;
  const auto& black = view.black().gray;
  for (std::size_t i = 0; i < where.size(); ++i) {
    where[i] = white[i] - black[i] >= lit_codes && white[i] < saturated_code ? 1 : 0;
  }
  return where;
}

/// Of the neighbours that differ in one bit alone, the share whose stripes are no neighbours: per bit, the coarsest
/// first. In Gray code it is nearly none. None where a bit changes too seldom to tell.
std::vector<std::optional<double>> jumps(const CaptureView& view, const std::vector<std::uint32_t>& gray,
                                         const std::vector<std::uint8_t>& where, int bits) {
  std::vector<double> changes(static_cast<std::size_t>(bits), 0.0);
  std::vector<double> far(static_cast<std::size_t>(bits), 0.0);
  const auto width = static_cast<std::size_t>(view.width_px());
  const auto look = [&](std::size_t i, std::size_t k) {
    if (!where[i] || !where[k]) return;
    const std::uint32_t differs = gray[i] ^ gray[k];
    if (differs == 0 || (differs & (differs - 1)) != 0) return;
    std::size_t bit = static_cast<std::size_t>(bits) - 1;
    for (std::uint32_t d = differs; d > 1; d >>= 1) --bit;
    changes[bit] += 1.0;
    const auto apart = static_cast<std::int64_t>(binary(gray[i])) - static_cast<std::int64_t>(binary(gray[k]));
    if (std::abs(apart) > 1) far[bit] += 1.0;
  };
  for (std::size_t i = 0; i + width < gray.size(); ++i) {
    if ((i + 1) % width != 0) look(i, i + 1);
    look(i, i + width);
  }
  std::vector<std::optional<double>> shares;
  for (std::size_t bit = 0; bit < changes.size(); ++bit) {
    shares.push_back(changes[bit] < 20.0 ? std::nullopt : std::optional(far[bit] / changes[bit]));
  }
  return shares;
}

Fault out_of_order(const std::string& names, const std::string& message) {
  return {"capture.order", names, message, "see that the pictures are in the order of the patterns"};
}

std::string axis_word(PatternAxis axis) { return axis == PatternAxis::columns ? "columns" : "rows"; }

/// Patterns exchanged whole with their inverses.
Status check_codes(const CaptureView& view, PatternAxis axis, const std::vector<std::uint32_t>& gray,
                   const std::vector<std::uint8_t>& where) {
  const auto shares = jumps(view, gray, where, view.bits(axis));
  std::string names;
  for (std::size_t bit = 0; bit < shares.size(); ++bit) {
    if (!shares[bit] || *shares[bit] <= most_jumps) continue;
    names += (names.empty() ? "" : ", ") + view.code(axis, static_cast<int>(bit), false).name;
  }
  if (names.empty()) return {};
  return out_of_order(names, "these patterns are not where they belong among those of the " + axis_word(axis));
}

/// How far each step of a sine lies from the sine through all of them, over the swing.
std::vector<double> step_errors(const CaptureView& view, PatternAxis axis, const std::vector<std::uint8_t>& where,
                                const Steps& steps) {
  const auto count = static_cast<std::size_t>(view.set().steps);
  std::vector<double> squares(count, 0.0);
  double swings = 0.0;
  for (std::size_t i = 0; i < where.size(); i += 7) {
    if (!where[i]) continue;
    const Wave wave = wave_at(view, axis, steps, i);
    swings += wave.swing * wave.swing;
    for (std::size_t step = 0; step < count; ++step) {
      const double turn =
          2.0 * std::numbers::pi * (wave.phase - static_cast<double>(step) / static_cast<double>(count));
      const double off = view.sine(axis, static_cast<int>(step)).gray[i] - wave.middle - wave.swing * std::cos(turn);
      squares[step] += off * off;
    }
  }
  for (double& square : squares) square = std::sqrt(square / std::max(swings, 1.0));
  return squares;
}

Status check_steps(const CaptureView& view, PatternAxis axis, const std::vector<std::uint8_t>& where,
                   const Steps& steps) {
  const std::vector<double> errors = step_errors(view, axis, where, steps);
  std::vector<double> sorted = errors;
  std::ranges::sort(sorted);
  const double usual = sorted[sorted.size() / 4];
  std::string names;
  for (std::size_t step = 0; step < errors.size(); ++step) {
    if (errors[step] < 0.25 || errors[step] < 2.0 * usual) continue;
    names += (names.empty() ? "" : ", ") + view.sine(axis, static_cast<int>(step)).name;
  }
  if (names.empty()) return {};
  return out_of_order(names, "these steps do not lie on the sine of the others");
}

struct Places {
  std::vector<float> at;
  std::vector<float> confidence;
  double agreeing = 0.0;  ///< of the pixels that swing
};

Places places_along(const CaptureView& view, PatternAxis axis, const std::vector<std::uint32_t>& gray,
                    const std::vector<std::uint8_t>& where, const Steps& steps) {
  const PatternSet& set = view.set();
  const int length = axis == PatternAxis::columns ? set.width_px : set.height_px;
  Places places{std::vector<float>(where.size(), nothing), std::vector<float>(where.size(), 0.0F), 0.0};
  double swinging = 0.0;
  for (std::size_t i = 0; i < where.size(); ++i) {
    if (!where[i]) continue;
    const Wave wave = wave_at(view, axis, steps, i);
    if (wave.swing < least_swing) continue;
    swinging += 1.0;
    const double coarse = (binary(gray[i]) + 0.5) * set.stripe_px;
    const double fine = wave.phase * set.period_px;
    const double at = fine + set.period_px * std::round((coarse - fine) / set.period_px);
    if (std::abs(at - coarse) > cells_off * set.stripe_px || at < 0.0 || at > length) continue;
    places.agreeing += 1.0;
    places.at[i] = static_cast<float>(at);
    places.confidence[i] = static_cast<float>(std::min(1.0, wave.swing / clear_swing));
  }
  if (swinging > 0.0) places.agreeing /= swinging;
  return places;
}

Result<Places> decode_axis(const CaptureView& view, PatternAxis axis, const std::vector<std::uint8_t>& where) {
  const Steps steps(view.set().steps);
  const std::vector<std::uint32_t> gray = gray_codes(view, axis);
  if (Status good = check_codes(view, axis, gray, where); !good) return good.fault();
  if (Status good = check_steps(view, axis, where, steps); !good) return good.fault();
  Places places = places_along(view, axis, gray, where, steps);
  if (places.agreeing >= least_agreeing) return places;
  return out_of_order(view.code(axis, 0, false).name + " to " + view.sine(axis, view.set().steps - 1).name,
                      "code and sine of the " + axis_word(axis) + " agree in " +
                          fixed_text(100.0 * places.agreeing, 0) + " % of what is lit alone");
}

}  // namespace

Result<DecodedCapture> decode_capture(const PatternSet& set, const Capture& capture) {
  if (Status good = check_capture(set, capture); !good) return good.fault();
  const CaptureView view(set, capture);
  const std::vector<std::uint8_t> where = lit(view);
  auto columns = decode_axis(view, PatternAxis::columns, where);
  if (!columns) return columns.fault();
  auto rows = decode_axis(view, PatternAxis::rows, where);
  if (!rows) return rows.fault();
  DecodedCapture decoded{view.width_px(),
                         view.height_px(),
                         std::move(columns->at),
                         std::move(rows->at),
                         std::move(columns->confidence),
                         0.0};
  double told = 0.0;
  for (std::size_t i = 0; i < where.size(); ++i) {
    decoded.confidence[i] = std::min(decoded.confidence[i], rows->confidence[i]);
    const bool both = std::isfinite(decoded.u[i]) && std::isfinite(decoded.v[i]);
    if (!both) {
      decoded.u[i] = decoded.v[i] = nothing;
      decoded.confidence[i] = 0.0F;
    }
    told += both ? 1.0 : 0.0;
  }
  decoded.share = told / static_cast<double>(where.size());
  if (decoded.share >= least_share) return decoded;
  return Fault{"capture.undecoded", view.white().name,
               "in " + fixed_text(100.0 * decoded.share, 2) + " % of the picture alone a place is told",
               "focus camera and projector, go nearer, or make wider stripes"};
}

}  // namespace focalstage
