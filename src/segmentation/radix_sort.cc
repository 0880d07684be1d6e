// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/radix_sort.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "semslam/base/parallel.h"

namespace semslam {
namespace {

constexpr int kMaxDigitBits = 11;
constexpr std::size_t kNumChunks = 8;

// Where the items of each digit go, for each chunk of the items on its own.
using Places = std::array<std::uint32_t, std::size_t{1} << kMaxDigitBits>;

std::uint64_t BitsOf(const KeyedIndex& item) { return item.key; }
std::uint64_t BitsOf(std::uint64_t item) { return item; }

// One pass: orders the items by one digit of their bits, equal ones as they were.
template <typename Item>
void SortByDigit(const LargeVector<Item>& items,
                 int shift,
                 std::uint64_t mask,
                 int num_threads,
                 std::vector<Places>& places,
                 LargeVector<Item>& sorted) {
  const auto for_chunks = [&](const auto& body) {
    ParallelFor(kNumChunks, 1, num_threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t chunk = begin; chunk < end; ++chunk) {
        const std::size_t first = items.size() * chunk / kNumChunks;
        const std::size_t last = items.size() * (chunk + 1) / kNumChunks;
        for (std::size_t i = first; i < last; ++i) {
          body(items[i], places[chunk][BitsOf(items[i]) >> shift & mask]);
        }
      }
    });
  };
  for (Places& chunk : places) chunk.fill(0);
  for_chunks([](const Item&, std::uint32_t& count) { ++count; });
  std::uint32_t sum = 0;
  for (std::size_t digit = 0; digit <= mask; ++digit) {
    for (Places& chunk : places) {
      const std::uint32_t count = chunk[digit];
      chunk[digit] = sum;
      sum += count;
    }
  }
  for_chunks([&](const Item& item, std::uint32_t& place) { sorted[place++] = item; });
}

template <typename Item>
void Sort(LargeVector<Item>& items, int first_bit, int num_bits, int num_threads) {
  const int num_passes = (num_bits + kMaxDigitBits - 1) / kMaxDigitBits;
  if (num_passes == 0 || items.empty()) return;
  const int digit_bits = (num_bits + num_passes - 1) / num_passes;
  LargeVector<Item> sorted(items.size());
  std::vector<Places> places(kNumChunks);
  for (int pass = 0; pass < num_passes; ++pass) {
    const int num_left = std::min(digit_bits, num_bits - pass * digit_bits);
    const std::uint64_t mask = (std::uint64_t{1} << num_left) - 1;
    SortByDigit(items, first_bit + pass * digit_bits, mask, num_threads, places, sorted);
    items.swap(sorted);
  }
}

}  // namespace

void RadixSort(LargeVector<KeyedIndex>& items, int num_bits, int num_threads) {
  Sort(items, 0, num_bits, num_threads);
}

void RadixSort(LargeVector<std::uint64_t>& items, int first_bit, int num_bits, int num_threads) {
  Sort(items, first_bit, num_bits, num_threads);
}

}  // namespace semslam
