// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include "semslam/camera/pinhole_camera.h"
#include "semslam/map/map.h"
#include "semslam/optim/camera_model.h"

namespace semslam {

// What every step of local mapping needs.
struct MappingContext {
  const PinholeCamera& camera;
  const StereoCamera& stereo;
  SharedMap& map;
};

}  // namespace semslam
