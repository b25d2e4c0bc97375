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

/// A wall that swells and falls about z = depth, found by halving.
inline Thing wavy_wall(double depth, double swell, Paint paint) {
  const auto height = [=](double x, double y) { return depth + swell * std::sin(5.0 * x) * std::cos(4.0 * y + 0.5); };
  return [=](const Vector& from, const Vector& along) -> std::optional<Hit> {
    if (along[2] >= 0.0) return std::nullopt;
    const auto off = [&](double way) {
      const Vector p = plus(from, scaled(along, way));
      return p[2] - height(p[0], p[1]);
    };
    double near = (depth + swell - from[2]) / along[2];
    double far = (depth - swell - from[2]) / along[2];
    if (near < 0.0) return std::nullopt;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (near + far);
      (off(middle) > 0.0 ? near : far) = middle;
    }
    const Vector p = plus(from, scaled(along, near));
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

/// A camera before a room, ready to photograph whatever the projector shows.
class Photographer {
 public:
  Photographer(const std::vector<Thing>& things, const Lens& projector, const Lens& camera, const Shot& shot,
               std::uint32_t seed = 1)
      : camera_(camera), shot_(shot), projector_width_(projector.width), projector_height_(projector.height) {
    std::mt19937 dice(seed);
    std::normal_distribution<float> error(0.0F, static_cast<float>(shot.noise));
    for (float& one : noise_) one = error(dice);
    at_ = dice() % noise_.size();
    const int n = shot.samples;
    for (int y = 0; y < camera.height * n; ++y) {
      for (int x = 0; x < camera.width * n; ++x) {
        samples_.push_back(sample(things, projector, (x + 0.5) / n, (y + 0.5) / n));
      }
    }
  }

  /// `codes` as the projector gets them, whose light is code^gamma.
  focalstage::CameraPicture picture(const std::vector<std::uint8_t>& codes, double gamma, std::string name) {
    std::array<float, 256> light{};
    for (std::size_t i = 0; i < light.size(); ++i) {
      light[i] = static_cast<float>(std::pow(static_cast<double>(i) / 255.0, gamma));
    }
    focalstage::CameraPicture picture{std::move(name), camera_.width, camera_.height, {}};
    const auto n = static_cast<std::size_t>(shot_.samples);
    const auto row = static_cast<std::size_t>(camera_.width) * n;
    for (std::size_t y = 0; y < static_cast<std::size_t>(camera_.height); ++y) {
      for (std::size_t x = 0; x < static_cast<std::size_t>(camera_.width); ++x) {
        float sum = 0.0F;
        for (std::size_t k = 0; k < n * n; ++k) {
          const Sample& s = samples_[(y * n + k / n) * row + x * n + k % n];
          sum += s.ambient + (s.direct > 0.0F ? s.direct * lit(codes, light, s) : 0.0F);
        }
        const float whole = std::min(1.0F, sum / static_cast<float>(n * n));
        const float code = 255.0F * std::pow(whole, static_cast<float>(1.0 / shot_.gamma)) + next_noise();
        picture.gray.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(code), 0L, 255L)));
      }
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
    return picture(focalstage::picture_of(set, pattern), set.gamma, focalstage::name_of(pattern));
  }

 private:
  struct Sample {
    float u = 0.0F;
    float v = 0.0F;
    float direct = 0.0F;
    float ambient = 0.0F;
  };

  Sample sample(const std::vector<Thing>& things, const Lens& projector, double x, double y) const {
    Sample made;
    const Vector along = camera_.look(x, y);
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
    made.u = static_cast<float>(pixel->x);
    made.v = static_cast<float>(pixel->y);
    return made;
  }

  /// The projector's light at a place of its picture, a pixel soft.
  float lit(const std::vector<std::uint8_t>& codes, const std::array<float, 256>& light, const Sample& s) const {
    const float x = std::clamp(s.u - 0.5F, 0.0F, static_cast<float>(projector_width_ - 1));
    const float y = std::clamp(s.v - 0.5F, 0.0F, static_cast<float>(projector_height_ - 1));
    const auto left = static_cast<std::size_t>(x);
    const auto top = static_cast<std::size_t>(y);
    const std::size_t right = std::min(left + 1, static_cast<std::size_t>(projector_width_ - 1));
    const std::size_t bottom = std::min(top + 1, static_cast<std::size_t>(projector_height_ - 1));
    const float fx = x - static_cast<float>(left);
    const float fy = y - static_cast<float>(top);
    const auto at = [&](std::size_t column, std::size_t line) {
      return light[codes[line * static_cast<std::size_t>(projector_width_) + column]];
    };
    const float above = at(left, top) + fx * (at(right, top) - at(left, top));
    const float below = at(left, bottom) + fx * (at(right, bottom) - at(left, bottom));
    return above + fy * (below - above);
  }

  float next_noise() {
    at_ = (at_ + 1) % noise_.size();
    return noise_[at_];
  }

  Lens camera_;
  Shot shot_;
  int projector_width_;
  int projector_height_;
  std::vector<Sample> samples_;
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
