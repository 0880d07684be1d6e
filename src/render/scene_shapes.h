// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/geometry/rigid3.h"
#include "semslam/render/mesh.h"

#include "render/scene_node.h"
#include "render/scene_values.h"

namespace semslam {

// The largest number in a place or a size, metres.
constexpr double kMaxSceneSize = 100;

// `shape: box` and what belongs to it. The mesh stands on z = 0, centred.
TriangleMesh ReadShape(MapReader& reader, SceneDice& dice);

// yaw (about z), pitch (about x) and roll (about y) in degrees: first roll, then pitch, then yaw.
struct SceneAngles {
  double yaw = 0;
  Eigen::Quaterniond tilt = Eigen::Quaterniond::Identity();  // Roll and pitch.

  Eigen::Quaterniond Rotation() const;
};
SceneAngles ReadAngles(MapReader& reader, SceneDice& dice);

}  // namespace semslam
