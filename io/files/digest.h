#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace focalstage {

using Sha256Value = std::array<std::uint8_t, 32>;

/// SHA-256 piece by piece, for what does not fit into memory.
class Sha256 {
 public:
  Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;
  ~Sha256();

  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  Sha256Value value();  ///< once, at the end

 private:
  struct State;
  std::unique_ptr<State> state_;
};

Sha256Value sha256_of(std::span<const std::byte> bytes);
Sha256Value sha256_of(std::string_view text);

std::string hex(const Sha256Value& value);

}  // namespace focalstage
