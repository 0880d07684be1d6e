// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "semslam/geometry/plane.h"
#include "semslam/segmentation/options.h"

#include "segmentation/patches.h"

namespace semslam {

// Whether two patches continue each other: nearly the same normal, and each close to the tangent
// plane of the other.
bool IsFlush(const Patch& a, const Patch& b, const ComponentOptions& options);

// Large planes of real depth cameras are warped by centimetres: hysteresis. From every connected
// piece of a plane of `min_core_area`, patches without a plane take its label that continue it
// (IsFlush) and lie within `warp_tolerance` of the plane, the nearest first.
std::vector<std::uint32_t> GrowSurfaces(const PatchGraph& graph,
                                        const std::vector<Plane>& planes,
                                        std::vector<std::uint32_t> plane_labels,
                                        const ComponentOptions& options);

}  // namespace semslam
