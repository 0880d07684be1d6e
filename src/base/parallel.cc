// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/parallel.h"

#include <algorithm>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#ifdef SEMSLAM_TELL_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace semslam {
namespace {

// What was done before Give is seen after Take. TBB sees to that; this tells the thread sanitizer,
// which cannot look into TBB.
class Handover {
 public:
#ifdef SEMSLAM_TELL_THREAD_SANITIZER
  void Give() { __tsan_release(this); }
  void Take() { __tsan_acquire(this); }
#else
  void Give() {}
  void Take() {}
#endif
};

// Enough to balance uneven work, few enough for a body that needs scratch memory of its own.
constexpr std::size_t kMaxChunks = 256;

}  // namespace

void ParallelFor(std::size_t count,
                 std::size_t grain,
                 int num_threads,
                 const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  const std::size_t num_chunks =
      std::clamp<std::size_t>(count / std::max<std::size_t>(grain, 1), 1, kMaxChunks);
  const std::size_t size = count / num_chunks;
  const std::size_t num_longer = count % num_chunks;  // The first chunks hold one item more.
  const auto run_chunk = [&](std::size_t chunk) {
    const std::size_t first = chunk * size + std::min(chunk, num_longer);
    body(first, first + size + (chunk < num_longer ? 1 : 0));
  };
  if (num_threads == 1 || num_chunks == 1) {
    for (std::size_t chunk = 0; chunk < num_chunks; ++chunk) run_chunk(chunk);
    return;
  }
  // TBB complains on stderr about more threads than cores.
  const int num_cores = tbb::info::default_concurrency();
  tbb::task_arena arena(num_threads <= 0 ? num_cores : std::min(num_threads, num_cores));
  Handover to_chunks;
  Handover from_chunks;
  to_chunks.Give();
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, num_chunks, [&](std::size_t chunk) {
      to_chunks.Take();
      run_chunk(chunk);
      from_chunks.Give();
    });
  });
  from_chunks.Take();
}

}  // namespace semslam
