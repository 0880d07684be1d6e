// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace semslam {

// Stands for "no depth" where a column in the virtual right camera, u - bf / depth, is asked for.
// Near things have true columns left of the image, so that no negative number could stand for it.
inline constexpr float kNoRightX = std::numeric_limits<float>::lowest();

}  // namespace semslam
