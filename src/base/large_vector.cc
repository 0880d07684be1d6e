// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/large_vector.h"

#include <cstdlib>

#include <sys/mman.h>

namespace semslam {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;  // Of x86-64 and of most others.

}  // namespace

void* AllocateLarge(std::size_t num_bytes) {
  const bool is_large = num_bytes >= kHugePage;
  void* memory = nullptr;
  // From the heap, which keeps for the next array what was freed.
  if (::posix_memalign(&memory, is_large ? kHugePage : kCacheLine, num_bytes) != 0) {
    throw std::bad_alloc();
  }
  if (is_large) ::madvise(memory, num_bytes, MADV_HUGEPAGE);  // If refused, it is only slower.
  return memory;
}

void FreeLarge(void* memory) noexcept { std::free(memory); }

}  // namespace semslam
