#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "io/show/hdf5.h"

namespace focalstage {

/// Writes one HDF5 file. The first failure sticks: what is called after it does nothing, so that a list of datasets
/// reads as a list. Needs an Hdf5Session around its life.
class Hdf5Out {
 public:
  using Shape = std::initializer_list<std::size_t>;

  /// A new file with a user block of `user_block` bytes; nothing in it depends on the date.
  Hdf5Out(const std::filesystem::path& path, std::size_t user_block);

  void group(const char* name);

  void attribute(const char* object, const char* name, double value);
  void attribute(const char* object, const char* name, std::int32_t value);
  void attribute(const char* object, const char* name, const std::string& text);
  void attribute(const char* object, const char* name, const std::vector<std::string>& texts);

  void dataset(const char* name, const std::string& text);
  void dataset(const char* name, const std::vector<std::string>& texts);
  template <class T>
  void dataset(const char* name, Shape shape, std::span<const T> numbers) {
    raw_dataset(name, shape, Hdf5Number<T>::file(), Hdf5Number<T>::memory(), numbers.data());
  }
  template <class T>
  void dataset(const char* name, Shape shape, const std::vector<T>& numbers) {
    dataset(name, shape, std::span<const T>(numbers));
  }

  /// A dataset of bytes in deflated chunks, whose chunks follow one by one; without a byte, one that is empty.
  void chunked(const char* name, const std::vector<hsize_t>& shape, const std::vector<hsize_t>& chunk, unsigned level);
  void chunk(const std::vector<hsize_t>& offset, std::span<const std::uint8_t> stream);

  /// Everything to the system's buffers, and the file closed.
  void close();

  const std::optional<Hdf5Error>& error() const { return error_; }

 private:
  void demand(bool worked);
  Hdf5Id created(H5O_type_t kind);
  void text_attribute(const char* object, const char* name, hid_t space, const void* text);
  void raw_attribute(const char* object, const char* name, hid_t file_type, hid_t memory_type, hid_t space,
                     const void* data);
  void raw_dataset(const char* name, Shape shape, hid_t file_type, hid_t memory_type, const void* data);

  Hdf5Id file_;
  Hdf5Id chunked_;
  std::optional<Hdf5Error> error_;
};

}  // namespace focalstage
