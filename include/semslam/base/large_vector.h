// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace semslam {

constexpr std::size_t kCacheLine = 64;  // Bytes.

// Memory for a large array, in huge pages where the system has them (hundreds of times fewer page
// faults; far places without a search in the page tables). It begins with a cache line. Throws
// std::bad_alloc.
void* AllocateLarge(std::size_t num_bytes);
void FreeLarge(void* memory) noexcept;

template <typename T>
class LargeAllocator {
 public:
  static_assert(alignof(T) <= kCacheLine);
  using value_type = T;

  LargeAllocator() = default;
  template <typename Other>
  explicit LargeAllocator(const LargeAllocator<Other>& /*other*/) {}

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) {
      throw std::bad_array_new_length();
    }
    return static_cast<T*>(AllocateLarge(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { FreeLarge(memory); }

  // Elements that get no value keep none: what is written anyway need not be cleared first.
  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const LargeAllocator& /*a*/, const LargeAllocator& /*b*/) { return true; }
};

// For arrays of megabytes. Numbers in one that is made or grown by its size alone have no value
// until they are written.
template <typename T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace semslam
