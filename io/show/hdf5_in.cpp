#include "io/show/hdf5_in.h"

#include <algorithm>
#include <string_view>

namespace focalstage {
namespace {

constexpr std::size_t max_texts = 1u << 20;

Hdf5In::Shape shape_of(hid_t space) {
  const int dimensions = H5Sget_simple_extent_ndims(space);
  if (dimensions < 0) return {Hdf5In::any};
  std::vector<hsize_t> extents(static_cast<std::size_t>(dimensions));
  if (dimensions > 0) H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return {extents.begin(), extents.end()};
}

bool fits(const Hdf5In::Shape& shape, const Hdf5In::Shape& expected) {
  return std::equal(shape.begin(), shape.end(), expected.begin(), expected.end(),
                    [](std::size_t extent, std::size_t wanted) { return wanted == Hdf5In::any || wanted == extent; });
}

std::string text_of(const Hdf5In::Shape& shape) {
  std::string text = "[";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (i > 0) text += ",";
    text += shape[i] == Hdf5In::any ? "n" : std::to_string(shape[i]);
  }
  return text + "]";
}

bool is_text(hid_t type) { return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) > 0; }

/// The library allocates what it reads; this frees it.
std::vector<std::string> take_texts(std::vector<char*>& pointers) {
  std::vector<std::string> out;
  for (char* pointer : pointers) {
    out.emplace_back(pointer ? pointer : "");
    if (pointer) H5free_memory(pointer);
  }
  return out;
}

}  // namespace

