// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/checksum.h"

#include <cstring>

namespace semslam {

std::uint64_t AddToChecksum(std::uint64_t sum, std::span<const std::byte> bytes) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  std::size_t i = 0;
  for (; i + 8 <= bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, 8);
    sum = (sum ^ word) * kPrime;
  }
  if (i == bytes.size()) return sum;
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data() + i, bytes.size() - i);
  return (sum ^ word) * kPrime;
}

}  // namespace semslam
