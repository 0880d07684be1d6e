// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/rigid3_archive.h"

#include <cmath>
#include <string>

namespace semslam {

void WriteVector(const Eigen::Vector3d& vector, BinaryWriter* writer) {
  for (int i = 0; i < 3; ++i) writer->Write(vector[i]);
}

Eigen::Vector3d ReadVector(BinaryReader* reader, std::string_view what) {
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) vector[i] = reader->ReadNumber(what);
  return vector;
}

void WriteRigid3(const Rigid3& pose, BinaryWriter* writer) {
  for (int i = 0; i < 4; ++i) writer->Write(pose.rotation.coeffs()[i]);
  WriteVector(pose.translation, writer);
}

Rigid3 ReadRigid3(BinaryReader* reader, std::string_view what) {
  constexpr double kTolerance = 1e-6;
  Rigid3 pose;
  for (int i = 0; i < 4; ++i) pose.rotation.coeffs()[i] = reader->ReadNumber(what);
  if (std::abs(pose.rotation.norm() - 1) > kTolerance) {
    reader->Fail("expected a rotation of norm 1 in the " + std::string(what) + ", found " +
                 std::to_string(pose.rotation.norm()));
  }
  pose.translation = ReadVector(reader, what);
  return pose;
}

}  // namespace semslam
