// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/radix_sort.h"

#include <array>
#include <cstddef>

namespace semslam {

void RadixSort(std::vector<KeyedIndex>& items, int num_bits) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kNumDigits = std::size_t{1} << kDigitBits;
  std::vector<KeyedIndex> sorted(items.size());
  for (int shift = 0; shift < num_bits; shift += kDigitBits) {
    std::array<std::size_t, kNumDigits> begin{};
    for (const KeyedIndex& item : items) ++begin[(item.key >> shift) & (kNumDigits - 1)];
    std::size_t sum = 0;
    for (std::size_t& entry : begin) {
      const std::size_t count = entry;
      entry = sum;
      sum += count;
    }
    for (const KeyedIndex& item : items) {
      sorted[begin[(item.key >> shift) & (kNumDigits - 1)]++] = item;
    }
    items.swap(sorted);
  }
}

}  // namespace semslam
