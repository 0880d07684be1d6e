// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/patch_table.h"

namespace semslam {

PatchTable::PatchTable(const std::vector<Patch>& patches) : groups_((patches.size() + 3) / 4) {
  constexpr float kNowhere = 1e30F;
  for (std::size_t i = 0; i < 4 * groups_.size(); ++i) {
    FourPoints& group = groups_[i / 4];
    if (i < patches.size()) {
      group.Set(i % 4, patches[i].centroid.cast<float>(), patches[i].normal.cast<float>());
    } else {
      group.Set(i % 4, Eigen::Vector3f::Constant(kNowhere), Eigen::Vector3f::Zero());
    }
  }
}

}  // namespace semslam