Hdf5In::Hdf5In(const DiskFile& file, const std::filesystem::path& path) : path_(path), file_bytes_(file.size()) {
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  const std::string same_file = "/proc/self/fd/" + std::to_string(file.descriptor());
  file_ = Hdf5Id(H5Fopen(same_file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!file_.ok()) refuse("/", "the HDF5 library cannot open it (" + last_hdf5_error().message + ")");
}

void Hdf5In::refuse(const std::string& dataset, const std::string& message) {
  if (!fault_) fault_ = Fault{"show.invalid", path_.string() + ": " + dataset, message, "compile the show again"};
  H5Eclear2(H5E_DEFAULT);
}

Hdf5In::Found Hdf5In::find(const char* name, const Shape& expected, hid_t type, const char* type_name) {
  if (!ok()) return {};
  Found found{Hdf5Id(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose), {}, 0};
  if (!found.dataset.ok()) return refuse(name, "it is missing"), Found{};
  const Hdf5Id found_type(H5Dget_type(found.dataset), H5Tclose);
  if (!found_type.ok() || H5Tequal(found_type, type) <= 0)
    return refuse(name, std::string("its type is not ") + type_name), Found{};
  found.space = Hdf5Id(H5Dget_space(found.dataset), H5Sclose);
  const Shape shape = shape_of(found.space);
  if (!found.space.ok() || !fits(shape, expected))
    return refuse(name, "its shape is " + text_of(shape) + ", not " + text_of(expected)), Found{};
  const hssize_t count = H5Sget_simple_extent_npoints(found.space);
  const std::size_t size = H5Tget_size(type);
  // A dataset that claims more than the file holds is not worth an allocation.
  const std::uint64_t stored = H5Dget_storage_size(found.dataset);
  if (count < 0 || static_cast<std::uint64_t>(count) > file_bytes_ / size ||
      stored != static_cast<std::uint64_t>(count) * size)
    return refuse(name, "its bytes are not all there"), Found{};
  found.count = static_cast<std::size_t>(count);
  return found;
}

void Hdf5In::read(const char* name, const Found& found, hid_t type, void* out) {
  if (H5Dread(found.dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) < 0)
    refuse(name, "it cannot be read (" + last_hdf5_error().message + ")");
}

std::vector<std::string> Hdf5In::dataset_texts(const char* name, const Shape& expected) {
  if (!ok()) return {};
  const Hdf5Id dataset(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose);
  if (!dataset.ok()) return refuse(name, "it is missing"), std::vector<std::string>{};
  const Hdf5Id type(H5Dget_type(dataset), H5Tclose);
  const Hdf5Id space(H5Dget_space(dataset), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (!is_text(type) || !fits(shape_of(space), expected) || count < 0 || static_cast<std::size_t>(count) > max_texts)
    return refuse(name, "it is not text of shape " + text_of(expected)), std::vector<std::string>{};
  std::vector<char*> pointers(static_cast<std::size_t>(count), nullptr);
  const Hdf5Id memory_type = text_type();
  if (count > 0 && H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0)
    refuse(name, "it cannot be read (" + last_hdf5_error().message + ")");
  return take_texts(pointers);
}

std::string Hdf5In::text(const char* name) {
  std::vector<std::string> texts = dataset_texts(name, {});
  return texts.size() == 1 ? texts[0] : std::string();
}

std::vector<std::string> Hdf5In::texts(const char* name) { return dataset_texts(name, {any}); }

bool Hdf5In::has_attribute(const char* object, const char* name) {
  return ok() && H5Aexists_by_name(file_, object, name, H5P_DEFAULT) > 0;
}

Hdf5Id Hdf5In::open_attribute(const char* object, const char* name) {
  if (!ok()) return {};
  Hdf5Id attribute(H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.ok()) refuse(std::string(object) + " attribute " + name, "it is missing");
  return attribute;
}

void Hdf5In::raw_attribute(const char* object, const char* name, hid_t file_type, hid_t memory_type,
                           const char* type_name, void* out) {
  const Hdf5Id attribute = open_attribute(object, name);
  if (!ok()) return;
  const Hdf5Id type(H5Aget_type(attribute), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute), H5Sclose);
  const bool one = H5Tequal(type, file_type) > 0 && H5Sget_simple_extent_npoints(space) == 1;
  if (!one || H5Aread(attribute, memory_type, out) < 0)
    refuse(std::string(object) + " attribute " + name, std::string("it is not one ") + type_name);
}

std::vector<std::string> Hdf5In::attribute_texts(const char* object, const char* name, std::size_t dimensions) {
  const Hdf5Id attribute = open_attribute(object, name);
  if (!ok()) return {};
  const Hdf5Id type(H5Aget_type(attribute), H5Tclose);
  const Hdf5Id space(H5Aget_space(attribute), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  const bool plain = is_text(type) && shape_of(space).size() == dimensions && count >= 0 &&
                     static_cast<std::size_t>(count) <= max_texts;
  std::vector<char*> pointers(plain ? static_cast<std::size_t>(count) : 0, nullptr);
  const Hdf5Id memory_type = text_type();
  if (!plain || (count > 0 && H5Aread(attribute, memory_type, pointers.data()) < 0))
    refuse(std::string(object) + " attribute " + name, "it is not text");
  return take_texts(pointers);
}

std::string Hdf5In::text_attribute(const char* object, const char* name) {
  std::vector<std::string> texts = attribute_texts(object, name, 0);
  return texts.size() == 1 ? texts[0] : std::string();
}

std::vector<std::string> Hdf5In::texts_attribute(const char* object, const char* name) {
  return attribute_texts(object, name, 1);
}

std::vector<std::string> Hdf5In::names(const char* group_name) {
  if (!ok()) return {};
  const Hdf5Id group(H5Gopen2(file_, group_name, H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (!group.ok() || H5Gget_info(group, &info) < 0 || info.nlinks > max_texts)
    return refuse(group_name, "it is missing or no group"), std::vector<std::string>{};
  std::vector<std::string> out;
  const auto gather = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  if (H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, gather, &out) < 0)
    refuse(group_name, "its names cannot be read");
  return out;
}

Hdf5In::Shape Hdf5In::open_chunked(const char* name, const Shape& expected) {
  if (!ok()) return {};
  chunked_.emplace_back(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose);
  const Hdf5Id& opened = chunked_.back();
  if (!opened.ok()) return refuse(name, "it is missing"), Shape{};
  const Hdf5Id type(H5Dget_type(opened), H5Tclose);
  if (H5Tequal(type, H5T_STD_U8LE) <= 0) return refuse(name, "its type is not uint8"), Shape{};
  const Hdf5Id space(H5Dget_space(opened), H5Sclose);
  const Shape shape = shape_of(space);
  Shape colored = expected;
  colored.push_back(3);
  if (!fits(shape, expected) && !fits(shape, colored))
    return refuse(name, "its shape is " + text_of(shape) + ", not " + text_of(expected) + " or [..,3]"), Shape{};
  return shape;
}

bool Hdf5In::chunked_as(std::size_t dataset, const Shape& chunk) {
  const Hdf5Id properties(H5Dget_create_plist(chunked_.at(dataset)), H5Pclose);
  std::vector<hsize_t> extents(chunk.size());
  if (!properties.ok() || H5Pget_layout(properties) != H5D_CHUNKED) return false;
  const int dimensions = H5Pget_chunk(properties, static_cast<int>(extents.size()), extents.data());
  if (dimensions != static_cast<int>(chunk.size()) || !std::equal(extents.begin(), extents.end(), chunk.begin()))
    return false;
  unsigned flags = 0;
  std::size_t values = 0;
  return H5Pget_nfilters(properties) == 1 &&
         H5Pget_filter2(properties, 0, &flags, &values, nullptr, 0, nullptr, nullptr) == H5Z_FILTER_DEFLATE;
}

std::optional<std::vector<std::uint8_t>> Hdf5In::chunk(std::size_t dataset, const std::vector<hsize_t>& offset) {
  hsize_t size = 0;
  if (H5Dget_chunk_storage_size(chunked_[dataset], offset.data(), &size) < 0) {
    // The library calls it an error to ask after a chunk that was never stored.
    if (last_hdf5_error().message == "chunk storage is not allocated") return std::vector<std::uint8_t>{};
    return {};
  }
  if (size > file_bytes_) return {};
  std::vector<std::uint8_t> stream(static_cast<std::size_t>(size));
  std::uint32_t skipped_filters = 0;
  if (size > 0 && (H5Dread_chunk(chunked_[dataset], H5P_DEFAULT, offset.data(), &skipped_filters, stream.data()) < 0 ||
                   skipped_filters != 0)) {
    H5Eclear2(H5E_DEFAULT);
    return {};
  }
  return stream;
}

}  // namespace focalstage
