// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "semslam/dense/map_cloud.h"
#include "semslam/segmentation/segmenter.h"

namespace semslam {

// Makes segments of some points of a segment, with numbers after all others; not structural ones.
// The parts have no point in common; the rest, which must not be empty, stays.
void MakeSegments(std::span<const std::vector<std::uint32_t>> parts,
                  SegmentId from,
                  const MapCloud& cloud,
                  Segmentation* segmentation);

}  // namespace semslam
