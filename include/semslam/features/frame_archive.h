// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "semslam/base/binary_stream.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/features/frame.h"

namespace semslam {

void WriteFrame(const Frame& frame, BinaryWriter* writer);

// `bounds` are the camera's, for the grid. Throws InputError for numbers that no frame has.
std::shared_ptr<const Frame> ReadFrame(BinaryReader* reader,
                                       const PinholeCamera::Bounds& bounds,
                                       int num_levels);

}  // namespace semslam
