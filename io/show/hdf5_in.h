#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "io/show/disk.h"
#include "io/show/hdf5.h"

namespace focalstage {

/// Reads one HDF5 file, distrusting it: every name, type and shape is asked before a byte is read. The first fault
/// sticks; what is read after it is empty. Needs an Hdf5Session around every call.
class Hdf5In {
 public:
  /// A shape as the reader expects it; `any` fits every extent.
  using Shape = std::vector<std::size_t>;
  static constexpr std::size_t any = static_cast<std::size_t>(-1);

  /// The very file behind `file`, whatever its name names by now; `path` is for faults.
  Hdf5In(const DiskFile& file, const std::filesystem::path& path);

  template <class T>
  T attribute(const char* object, const char* name) {
    T value{};
    raw_attribute(object, name, Hdf5Number<T>::file(), Hdf5Number<T>::memory(), Hdf5Number<T>::name, &value);
    return value;
  }
  std::string text_attribute(const char* object, const char* name);
  std::vector<std::string> texts_attribute(const char* object, const char* name);
  bool has_attribute(const char* object, const char* name);

  std::string text(const char* name);
  std::vector<std::string> texts(const char* name);

  template <class T>
  std::vector<T> numbers(const char* name, const Shape& expected) {
    const Found found = find(name, expected, Hdf5Number<T>::file(), Hdf5Number<T>::name);
    std::vector<T> out(found.count);
    if (found.count > 0) read(name, found, Hdf5Number<T>::memory(), out.data());
    return out;
  }

  /// The names in a group, in alphabetical order.
  std::vector<std::string> names(const char* group);

  /// Opens a dataset of deflated byte chunks, which the calls below number in the order of opening; its shape, which
  /// fits `expected` or is one longer and ends with 3.
  Shape open_chunked(const char* name, const Shape& expected);
  bool chunked_as(std::size_t dataset, const Shape& chunk);

  /// The stored bytes of the chunk at `offset`; empty where it is not stored, nothing where that fails.
  std::optional<std::vector<std::uint8_t>> chunk(std::size_t dataset, const std::vector<hsize_t>& offset);

  /// For what a caller finds wrong in a dataset.
  void refuse(const std::string& dataset, const std::string& message);

  bool ok() const { return !fault_; }
  const Fault& fault() const { return *fault_; }

 private:
  struct Found {
    Hdf5Id dataset;
    Hdf5Id space;
    std::size_t count = 0;
  };

  Found find(const char* name, const Shape& expected, hid_t type, const char* type_name);
  void read(const char* name, const Found& found, hid_t type, void* out);
  void raw_attribute(const char* object, const char* name, hid_t file_type, hid_t memory_type, const char* type_name,
                     void* out);
  Hdf5Id open_attribute(const char* object, const char* name);
  std::vector<std::string> attribute_texts(const char* object, const char* name, std::size_t dimensions);
  std::vector<std::string> dataset_texts(const char* name, const Shape& expected);

  std::filesystem::path path_;
  std::uint64_t file_bytes_ = 0;
  Hdf5Id file_;
  std::vector<Hdf5Id> chunked_;
  std::optional<Fault> fault_;
};

}  // namespace focalstage
