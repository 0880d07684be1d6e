// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/render/scene.h"

namespace semslam {

// Ways to make the materials and meshes that objects are put together from.

// A picture that covers `width` x `height` metres of surface, then repeats.
Material Printed(Picture picture, float width, float height);
// One colour with a highlight.
Material Plastic(const Eigen::Vector3f& color, float specular = 0.15F);
// One colour with the fine grain of moulded plastic.
Material GrainyPlastic(const Eigen::Vector3f& color, std::uint64_t seed);

// A rectangle that stands upright and looks along -y, centred at `center`; uv from its lower left.
TriangleMesh MakeUpright(float width, float height, const Eigen::Vector3f& center);
// Turned about an axis through the origin, then moved.
TriangleMesh Placed(TriangleMesh mesh,
                    const Eigen::Vector3f& rotation_vector,
                    const Eigen::Vector3f& offset);

}  // namespace semslam
