// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "features/orb_pattern.h"

#include <gtest/gtest.h>

#include "features/orb_pattern_probe.h"

namespace semslam {
namespace {

TEST(OrbPattern, IsTheOneThatOpenCvCompares) {
  const std::vector<BriefPair> recovered = RecoverOrbPattern();
  ASSERT_EQ(recovered.size(), OrbPattern().size());
  for (std::size_t bit = 0; bit < recovered.size(); ++bit) {
    const BriefPair& pair = recovered[bit];
    EXPECT_EQ(pair, OrbPattern()[bit])
        << "bit " << bit << ": {" << int{pair.first_x} << ", " << int{pair.first_y} << ", "
        << int{pair.second_x} << ", " << int{pair.second_y} << "}";
  }
}

}  // namespace
}  // namespace semslam
