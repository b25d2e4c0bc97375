#include "devices/uno/packets.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <vector>

namespace focalstage::uno {

namespace {

constexpr std::size_t longest_line = 64;  // with its line feed
constexpr std::size_t sum_length = 5;
constexpr double tick_s = 0.5e-6;

std::string sum_of(std::string_view body) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  const unsigned crc = crc16(body);
  return {'*', digits[crc >> 12], digits[crc >> 8 & 15U], digits[crc >> 4 & 15U], digits[crc & 15U]};
}

std::optional<unsigned> number_of(std::string_view word) {
  unsigned value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc{} || stop != end || value > 65535U) return std::nullopt;
  return value;
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t space = text.find(' ');
    words.push_back(text.substr(0, space));
    if (space == std::string_view::npos) break;
    text.remove_prefix(space + 1);
  }
  return words;
}

std::optional<Reply> numbered(ReplyKind kind, std::string_view code) {
  const std::optional<unsigned> value = number_of(code);
  if (!value) return std::nullopt;
  Reply reply;
  reply.kind = kind;
  reply.code = *value;
  return reply;
}

std::optional<Reply> unasked(const std::vector<std::string_view>& words) {
  if (words.size() == 3 && words[1] == "DARK") return numbered(ReplyKind::dark, words[2]);
  if (words.size() == 3 && words[1] == "ERR") return numbered(ReplyKind::error, words[2]);
  if (words.size() != 5 || words[1] != "BOOT" || words[2] != "focalstage-uno") return std::nullopt;
  const std::optional<unsigned> protocol = number_of(words[3]);
  std::optional<Reply> reply = numbered(ReplyKind::boot, words[4]);
  if (!protocol || !reply) return std::nullopt;
  reply->protocol = *protocol;
  return reply;
}

std::optional<Reply> answer(std::string_view body, const std::vector<std::string_view>& words) {
  const std::optional<unsigned> number = number_of(words[0]);
  if (!number || *number > 255U) return std::nullopt;
  std::optional<Reply> reply;
  if (words[1] == "ERR" && words.size() == 3) {
    reply = numbered(ReplyKind::error, words[2]);
  } else if (words[1] == "OK") {
    reply = Reply{ReplyKind::ok, {}, 0, 0, {}};
    const std::size_t before = words[0].size() + words[1].size() + 2;
    if (body.size() > before) reply->words = body.substr(before);
  }
  if (reply) reply->number = static_cast<std::uint8_t>(*number);
  return reply;
}

}  // namespace

std::uint16_t crc16(std::string_view bytes) {
  unsigned crc = 0xFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned>(static_cast<unsigned char>(byte)) << 8;
    for (int bit = 0; bit < 8; ++bit) crc = ((crc << 1) ^ ((crc & 0x8000U) != 0 ? 0x1021U : 0U)) & 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc);
}

std::optional<std::string> request(std::uint8_t number, std::string_view command) {
  for (const char byte : command) {
    if (byte < ' ' || byte > '~') return std::nullopt;
  }
  std::string line = std::to_string(number) + ' ' + std::string(command);
  line += sum_of(line) + '\n';
  if (line.size() > longest_line) return std::nullopt;
  return line;
}

Reply decode(std::string_view line) {
  if (line.size() <= sum_length || line.size() >= longest_line) return {};
  const std::string_view body = line.substr(0, line.size() - sum_length);
  if (line.substr(body.size()) != sum_of(body)) return {};
  const std::vector<std::string_view> words = words_of(body);
  if (words.size() < 2) return {};
  return (words[0] == "!" ? unasked(words) : answer(body, words)).value_or(Reply{});
}

std::optional<StatusLine> decode_status(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  std::array<unsigned, 6> numbers{};
  if (words.size() != numbers.size()) return std::nullopt;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::optional<unsigned> number = number_of(words[i]);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  if (numbers[0] > 2U) return std::nullopt;
  return StatusLine{
      static_cast<StatusLine::State>(numbers[0]), numbers[1], numbers[2], numbers[3] * tick_s, numbers[4], numbers[5]};
}

std::optional<LensLine> decode_lens(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != 2) return std::nullopt;
  const std::optional<unsigned> after = number_of(words[0]);
  const std::optional<unsigned> edges = number_of(words[1]);
  if (!after || !edges) return std::nullopt;
  return LensLine{*after * tick_s, *edges};
}

std::optional<unsigned> decode_hello(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != 3 || words[0] != "focalstage-uno") return std::nullopt;
  return number_of(words[1]);
}

std::optional<Reply> ReplyReader::push(char byte) {
  if (byte == '\n') {
    const Reply reply = too_long_ ? Reply{} : decode(line_);
    line_.clear();
    too_long_ = false;
    return reply;
  }
  too_long_ = too_long_ || line_.size() + 1 >= longest_line;
  if (!too_long_) line_.push_back(byte);
  return std::nullopt;
}

}  // namespace focalstage::uno
