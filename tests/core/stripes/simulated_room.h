#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/stripes/capture.h"
#include "tests/core/calibrate/own_optics.h"

// A room that a projector lights and a camera photographs: rays, shadows, texture, the room's own light, the camera's
// gamma, noise and 8 bits. It shares nothing with what is tested but the pictures.
namespace own {

struct Hit {
  double way = 0.0;  ///< lengths of the ray
  Vector normal{};   ///< unit
  double albedo = 0.0;
};

/// What a ray from a place meets, if anything.
using Thing = std::function<std::optional<Hit>(const Vector& from, const Vector& along)>;

/// How much light a place gives back, 0..1; none where the thing ends.
using Paint = std::function<std::optional<double>(double x, double y)>;

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Flat, in the plane of two unit axes through a corner.
inline Thing sheet(const Vector& corner, const Vector& right, const Vector& up, Paint paint) {
  const Vector normal = cross(right, up);
  return [=](const Vector& from, const Vector& along) -> std::optional<Hit> {
    const double towards = dot(along, normal);
    if (std::abs(towards) < 1e-12) return std::nullopt;
    const double way = dot(minus(corner, from), normal) / towards;
    if (!(way > 0.0)) return std::nullopt;
    const Vector at = minus(plus(from, scaled(along, way)), corner);
    const auto albedo = paint(dot(at, right), dot(at, up));
    if (!albedo) return std::nullopt;
    return Hit{way, normal, *albedo};
  };
}

inline Thing sheet(const Vector& corner, const Matrix& world_from_sheet, Paint paint) {
  return sheet(corner, times(world_from_sheet, Vector{1, 0, 0}), times(world_from_sheet, Vector{0, 1, 0}),
               std::move(paint));
}

/// A wall that swells and falls gently about z = depth: the ray meets it again and again at the height of the last
/// place.
inline Thing wavy_wall(double depth, double swell, Paint paint) {
  const auto height = [=](double x, double y) { return depth + swell * std::sin(5.0 * x) * std::cos(4.0 * y + 0.5); };
  return [=](const Vector& from, const Vector& along) -> std::optional<Hit> {
    if (along[2] == 0.0) return std::nullopt;
    double near = (depth - from[2]) / along[2];
    Vector p{};
    for (int i = 0; i < 60; ++i) {
      p = plus(from, scaled(along, near));
      const double next = (height(p[0], p[1]) - from[2]) / along[2];
      const bool settled = std::abs(next - near) < 1e-12;
      near = next;
      if (settled) break;
    }
    if (!(near > 0.0)) return std::nullopt;
    const auto albedo = paint(p[0], p[1]);
    if (!albedo) return std::nullopt;
    const double dx = 5.0 * swell * std::cos(5.0 * p[0]) * std::cos(4.0 * p[1] + 0.5);
    const double dy = -4.0 * swell * std::sin(5.0 * p[0]) * std::sin(4.0 * p[1] + 0.5);
    const Vector normal{-dx, -dy, 1.0};
    return Hit{near, scaled(normal, 1.0 / length(normal)), *albedo};
  };
}

inline std::optional<Hit> first_hit(const std::vector<Thing>& things, const Vector& from, const Vector& along) {
  std::optional<Hit> nearest;
  for (const Thing& thing : things) {
    const auto hit = thing(from, along);
    if (hit && (!nearest || hit->way < nearest->way)) nearest = hit;
  }
  return nearest;
}

struct Shot {
  double exposure = 1.0;  ///< code 1 for a white sheet square to the projector, a metre away
  double ambient = 0.05;  ///< light of the room, of that
  double gamma = 2.2;     ///< code = light^(1 / gamma)
  double noise = 1.2;     ///< standard deviation in codes of 8 bits
  int samples = 2;        ///< along each side of a pixel
};

/// Directions of a lens: exact at the pixels' corners, even between.
class Looks {
 public:
  explicit Looks(const Lens& lens) : width_(lens.width) {
    for (int y = 0; y <= lens.height; ++y) {
      for (int x = 0; x <= lens.width; ++x) corners_.push_back(lens.look(x, y));
    }
  }

  Vector along(double x, double y) const {
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    const double s = x - static_cast<double>(column);
    const double t = y - static_cast<double>(row);
    const auto first = row * static_cast<std::size_t>(width_ + 1) + column;
    const auto below = first + static_cast<std::size_t>(width_ + 1);
    Vector out{};
    for (std::size_t i = 0; i < 3; ++i) {
      out[i] = (1 - t) * ((1 - s) * corners_[first][i] + s * corners_[first + 1][i]) +
               t * ((1 - s) * corners_[below][i] + s * corners_[below + 1][i]);
    }
    return out;
  }

 private:
  int width_;
  std::vector<Vector> corners_;
};

/// A camera before a room, ready to photograph whatever the projector shows.
class Photographer {
 public:
  Photographer(const std::vector<Thing>& things, const Lens& projector, const Lens& camera, const Shot& shot,
               std::uint32_t seed = 1)
      : camera_(camera), shot_(shot) {
    std::mt19937 dice(seed);
    std::normal_distribution<float> error(0.0F, static_cast<float>(shot.noise));
    for (float& one : noise_) one = error(dice);
    at_ = dice() % noise_.size();
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      curve_[i] = static_cast<float>(255.0 * std::pow((static_cast<double>(i) + 0.5) / 65536.0, 1.0 / shot.gamma));
    }
    const int n = shot.samples;
    const Looks looks(camera);
    for (int i = 0; i < camera.width * camera.height; ++i) {
      first_.push_back(static_cast<std::uint32_t>(samples_.size()));
      const auto at = [&](int k) {
        return sample(things, projector,
                      looks.along(i % camera.width + (k % n + 0.5) / n, i / camera.width + (k / n + 0.5) / n));
      };
      // One kind of paint, lit in all corners or in none: its middle says it all. (Where n is even the middle is none
      // of them.)
      const Sample middle = at(n * n / 2);
      bool even = n % 2 == 1;
      for (const int corner : {0, n - 1, n * n - n, n * n - 1}) {
        if (!even) break;
        const Sample other = at(corner);
        even = other.ambient == middle.ambient && (other.direct > 0.0F) == (middle.direct > 0.0F);
      }
      for (int k = 0; k < (even ? 1 : n * n); ++k) samples_.push_back(even ? middle : at(k));
    }
    first_.push_back(static_cast<std::uint32_t>(samples_.size()));
  }

