#include <algorithm>
#include <cmath>

#include "core/base/number_words.h"
#include "core/stripes/capture.h"
#include "core/stripes/picture_shift.h"

namespace focalstage {

namespace {

constexpr int lit_codes = 12;            // white over black: the projector is seen
constexpr int saturated_code = 254;      // as bright as can be
constexpr double most_saturated = 0.05;  // of what is lit
constexpr double least_lit = 0.02;       // of the picture
constexpr double far_off = 0.6;          // of white over black: no part of a stripe's edge, whatever the camera's gamma
constexpr double most_far_off = 0.12;    // of what is lit
constexpr double decided = 0.7;          // of white over black: a stripe's inside
constexpr int coarse_px = 16;            // stripes whose insides are wide enough to be compared with white
constexpr double most_moved_px = 0.15;
constexpr double sure = 6.0;              // standard deviations
constexpr double most_brighter = 0.1;     // or darker
constexpr double most_unexplained = 0.5;  // of the picture's own spread: it is no picture of the same

Fault fault(const char* code, const std::string& where, const std::string& message, const std::string& remedy) {
  return {code, where, message, remedy};
}

std::string size_text(const CameraPicture& p) {
  return std::to_string(p.width_px) + " x " + std::to_string(p.height_px);
}

Status check_count(const std::vector<Pattern>& patterns, const Capture& capture) {
  if (capture.size() == patterns.size()) return {};
  return fault("capture.missing", "pictures",
               "there are " + std::to_string(capture.size()) + ", one for each of " + std::to_string(patterns.size()) +
                   " patterns is wanted",
               "capture all patterns again, one picture for each");
}

Status check_sizes(const Capture& capture) {
  const CameraPicture& first = capture[0];
  for (const CameraPicture& picture : capture) {
    const auto pixels = static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
    if (picture.width_px < 16 || picture.height_px < 16 || picture.gray.size() != pixels) {
      return fault("capture.size", picture.name, "is no picture of 16 pixels a side or more", "capture again");
    }
    if (picture.width_px == first.width_px && picture.height_px == first.height_px) continue;
    const bool turned = picture.width_px == first.height_px && picture.height_px == first.width_px;
    return fault("capture.size", picture.name,
                 "is " + size_text(picture) + ", " + first.name + " is " + size_text(first) +
                     (turned ? ": it is turned by a quarter" : ""),
                 "keep the camera's settings and orientation over all pictures");
  }
  return {};
}

/// What the projector lights: white over black, and not as bright as can be.
struct Lit {
  std::vector<std::uint8_t> where;
  double share = 0.0;
  double saturated = 0.0;
  double reversed = 0.0;
};

Lit lit_by(const CameraPicture& white, const CameraPicture& black) {
  Lit lit;
  lit.where.resize(white.gray.size());
  for (std::size_t i = 0; i < white.gray.size(); ++i) {
    const int light = white.gray[i] - black.gray[i];
    if (-light >= lit_codes) lit.reversed += 1.0;
    if (light < lit_codes && white.gray[i] < saturated_code) continue;
    lit.share += 1.0;
    if (white.gray[i] >= saturated_code) {
      lit.saturated += 1.0;
    } else {
      lit.where[i] = 1;
    }
  }
  const auto pixels = static_cast<double>(white.gray.size());
  if (lit.share > 0.0) lit.saturated /= lit.share;
  lit.share /= pixels;
  lit.reversed /= pixels;
  return lit;
}

Status check_exposure(const Lit& lit, const CameraPicture& white, const CameraPicture& black) {
  if (lit.reversed > least_lit && lit.reversed > lit.share) {
    return fault("capture.order", white.name + ", " + black.name, "black is brighter than white: they are exchanged",
                 "see that the pictures are in the order of the patterns");
  }
  if (lit.share < least_lit) {
    return fault(
        "capture.dark", white.name,
        "white is brighter than black by 12 codes in " + fixed_text(100.0 * lit.share, 1) + " % of the picture alone",
        "expose longer, darken the room, and see that the camera sees what the projector lights");
  }
  if (lit.saturated <= most_saturated) return {};
  return fault("capture.over-exposed", white.name,
               fixed_text(100.0 * lit.saturated, 0) + " % of what is lit is as bright as can be",
               "expose shorter, all pictures alike");
}

std::vector<float> floats(const std::vector<std::uint8_t>& gray) { return {gray.begin(), gray.end()}; }

std::vector<std::uint8_t> upside_down(const std::vector<std::uint8_t>& gray) { return {gray.rbegin(), gray.rend()}; }

/// The share of what is lit in which a pattern and its inverse are both bright, or both dark.
double both_alike(const std::vector<std::uint8_t>& code, const std::vector<std::uint8_t>& inverse,
                  const CaptureView& view, const Lit& lit) {
  const auto& white = view.white().gray;
  const auto& black = view.black().gray;
  double alike = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < white.size(); ++i) {
    if (!lit.where[i]) continue;
    all += 1.0;
    const int off = code[i] + inverse[i] - white[i] - black[i];
    if (std::abs(off) > far_off * (white[i] - black[i])) alike += 1.0;
  }
  return all > 0.0 ? alike / all : 0.0;
}

PictureShift white_again(const CaptureView& view, const Lit& lit) {
  return picture_shift(floats(view.white().gray), floats(view.white(true).gray), lit.where, view.width_px(),
                       view.height_px());
}

Fault moved(const CaptureView& view, const std::string& from, const std::string& how_far) {
  return fault("capture.moved", from,
               "camera, projector or what they see has moved since " + view.white().name + ", by " + how_far,
               "fix all of them, and capture again");
}

bool has_moved(const PictureShift& shift) {
  return shift.moved_px > most_moved_px + sure * shift.doubt_px || shift.unexplained > most_unexplained;
}

/// Where a pattern stands without its own inverse: the pair to blame, or both where two are.
Status check_inverses(const CaptureView& view, const Lit& lit) {
  std::string names;
  int wrong = 0;
  for (const PatternAxis axis : {PatternAxis::columns, PatternAxis::rows}) {
    for (int bit = 0; bit < view.bits(axis); ++bit) {
      const CameraPicture& code = view.code(axis, bit, false);
      const CameraPicture& inverse = view.code(axis, bit, true);
      if (both_alike(code.gray, inverse.gray, view, lit) <= most_far_off) continue;
      for (const auto& [one, other] : {std::pair(&code, &inverse), std::pair(&inverse, &code)}) {
        if (both_alike(upside_down(one->gray), other->gray, view, lit) > most_far_off) continue;
        return fault("capture.turned", one->name, "it is upside down", "turn it as the others are");
      }
      if (has_moved(white_again(view, lit))) return {};  // check_moved says from where on
      names += (names.empty() ? "" : ", ") + code.name + ", " + inverse.name;
      ++wrong;
    }
  }
  if (wrong == 0) return {};
  return fault("capture.order", names,
               wrong == 1 ? "the one is not the other's inverse" : "these are not each other's inverses",
               "see that the pictures are in the order of the patterns, and none is there twice");
}

struct Compared {
  const CameraPicture* picture = nullptr;
  std::vector<float> brightness;
  std::vector<std::uint8_t> where;
};

/// What white looks like in a pattern and its inverse: the brighter of both, inside of stripes.
Compared white_in_code(const CaptureView& view, const Lit& lit, PatternAxis axis, int bit) {
  const auto& code = view.code(axis, bit, false).gray;
  const auto& inverse = view.code(axis, bit, true).gray;
  const auto& white = view.white().gray;
  const auto& black = view.black().gray;
  Compared made{&view.code(axis, bit, false), std::vector<float>(white.size()), lit.where};
  for (std::size_t i = 0; i < white.size(); ++i) {
    made.brightness[i] = static_cast<float>(std::max(code[i], inverse[i]));
    if (std::abs(code[i] - inverse[i]) < decided * (white[i] - black[i])) made.where[i] = 0;
  }
  return made;
}

/// The mean of a sine's steps: white at half its light, but for the camera's gamma.
Compared white_in_sine(const CaptureView& view, const Lit& lit, PatternAxis axis) {
  Compared made{&view.sine(axis, 0), std::vector<float>(lit.where.size(), 0.0F), lit.where};
  for (int step = 0; step < view.set().steps; ++step) {
    const auto& gray = view.sine(axis, step).gray;
    for (std::size_t i = 0; i < gray.size(); ++i) made.brightness[i] += gray[i] / static_cast<float>(view.set().steps);
  }
  return made;
}

std::vector<Compared> compared_with_white(const CaptureView& view, const Lit& lit) {
  std::vector<Compared> all;
  for (const PatternAxis axis : {PatternAxis::columns, PatternAxis::rows}) {
    for (int bit = 0; bit < view.bits(axis); ++bit) {
      const int stripe_px = view.set().stripe_px << (view.bits(axis) - 1 - bit);
      if (stripe_px >= coarse_px) all.push_back(white_in_code(view, lit, axis, bit));
    }
    all.push_back(white_in_sine(view, lit, axis));
  }
  all.push_back({&view.white(true), floats(view.white(true).gray), lit.where});
  return all;
}

/// Whether white is white again.
Status check_again(const CaptureView& view, const Lit& lit) {
  const PictureShift white = white_again(view, lit);
  if (white.unexplained > most_unexplained) {
    const PictureShift turned = picture_shift(floats(view.white().gray), floats(upside_down(view.white(true).gray)),
                                              lit.where, view.width_px(), view.height_px());
    if (turned.unexplained < most_unexplained) {
      return fault("capture.turned", view.white(true).name, "it is upside down beside " + view.white().name,
                   "turn all pictures alike");
    }
    return {};
  }
  if (has_moved(white) || std::abs(white.gain - 1.0) <= most_brighter) return {};
  return fault("capture.light", view.white(true).name,
               "it is " + signed_text(100.0 * (white.gain - 1.0), 0) + " % brighter than " + view.white().name,
               "switch off automatic exposure and what flickers, and let the projector warm up");
}

/// `far`: so far that it is another picture.
Status check_moved(const CaptureView& view, const Lit& lit, bool far) {
  const std::vector<float> white = floats(view.white().gray);
  for (const Compared& one : compared_with_white(view, lit)) {
    const PictureShift shift = picture_shift(white, one.brightness, one.where, view.width_px(), view.height_px());
    if (!far && shift.moved_px <= most_moved_px + sure * shift.doubt_px) continue;
    if (far && shift.unexplained <= most_unexplained) continue;
    return moved(view, one.picture->name, far ? "far" : "about " + fixed_text(shift.moved_px, 2) + " px");
  }
  return {};
}

}  // namespace

Status check_capture(const PatternSet& set, const Capture& capture) {
  if (Status good = check_set(set); !good) return good;
  if (Status good = check_count(patterns_of(set), capture); !good) return good;
  if (Status good = check_sizes(capture); !good) return good;
  const CaptureView view(set, capture);
  const Lit lit = lit_by(view.white(), view.black());
  if (Status good = check_exposure(lit, view.white(), view.black()); !good) return good;
  const Lit again = lit_by(view.white(true), view.black(true));
  if (Status good = check_exposure(again, view.white(true), view.black(true)); !good) return good;
  if (Status good = check_again(view, lit); !good) return good;
  if (Status good = check_inverses(view, lit); !good) return good;
  if (Status good = check_moved(view, lit, false); !good) return good;
  return check_moved(view, lit, true);
}

}  // namespace focalstage
