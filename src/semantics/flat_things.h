// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "semslam/dense/map_cloud.h"
#include "semslam/semantics/evidence.h"

#include "semantics/keyframe_view.h"

namespace semslam {

// Takes flat things out of the large planes they lie on: a keyboard or a mouse that the geometry
// alone did not tell from the desk. Where boxes of one class keep being filled by a
// segment that is too large for it (Evidence says which), what rises above the surface around it
// there becomes a segment of its own, with a number after all others. Nothing if there is no such
// place. Does not depend on the order of keyframes.
std::optional<Segmentation> TakeOutFlatThings(const MapCloud& cloud,
                                              const Segmentation& segmentation,
                                              std::span<const SeenKeyframe> keyframes,
                                              const Evidence& evidence,
                                              const ClassTable& classes);

}  // namespace semslam
