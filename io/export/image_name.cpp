#include "io/export/image_name.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace focalstage {
namespace {

std::string power_text(double power_d) {
  const double hundredths = std::round(power_d * 100.0);
  char text[64];
  std::snprintf(text, sizeof text, "%+.2fD", hundredths == 0.0 ? 0.0 : hundredths / 100.0);  // never -0.00
  return text;
}

}  // namespace

std::string name_of(ImageEye eye) {
  switch (eye) {
    case ImageEye::left:
      return "left";
    case ImageEye::right:
      return "right";
    case ImageEye::both:
      break;
  }
  return "both";
}

std::string name_of(ImageKind kind) {
  switch (kind) {
    case ImageKind::content:
      return "content";
    case ImageKind::surface_light:
      return "light";
    case ImageKind::content_and_light:
      break;
  }
  return "content+light";
}

std::vector<std::string> image_names(const std::vector<ImageSpec>& images) {
  std::vector<std::string> plain;
  for (const ImageSpec& image : images) plain.push_back(name_of(image.eye) + "-" + power_text(image.power_d));
  std::vector<std::string> names = plain;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::count(plain.begin(), plain.end(), plain[i]) > 1) names[i] += "-" + std::to_string(i);
  return names;
}

std::string image_file_name(int frame, int frames, const std::string& image_name) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames - 1).size());
  std::string number = std::to_string(frame);
  number.insert(0, digits - number.size(), '0');
  return "frame-" + number + "-" + image_name + ".png";
}

}  // namespace focalstage
