#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace focalstage {

using Sha256Digest = std::array<std::uint8_t, 32>;

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;
  ~Sha256();

  void add(std::span<const std::byte> bytes);
  Sha256Digest finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

Sha256Digest sha256_of(std::span<const std::byte> bytes);

std::string hex(const Sha256Digest& digest);

/// 64 lower-case hex digits and nothing else: fit to name a file.
bool is_sha256_hex(const std::string& text);

}  // namespace focalstage
