// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "semslam/base/large_vector.h"

namespace semslam {

struct KeyedIndex {
  std::uint64_t key = 0;
  std::uint32_t index = 0;
};

// Sorts by key; equal keys keep their order. `num_bits`: no key has a bit set from there on.
void RadixSort(LargeVector<KeyedIndex>& items, int num_bits, int num_threads);

// The same for keys that are the `num_bits` of a number from `first_bit` on.
void RadixSort(LargeVector<std::uint64_t>& items, int first_bit, int num_bits, int num_threads);

}  // namespace semslam
