// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "semslam/viewer/draw_list.h"

namespace semslam {

// What looks the same in a run's window and in a saved map's picture.
inline constexpr LineStyle kTrajectoryStyle{
    .color = {255, 176, 32}, .alpha = 0.95F, .width = 2.0F, .hidden_share = 0.25F};
inline constexpr LineStyle kKeyframeStyle{
    .color = {120, 185, 255}, .alpha = 0.75F, .width = 1.2F, .hidden_share = 0.15F};

}  // namespace semslam
