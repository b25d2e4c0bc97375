#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "io/files/digest.h"
#include "io/show/show.h"

// A show without a compiler: small, of every kind of content, and the same on every call.
namespace focalstage::sample {

/// A folder of its own, deleted with the value.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "focalstage-show-XXXXXX").string();
    if (::mkdtemp(name.data())) path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void put(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

inline AssetFile asset(const std::string& path, const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {path, hex(sha256_of(text)), {first, first + text.size()}};
}

inline FramePoses poses(int frame) {
  const double x = 0.01 * frame;
  FramePoses out;
  out.viewer = {x, 1.5, 0, 0, 0, 0, 1};
  out.surfaces = {{0, 0, -0.5, 0, 0, 0, 1}};
  out.objects = {{x, 0, -0.333, 0, 0, 0, 1}, {0, x, -1, 0, 1, 0, 0}};
  return out;
}

inline Schedule schedule(const std::vector<ImageSpec>& images) {
  Schedule out;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Side side = images[i].eye == ImageEye::right ? Side::right : Side::left;
    const double start_s = 0.002 + 0.003 * static_cast<double>(i);
    out.slots.push_back({static_cast<int>(i), side, start_s, 0.0005, start_s - 0.0045, images[i].power_d, 0.1});
  }
  for (const Side side : both_sides) {
    for (int k = 0; k < 8; ++k) {
      out.lens_power_d[side].push_back(0.25 * k - 1.0 + static_cast<double>(index_of(side)));
      out.lens_drive_a[side].push_back(out.lens_power_d[side].back() / 40.0);
    }
  }
  out.shutter.left = {0.0002, 0.0081};
  out.shutter.right = {0.0085, 0.0164};
  return out;
}

/// A project with so many surfaces and objects.
inline std::string project_text(int surfaces, int objects) {
  const auto things = [](const std::string& name, int count) {
    std::string list;
    for (int i = 0; i < count; ++i) {
      list += (i > 0 ? ", " : "") + ("{ \"name\": \"" + name) + std::to_string(i) +
              "\", \"mesh\": { \"primitive\": \"plane\", \"size_m\": [1, 1] } }";
    }
    return "[" + list + "]";
  };
  return "{ \"focalstage\": 1, \"name\": \"K\u00f6nig\",\n  \"projectors\": [{ \"name\": \"main\" }],\n"
         "  \"slices\": { \"powers_d\": [-0.5, 0.5] },\n  \"surfaces\": " +
         things("surface", surfaces) + ",\n  \"objects\": " + things("object", objects) + " }\n";
}

/// Two slices per eye and a light image; two objects, one surface, two cues, three assets of which two are the same.
inline ShowHeader header(int frames, int width_px, int height_px, int channels) {
  ShowHeader out;
  out.project_text = project_text(1, 2);
  out.assets = {asset("assets/a.obj", "v 0 0 0\n"), asset("assets/b.bin", std::string("\0\x01\xff", 3)),
                asset("assets/copy of a.obj", "v 0 0 0\n")};
  out.frames = frames;
  out.width_px = width_px;
  out.height_px = height_px;
  out.channels = channels;
  out.images = {{ImageEye::left, ImageKind::content, -0.5, 0},
                {ImageEye::left, ImageKind::content, 0.5, 1},
                {ImageEye::right, ImageKind::content, -0.5, 0},
                {ImageEye::right, ImageKind::content, 0.5, 1},
                {ImageEye::both, ImageKind::surface_light, 0.0, -1}};
  out.schedule = schedule(out.images);
  for (int k = 0; k < frames; ++k) out.poses.push_back(poses(k));
  out.cues = {{"start", 0}, {"Ende \u2192", frames - 1}};
  return out;
}

/// Discs that move with the frame, with a texture that compresses neither well nor not at all; the last slice is black.
inline FrameImages images(const ShowHeader& header, int frame) {
  FrameImages out{header.images.size(), header.width_px, header.height_px, header.channels, {}};
  out.codes.resize(out.count * out.bytes_per_image());
  std::uint32_t noise = 1u + static_cast<std::uint32_t>(frame);
  std::size_t at = 0;
  for (std::size_t i = 0; i < out.count; ++i) {
    const int radius = std::max(2, std::min(out.width_px, out.height_px) / 4);
    const int centre_x = out.width_px / 3 + 3 * frame;
    for (int y = 0; y < out.height_px; ++y) {
      for (int x = 0; x < out.width_px; ++x) {
        const int dx = x - centre_x;
        const int dy = y - out.height_px / 2;
        const bool lit = i != 3 && dx * dx + dy * dy < radius * radius;
        for (int c = 0; c < out.channels; ++c, ++at) {
          noise = noise * 1664525u + 1013904223u;
          if (lit)
            out.codes[at] = static_cast<std::uint8_t>(40 + (x + y) % 128 + static_cast<int>(noise >> 29) + 8 * c);
        }
      }
    }
  }
  return out;
}

inline FrameMeasure measure(int frame) {
  const auto k = static_cast<std::uint64_t>(frame);
  return {100 + k, 2, 300, 4 + k, 0.125 * frame, {{0, 50, 1, 0.3, 0.3, 0.2}, {1, 60 + k, 0, 0.01 * frame, 0, 0.01}},
          {}};
}

inline bool same(const FrameMeasure& a, const FrameMeasure& b) {
  const auto same_object = [](const ObjectMeasure& x, const ObjectMeasure& y) {
    return std::tie(x.samples, x.beyond, x.worst_beyond_d, x.worst_below_d, x.worst_above_d) ==
           std::tie(y.samples, y.beyond, y.worst_beyond_d, y.worst_below_d, y.worst_above_d);
  };
  return std::tie(a.lit_pixels, a.clipped_pixels, a.surface_pixels, a.defocused_pixels, a.worst_defocus_d) ==
             std::tie(b.lit_pixels, b.clipped_pixels, b.surface_pixels, b.defocused_pixels, b.worst_defocus_d) &&
         a.optimal == b.optimal &&
         std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(), same_object);
}

}  // namespace focalstage::sample
