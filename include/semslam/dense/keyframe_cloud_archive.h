// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "semslam/base/binary_stream.h"
#include "semslam/dense/keyframe_cloud.h"

namespace semslam {

void WriteKeyframeCloud(const KeyframeCloud& cloud, BinaryWriter* writer);

// Throws InputError if the bytes are no cloud of the camera that the rays belong to.
std::shared_ptr<const KeyframeCloud> ReadKeyframeCloud(BinaryReader* reader,
                                                       std::shared_ptr<const RayTable> rays);

}  // namespace semslam
