// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace semslam {
namespace {

constexpr std::size_t kMaxLiterals = 32;
constexpr std::size_t kMinMatch = 3;
constexpr std::size_t kMaxMatch = 2 + 7 + 255;
constexpr std::size_t kMaxDistance = 1 << 13;
constexpr std::size_t kLongMatch = 7;  // In the upper 3 bits: one more byte of length follows.

std::uint32_t HashOfThree(const char* bytes) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes, kMinMatch);
  constexpr int kHashBits = 16;
  return value * 2654435761U >> (32 - kHashBits);  // Multiplicative hashing, Knuth 6.4.
}

std::size_t MatchLength(std::string_view bytes, std::size_t earlier, std::size_t position) {
  const std::size_t max = std::min(kMaxMatch, bytes.size() - position);
  std::size_t length = 0;
  while (length < max && bytes[earlier + length] == bytes[position + length]) ++length;
  return length;
}

void AppendLiterals(std::string_view literals, std::string& code) {
  while (!literals.empty()) {
    const std::string_view run = literals.substr(0, kMaxLiterals);
    code += static_cast<char>(run.size() - 1);
    code += run;
    literals.remove_prefix(run.size());
  }
}

void AppendMatch(std::size_t length, std::size_t distance, std::string& code) {
  const std::size_t stored_length = length - 2;
  const std::size_t stored_distance = distance - 1;
  const std::size_t upper = std::min(stored_length, kLongMatch);
  code += static_cast<char>(upper << 5 | stored_distance >> 8);
  if (upper == kLongMatch) code += static_cast<char>(stored_length - kLongMatch);
  code += static_cast<char>(stored_distance & 0xff);
}

}  // namespace

std::string CompressLzf(std::string_view bytes) {
  std::string code;
  code.reserve(bytes.size() / 2);
  // Where three bytes with this hash were last seen; position + 1, so that 0 is never.
  std::vector<std::size_t> last_seen(1 << 16, 0);
  std::size_t literals_start = 0;
  std::size_t position = 0;
  while (position + kMinMatch <= bytes.size()) {
    std::size_t& seen = last_seen[HashOfThree(bytes.data() + position)];
    const std::size_t earlier = seen - 1;
    const bool is_near = seen != 0 && position - earlier <= kMaxDistance;
    seen = position + 1;
    const std::size_t length = is_near ? MatchLength(bytes, earlier, position) : 0;
    if (length < kMinMatch) {
      ++position;
      continue;
    }
    AppendLiterals(bytes.substr(literals_start, position - literals_start), code);
    AppendMatch(length, position - earlier, code);
    position += length;
    literals_start = position;
  }
  AppendLiterals(bytes.substr(literals_start), code);
  return code;
}

std::optional<std::string> DecompressLzf(std::string_view code, std::size_t size) {
  constexpr std::size_t kMaxRatio = kMaxMatch / kMinMatch + 1;
  if (size / kMaxRatio > code.size()) return std::nullopt;  // Before memory is asked for.
  std::string bytes;
  bytes.reserve(size);
  std::size_t i = 0;
  const auto next = [&] { return static_cast<std::size_t>(static_cast<unsigned char>(code[i++])); };
  while (i < code.size()) {
    const std::size_t control = next();
    if (control < kMaxLiterals) {
      if (code.size() - i < control + 1) return std::nullopt;
      bytes += code.substr(i, control + 1);
      i += control + 1;
    } else {
      const bool is_long = control >> 5 == kLongMatch;
      if (code.size() - i < (is_long ? 2U : 1U)) return std::nullopt;
      const std::size_t length = (control >> 5) + 2 + (is_long ? next() : 0);
      const std::size_t distance = ((control & 31) << 8 | next()) + 1;
      if (distance > bytes.size()) return std::nullopt;
      for (std::size_t k = 0; k < length; ++k) bytes += bytes[bytes.size() - distance];
    }
    if (bytes.size() > size) return std::nullopt;
  }
  if (bytes.size() != size) return std::nullopt;
  return bytes;
}

}  // namespace semslam
