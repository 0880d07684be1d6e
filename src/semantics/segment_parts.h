// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "semslam/dense/map_cloud.h"
#include "semslam/segmentation/segmenter.h"

namespace semslam {

// Makes a segment of some points of a segment, with a number after all others; not a structural
// one. The rest, which must not be empty, stays. Returns the new number.
SegmentId MakeSegment(std::span<const std::uint32_t> points,
                      SegmentId from,
                      const MapCloud& cloud,
                      Segmentation* segmentation);

}  // namespace semslam
