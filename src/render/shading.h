// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "semslam/render/scene.h"

#include "render/lanes.h"
#include "render/surface.h"

namespace semslam {

// How much light reaches four points: the visible part (0 to 1) of each lamp, then of the
// surroundings.
constexpr std::size_t kMaxLights = 3;
using Lighting = std::array<Float4, kMaxLights + 1>;

// Light sent from the points `index` to `index` + 3 to the viewer (linear; x, y, z are B, G, R):
// Lambert's law plus Blinn's highlight. 0 where there is no surface.
Vector4 Shade(const Scene& scene,
              const SurfacePoints& points,
              std::size_t index,
              const Eigen::Vector3f& p_world_viewer,
              const Lighting& lighting);

}  // namespace semslam
