// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace semslam {

// A frame that is followed can do without news of the map, a camera cannot wait: whoever holds the
// map's lock, were it for a loop correction or because another program took its core, tracking asks
// again with the next frame. Most short holds are over by then.
constexpr std::chrono::microseconds kMaxMapWait(250);

}  // namespace semslam
