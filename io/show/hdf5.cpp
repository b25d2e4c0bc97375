#include "io/show/hdf5.h"

#include <string_view>

namespace focalstage {
namespace {

std::recursive_mutex& hdf5_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

/// The library leaves errno in its text alone: "... errno = 28, error message = 'No space left on device' ...".
int errno_in(std::string_view text) {
  constexpr std::string_view key = "errno = ";
  const std::size_t at = text.find(key);
  if (at == std::string_view::npos) return 0;
  int number = 0;
  for (std::size_t i = at + key.size(); i < text.size() && text[i] >= '0' && text[i] <= '9' && number < 10000; ++i)
    number = number * 10 + (text[i] - '0');
  return number;
}

herr_t gather(unsigned, const H5E_error2_t* entry, void* data) {
  auto& error = *static_cast<Hdf5Error*>(data);
  const std::string text = entry->desc ? entry->desc : "";
  if (error.message.empty()) error.message = text;
  if (error.system_error == 0) error.system_error = errno_in(text);
  return 0;
}

}  // namespace

Hdf5Session::Hdf5Session() : lock_(hdf5_mutex()) {
  // Every file of ours is closed by its owner. The library's own clean-up at exit would only meet files whose writing
  // failed, and crash on them.
  static const herr_t first = H5dont_atexit();
  static_cast<void>(first);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Error last_hdf5_error() {
  Hdf5Error error;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, gather, &error);
  H5Eclear2(H5E_DEFAULT);
  return error;
}

Hdf5Id text_type() {
  Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

}  // namespace focalstage
