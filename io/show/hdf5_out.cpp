#include "io/show/hdf5_out.h"

#include <algorithm>

namespace focalstage {
namespace {

/// A B-tree node of chunks as large as is useful: fewer nodes to write, fewer to read.
constexpr unsigned chunks_per_half_node = 128;

Hdf5Id simple_space(const std::vector<hsize_t>& shape) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

std::vector<const char*> pointers(const std::vector<std::string>& texts) {
  std::vector<const char*> out;
  for (const std::string& text : texts) out.push_back(text.c_str());
  return out;
}

}  // namespace

Hdf5Out::Hdf5Out(const std::filesystem::path& path, std::size_t user_block) {
  const Hdf5Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  demand(H5Pset_userblock(creation, user_block) >= 0);
  demand(H5Pset_istore_k(creation, chunks_per_half_node) >= 0);
  demand(H5Pset_obj_track_times(creation, false) >= 0);
  // The oldest form: every HDF5 since 1.8 reads it, MATLAB's and HDFView's included.
  demand(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18) >= 0);
  demand(H5Pset_file_locking(access, false, true) >= 0);
  if (!error_) file_ = Hdf5Id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  demand(file_.ok());
}

void Hdf5Out::demand(bool worked) {
  if (!worked && !error_) error_ = last_hdf5_error();
}

/// Creation properties without dates.
Hdf5Id Hdf5Out::created(H5O_type_t kind) {
  Hdf5Id properties(H5Pcreate(kind == H5O_TYPE_GROUP ? H5P_GROUP_CREATE : H5P_DATASET_CREATE), H5Pclose);
  demand(properties.ok() && H5Pset_obj_track_times(properties, false) >= 0);
  return properties;
}

void Hdf5Out::group(const char* name) {
  if (error_) return;
  const Hdf5Id properties = created(H5O_TYPE_GROUP);
  const Hdf5Id group(H5Gcreate2(file_, name, H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
  demand(group.ok());
}

void Hdf5Out::raw_attribute(const char* object, const char* name, hid_t file_type, hid_t memory_type, hid_t space,
                            const void* data) {
  if (error_) return;
  const Hdf5Id owner(H5Oopen(file_, object, H5P_DEFAULT), H5Oclose);
  demand(owner.ok());
  if (error_) return;
  const Hdf5Id attribute(H5Acreate2(owner, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  demand(attribute.ok() && H5Awrite(attribute, memory_type, data) >= 0);
}

void Hdf5Out::attribute(const char* object, const char* name, double value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  raw_attribute(object, name, Hdf5Number<double>::file(), Hdf5Number<double>::memory(), space, &value);
}

void Hdf5Out::attribute(const char* object, const char* name, std::int32_t value) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  raw_attribute(object, name, Hdf5Number<std::int32_t>::file(), Hdf5Number<std::int32_t>::memory(), space, &value);
}

void Hdf5Out::text_attribute(const char* object, const char* name, hid_t space, const void* text) {
  const Hdf5Id type = text_type();
  raw_attribute(object, name, type, type, space, text);
}

void Hdf5Out::attribute(const char* object, const char* name, const std::string& text) {
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const char* data = text.c_str();
  text_attribute(object, name, space, &data);
}

void Hdf5Out::attribute(const char* object, const char* name, const std::vector<std::string>& texts) {
  const Hdf5Id space = simple_space({texts.size()});
  text_attribute(object, name, space, pointers(texts).data());
}

void Hdf5Out::dataset(const char* name, const std::string& text) {
  if (error_) return;
  const Hdf5Id type = text_type();
  const Hdf5Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Id properties = created(H5O_TYPE_DATASET);
  const Hdf5Id dataset(H5Dcreate2(file_, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  const char* data = text.c_str();
  demand(dataset.ok() && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &data) >= 0);
}

void Hdf5Out::dataset(const char* name, const std::vector<std::string>& texts) {
  const Hdf5Id type = text_type();
  raw_dataset(name, {texts.size()}, type, type, pointers(texts).data());
}

void Hdf5Out::raw_dataset(const char* name, Shape shape, hid_t file_type, hid_t memory_type, const void* data) {
  if (error_) return;
  const Hdf5Id space = simple_space({shape.begin(), shape.end()});
  const Hdf5Id properties = created(H5O_TYPE_DATASET);
  const Hdf5Id dataset(H5Dcreate2(file_, name, file_type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  demand(dataset.ok());
  const bool empty = std::find(shape.begin(), shape.end(), std::size_t{0}) != shape.end();
  if (error_ || empty) return;
  demand(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
}

void Hdf5Out::chunked(const char* name, const std::vector<hsize_t>& shape, const std::vector<hsize_t>& chunk,
                      unsigned level) {
  if (error_) return;
  const Hdf5Id space = simple_space(shape);
  const Hdf5Id properties = created(H5O_TYPE_DATASET);
  const bool empty = std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
  if (!empty) {
    const std::uint8_t black = 0;
    demand(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) >= 0);
    demand(H5Pset_deflate(properties, level) >= 0);
    demand(H5Pset_fill_value(properties, H5T_NATIVE_UINT8, &black) >= 0);
  }
  demand(chunked_.close());
  chunked_ = Hdf5Id(H5Dcreate2(file_, name, H5T_STD_U8LE, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  demand(chunked_.ok());
}

void Hdf5Out::chunk(const std::vector<hsize_t>& offset, std::span<const std::uint8_t> stream) {
  if (error_) return;
  demand(H5Dwrite_chunk(chunked_, H5P_DEFAULT, 0, offset.data(), stream.size(), stream.data()) >= 0);
}

void Hdf5Out::close() {
  demand(chunked_.close());
  if (file_.ok() && !error_) demand(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
  demand(file_.close());
}

}  // namespace focalstage
