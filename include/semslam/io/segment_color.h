// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "semslam/dense/rgb.h"

namespace semslam {

// The same colour for the same id, always; neighbouring ids far apart on the colour circle. Grey
// for 0, which is no segment.
Rgb SegmentColor(std::uint32_t id);

}  // namespace semslam
