// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace semslam {

// Calls body(first, last) for consecutive chunks of [0, count) on up to `num_threads` threads (0:
// as many as there are cores; 1: in the caller's thread, in order). A chunk holds `grain` items at
// least, unless there are fewer in all; the chunks are the same on any number of threads. The body
// writes to slots of its own, so that the result does not depend on which thread runs when. An
// exception of the body reaches the caller.
void ParallelFor(std::size_t count,
                 std::size_t grain,
                 int num_threads,
                 const std::function<void(std::size_t first, std::size_t last)>& body);

}  // namespace semslam
