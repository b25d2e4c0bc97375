#pragma once

#include <hdf5.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

namespace focalstage {

/// Debian's HDF5 is not thread-safe: whoever calls it holds this, which also keeps it from printing its errors.
class Hdf5Session {
 public:
  Hdf5Session();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

/// An HDF5 identifier; closed with the value.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close closer) : id_(id), close_(closer) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Id() { close(); }

  bool ok() const { return id_ >= 0; }
  operator hid_t() const { return id_; }

  /// True unless closing fails, as it does where buffered bytes cannot be written.
  bool close() {
    const hid_t id = std::exchange(id_, -1);
    return id < 0 || close_(id) >= 0;
  }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// What the library said last, innermost first, on one line; empties its error stack.
struct Hdf5Error {
  std::string message;
  int system_error = 0;  ///< errno where the library met one, else 0
};
Hdf5Error last_hdf5_error();

/// UTF-8 text of any length.
Hdf5Id text_type();

/// How a C++ number lies in the file, and in memory.
template <class T>
struct Hdf5Number;
template <>
struct Hdf5Number<std::uint8_t> {
  static hid_t file() { return H5T_STD_U8LE; }
  static hid_t memory() { return H5T_NATIVE_UINT8; }
  static constexpr const char* name = "uint8";
};
template <>
struct Hdf5Number<std::int32_t> {
  static hid_t file() { return H5T_STD_I32LE; }
  static hid_t memory() { return H5T_NATIVE_INT32; }
  static constexpr const char* name = "int32";
};
template <>
struct Hdf5Number<std::uint64_t> {
  static hid_t file() { return H5T_STD_U64LE; }
  static hid_t memory() { return H5T_NATIVE_UINT64; }
  static constexpr const char* name = "uint64";
};
template <>
struct Hdf5Number<double> {
  static hid_t file() { return H5T_IEEE_F64LE; }
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
  static constexpr const char* name = "float64";
};

}  // namespace focalstage
