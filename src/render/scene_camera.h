// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/render/camera_path.h"

#include "render/scene_layout.h"
#include "render/scene_node.h"
#include "render/scene_values.h"

namespace semslam {

// The file's `camera`: waypoints, closed, seconds_per_waypoint or speed, sway, sway_angle, from.
CameraPath ReadCameraPath(const SceneNode& node, const SceneLayout& layout, SceneDice& dice);

}  // namespace semslam
