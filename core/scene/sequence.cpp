#include "core/scene/sequence.h"

#include <algorithm>
#include <cmath>

namespace focalstage {
namespace {

struct NumberPlace {
  std::size_t begin = 0;
  std::size_t digits = 0;
};

/// Of the last part of the path: a folder's # are its own.
NumberPlace number_place(const std::string& file) {
  const std::size_t slash = file.find_last_of('/');
  const std::size_t begin = file.find('#', slash == std::string::npos ? 0 : slash + 1);
  if (begin == std::string::npos) return {};
  const std::size_t end = std::min(file.find_first_not_of('#', begin), file.size());
  return {begin, end - begin};
}

/// Pictures since the start, as a whole number.
double pictures_passed(const ImageAppearance& image, double time_s) {
  constexpr double least_share = 1e-6;  // of a picture; rounding stays below it for 1e9 pictures
  const double passed = (time_s - image.start_s) * image.rate_hz;
  const double nearest = std::round(passed);
  return std::abs(passed - nearest) < least_share ? nearest : std::floor(passed);
}

}  // namespace

std::optional<int> picture_at(const ImageAppearance& image, double time_s) {
  if (image.count <= 0) return 0;
  const double passed = pictures_passed(image, time_s);
  const double count = image.count;
  if (!(passed >= 0.0)) return image.end == SequenceEnd::once ? std::nullopt : std::optional(0);
  if (passed < count) return static_cast<int>(passed);
  switch (image.end) {
    case SequenceEnd::once:
      return std::nullopt;
    case SequenceEnd::hold:
      return image.count - 1;
    case SequenceEnd::loop:
      return static_cast<int>(std::fmod(passed, count));
    case SequenceEnd::ping_pong:
      break;
  }
  if (image.count == 1) return 0;
  const double there_and_back = 2.0 * (count - 1.0);
  const double within = std::fmod(passed, there_and_back);
  return static_cast<int>(within < count ? within : there_and_back - within);
}

bool has_number_place(const std::string& file) {
  const NumberPlace place = number_place(file);
  return place.digits > 0 && file.find('#', place.begin + place.digits) == std::string::npos;
}

std::string picture_file(const ImageAppearance& image, int index) {
  if (image.count <= 0) return image.file;
  const NumberPlace place = number_place(image.file);
  std::string number = std::to_string(static_cast<long long>(image.first) + index);
  if (number.size() < place.digits) number.insert(0, place.digits - number.size(), '0');
  std::string file = image.file;
  return place.digits == 0 ? file : file.replace(place.begin, place.digits, number);
}

}  // namespace focalstage