  /// A picture of which all rows (or all columns) are alike, as `codes` runs along the axis; light is code^gamma.
  focalstage::CameraPicture picture(const std::vector<std::uint8_t>& codes, focalstage::PatternAxis axis, double gamma,
                                    std::string name) {
    std::vector<float> light;
    for (const std::uint8_t code : codes) light.push_back(static_cast<float>(std::pow(code / 255.0, gamma)));
    light.push_back(light.back());
    const bool columns = axis == focalstage::PatternAxis::columns;
    focalstage::CameraPicture picture{std::move(name), camera_.width, camera_.height, {}};
    picture.gray.reserve(first_.size() - 1);
    for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
      float sum = 0.0F;
      for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
        const Sample& s = samples_[k];
        // Between pixels' middles the light passes over evenly: a pixel soft.
        const float at = columns ? s.u : s.v;
        const auto left = static_cast<std::size_t>(at);
        const float lit = light[left] + (at - static_cast<float>(left)) * (light[left + 1] - light[left]);
        sum += s.ambient + s.direct * lit;
      }
      const float whole = std::min(1.0F, sum / static_cast<float>(first_[i + 1] - first_[i]));
      const float code = curve_[static_cast<std::size_t>(whole * 65535.0F)] + next_noise();
      picture.gray.push_back(static_cast<std::uint8_t>(std::clamp(code + 0.5F, 0.0F, 255.0F)));
    }
    return picture;
  }

  /// All patterns of a set.
  focalstage::Capture capture(const focalstage::PatternSet& set) {
    focalstage::Capture all;
    for (const focalstage::Pattern& pattern : focalstage::patterns_of(set)) all.push_back(photo(set, pattern));
    return all;
  }

  focalstage::CameraPicture photo(const focalstage::PatternSet& set, const focalstage::Pattern& pattern) {
    const auto codes = focalstage::picture_of(set, pattern);
    const auto width = static_cast<std::size_t>(set.width_px);
    std::vector<std::uint8_t> line(codes.begin(), codes.begin() + set.width_px);
    if (pattern.axis == focalstage::PatternAxis::rows) {
      line.clear();
      for (std::size_t i = 0; i < codes.size(); i += width) line.push_back(codes[i]);
    }
    return picture(line, pattern.axis, set.gamma, focalstage::name_of(pattern));
  }

 private:
  struct Sample {
    float u = 0.0F;  // in pixels' middles
    float v = 0.0F;
    float direct = 0.0F;
    float ambient = 0.0F;
  };

  Sample sample(const std::vector<Thing>& things, const Lens& projector, const Vector& along) const {
    Sample made;
    const auto hit = first_hit(things, camera_.at, along);
    if (!hit) return made;
    made.ambient = static_cast<float>(shot_.exposure * shot_.ambient * hit->albedo);
    const Vector at = plus(camera_.at, scaled(along, hit->way));
    const auto pixel = projector.pixel(at);
    if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x > projector.width || pixel->y > projector.height)
      return made;
    const Vector to_light = minus(projector.at, at);
    const auto shadow = first_hit(things, plus(at, scaled(to_light, 1e-4)), to_light);
    if (shadow && shadow->way < 1.0) return made;
    const double distance = length(to_light);
    const double slant = std::abs(dot(hit->normal, to_light)) / distance;
    made.direct = static_cast<float>(shot_.exposure * hit->albedo * slant / (distance * distance));
    made.u = static_cast<float>(std::clamp(pixel->x - 0.5, 0.0, projector.width - 1.0));
    made.v = static_cast<float>(std::clamp(pixel->y - 0.5, 0.0, projector.height - 1.0));
    return made;
  }

  float next_noise() {
    at_ = (at_ + 1) % noise_.size();
    return noise_[at_];
  }

  Lens camera_;
  Shot shot_;
  std::vector<std::uint32_t> first_;  // of the samples of each pixel, and one past the last
  std::vector<Sample> samples_;
  std::vector<float> curve_ = std::vector<float>(65536);
  std::vector<float> noise_ = std::vector<float>(1'000'003);
  std::size_t at_ = 0;
};

/// Blotches and lines that no picture may be mistaken by.
inline double texture(double x, double y) {
  const double blotches =
      0.5 + 0.25 * std::sin(23.0 * x + 3.0 * std::sin(9.0 * y)) + 0.2 * std::sin(31.0 * y + 11.0 * x);
  const bool line = std::fmod(std::abs(x + 0.37 * y), 0.11) < 0.008;
  return std::clamp(line ? 0.25 : 0.35 + 0.6 * blotches, 0.05, 0.95);
}

inline Paint textured(double width, double height) {
  return [=](double x, double y) -> std::optional<double> {
    if (x < 0.0 || y < 0.0 || x > width || y > height) return std::nullopt;
    return texture(x, y);
  };
}

}  // namespace own
