#include "io/show/part_record.h"

#include <libdeflate.h>

#include <bit>
#include <cstring>
#include <numeric>

namespace focalstage {
namespace {

static_assert(std::endian::native == std::endian::little, "part logs and shows are little-endian");

constexpr std::uint32_t record_magic = 0x4d415246;  // "FRAM"
constexpr std::string_view part_magic = "focalstage-part\n";

std::uint32_t crc32_of(std::span<const std::byte> bytes) { return libdeflate_crc32(0, bytes.data(), bytes.size()); }

class Out {
 public:
  template <class T>
  void operator()(const T& value) {
    raw(&value, sizeof(T));
  }
  void raw(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
  }

  std::vector<std::byte> bytes;
};

class In {
 public:
  explicit In(std::span<const std::byte> bytes) : rest(bytes) {}

  template <class T>
  void operator()(T& value) {
    std::memcpy(&value, rest.data(), sizeof(T));
    rest = rest.subspan(sizeof(T));
  }

  std::span<const std::byte> rest;
};

/// Every number of a measure through `pass`, which writes or reads it.
template <class Measure, class Pass>
void each_number(Measure& measure, Pass&& pass) {
  pass(measure.lit_pixels);
  pass(measure.clipped_pixels);
  pass(measure.surface_pixels);
  pass(measure.defocused_pixels);
  pass(measure.worst_defocus_d);
  for (auto* eye : {&measure.optimal.left, &measure.optimal.right}) {
    pass(eye->tiles);
    pass(eye->accepted_tiles);
    pass(eye->left_tiles);
    pass(eye->values);
    pass(eye->linear_error);
    pass(eye->optimal_error);
  }
  for (auto& object : measure.objects) {
    pass(object.samples);
    pass(object.beyond);
    pass(object.worst_beyond_d);
    pass(object.worst_below_d);
    pass(object.worst_above_d);
  }
  for (auto& surface : measure.surfaces) {
    pass(surface.lit_pixels);
    pass(surface.too_bright);
    pass(surface.too_dark);
    for (auto& count : surface.bright_in) pass(count);
    for (auto& count : surface.dark_in) pass(count);
    pass(surface.most);
    pass(surface.least);
  }
}

std::size_t fixed_bytes(const PartKey& key) {
  return (5 + 2 * 6) * 8 + key.objects * 5 * 8 + key.surfaces * 11 * 8 + key.chunks_per_frame * sizeof(std::uint32_t);
}

std::size_t largest_body(const PartKey& key) {
  // Nothing deflates to more than a few bytes per block over what it was.
  return fixed_bytes(key) + key.chunks_per_frame * (key.chunk_bytes + key.chunk_bytes / 64 + 64);
}

}  // namespace

FrameMeasure spread(const FrameMeasure& measure, std::size_t objects, std::size_t surfaces) {
  FrameMeasure out = measure;
  out.objects.assign(objects, {});
  for (std::size_t i = 0; i < objects; ++i) out.objects[i].index = i;
  for (const ObjectMeasure& object : measure.objects)
    if (object.index < objects) out.objects[object.index] = object;
  out.surfaces.assign(surfaces, {});
  for (std::size_t i = 0; i < surfaces; ++i) out.surfaces[i].index = i;
  for (const SurfaceAsked& surface : measure.surfaces)
    if (surface.index < surfaces) out.surfaces[surface.index] = surface;
  return out;
}

std::vector<std::byte> preamble_bytes(const PartKey& key) {
  Out out;
  out.raw(part_magic.data(), part_magic.size());
  out(part_version);
  out.raw(key.project.data(), key.project.size());
  out.raw(key.fingerprint.data(), key.fingerprint.size());
  out(crc32_of(out.bytes));
  return out.bytes;
}

std::vector<std::byte> record_bytes(std::size_t frame, const FrameMeasure& measure, const PackedFrame& packed,
                                    const PartKey& key) {
  Out out;
  out.bytes.resize(sizeof(RecordHead));
  out.bytes.reserve(sizeof(RecordHead) + fixed_bytes(key) + packed.data.size());
  const FrameMeasure whole = spread(measure, key.objects, key.surfaces);
  each_number(whole, out);
  out.raw(packed.sizes.data(), packed.sizes.size() * sizeof(std::uint32_t));
  out.raw(packed.data.data(), packed.data.size());

  const std::span<const std::byte> body = std::span(out.bytes).subspan(sizeof(RecordHead));
  RecordHead head{record_magic, static_cast<std::uint32_t>(frame), body.size(), crc32_of(body), 0};
  std::memcpy(out.bytes.data(), &head, sizeof(head));
  head.head_crc = crc32_of(std::span(out.bytes).first(offsetof(RecordHead, head_crc)));
  std::memcpy(out.bytes.data(), &head, sizeof(head));
  return std::move(out.bytes);
}

std::optional<RecordHead> head_from(std::span<const std::byte> bytes, const PartKey& key) {
  RecordHead head;
  if (bytes.size() < sizeof(head)) return {};
  std::memcpy(&head, bytes.data(), sizeof(head));
  if (head.head_crc != crc32_of(bytes.first(offsetof(RecordHead, head_crc)))) return {};
  if (head.magic != record_magic || head.frame >= key.frames) return {};
  if (head.body_bytes < fixed_bytes(key) || head.body_bytes > largest_body(key)) return {};
  return head;
}

std::optional<RecordBody> body_from(std::span<const std::byte> bytes, const RecordHead& head, const PartKey& key) {
  if (bytes.size() != head.body_bytes || crc32_of(bytes) != head.body_crc) return {};
  RecordBody body;
  body.measure = spread({}, key.objects, key.surfaces);
  In in(bytes);
  each_number(body.measure, in);
  body.packed.sizes.resize(key.chunks_per_frame);
  for (std::uint32_t& size : body.packed.sizes) in(size);
  const auto total = std::accumulate(body.packed.sizes.begin(), body.packed.sizes.end(), std::uint64_t{0});
  if (total != in.rest.size()) return {};
  body.packed.data.resize(in.rest.size());
  if (!in.rest.empty()) std::memcpy(body.packed.data.data(), in.rest.data(), in.rest.size());
  return body;
}

}  // namespace focalstage
