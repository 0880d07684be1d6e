// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core/types.hpp>

#include "semslam/render/scene.h"

namespace semslam {

// Of a picture for so many metres; never more than 1024 on a side.
cv::Size PixelsFor(float width, float height, float pixels_per_metre);

// Ways to make the materials and meshes that objects are put together from.

// A picture that covers `width` x `height` metres of surface, then repeats.
Material Printed(Picture picture, float width, float height);
// One colour with a highlight.
Material Plastic(const Eigen::Vector3f& color, float specular = 0.15F);
// One colour with the fine grain of moulded plastic.
Material GrainyPlastic(const Eigen::Vector3f& color, std::uint64_t seed);

// Wood with the grain along u, slightly glossy.
Material Wooden(const Eigen::Vector3f& color, std::uint64_t seed);
// Woven cloth.
Material Woven(const Eigen::Vector3f& color, std::uint64_t seed);

// A smooth line through the points (Catmull and Rom's): for cables and bent tubes.
std::vector<Eigen::Vector3f> SmoothLine(const std::vector<Eigen::Vector3f>& points);
// A box that stands on the given point with the middle of its lower face.
TriangleMesh BoxOn(const Eigen::Vector3f& size, const Eigen::Vector3f& bottom);
TriangleMesh RoundedBoxOn(const Eigen::Vector3f& size, float radius, const Eigen::Vector3f& bottom);
// A rectangle that stands upright and looks along -y, centred at `center`; uv from its lower left.
TriangleMesh MakeUpright(float width, float height, const Eigen::Vector3f& center);
// Turned about an axis through the origin, then moved.
TriangleMesh Placed(TriangleMesh mesh,
                    const Eigen::Vector3f& rotation_vector,
                    const Eigen::Vector3f& offset);

}  // namespace semslam
