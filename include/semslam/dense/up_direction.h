// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>

namespace semslam {

// What is upwards in a map: the normal that most of its points have, for desks and floors are flat
// and level. Only normals within 60 degrees of `about_up` (the first camera's up) are asked, and
// the nearer they are to it the more they count: a camera that looks down steeply has the wall
// within the 60 degrees too. Unit length; nothing if no such normal is common.
//
// `normals`: unit length, towards the cameras; every n-th of very many is asked.
std::optional<Eigen::Vector3f> CommonUpNormal(std::span<const Eigen::Vector3f> normals,
                                              const Eigen::Vector3f& about_up);

}  // namespace semslam
