// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include <Eigen/Core>

#include "semslam/base/binary_stream.h"
#include "semslam/geometry/rigid3.h"

namespace semslam {

// What is read back has the very bits that were written. Reading throws InputError for numbers that
// are not finite and rotations that are not of unit norm; `what` names the thing.
void WriteVector(const Eigen::Vector3d& vector, BinaryWriter* writer);
Eigen::Vector3d ReadVector(BinaryReader* reader, std::string_view what);
void WriteRigid3(const Rigid3& pose, BinaryWriter* writer);
Rigid3 ReadRigid3(BinaryReader* reader, std::string_view what);

}  // namespace semslam
