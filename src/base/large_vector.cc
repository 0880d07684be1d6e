// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/large_vector.h"

#include <cstdlib>

#include <sys/mman.h>

namespace semslam {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;  // Of x86-64 and of most others.

bool IsLarge(std::size_t num_bytes) { return num_bytes >= kHugePage; }

}  // namespace

void* AllocateLarge(std::size_t num_bytes) {
  if (!IsLarge(num_bytes)) return ::operator new(num_bytes);
  void* memory = nullptr;
  // From the heap, which keeps for the next array what was freed.
  if (::posix_memalign(&memory, kHugePage, num_bytes) != 0) throw std::bad_alloc();
  ::madvise(memory, num_bytes, MADV_HUGEPAGE);  // If refused, the array is only slower.
  return memory;
}

void FreeLarge(void* memory, std::size_t num_bytes) noexcept {
  if (IsLarge(num_bytes)) {
    std::free(memory);
  } else {
    ::operator delete(memory);
  }
}

}  // namespace semslam
