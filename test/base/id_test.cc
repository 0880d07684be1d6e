// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/id.h"

#include <type_traits>
#include <unordered_set>

#include <gtest/gtest.h>

namespace semslam {
namespace {

static_assert(!std::is_convertible_v<KeyframeId, LandmarkId>);
static_assert(!std::is_convertible_v<int, KeyframeId>);
static_assert(!std::is_convertible_v<KeyframeId, std::uint32_t>);

TEST(Id, IsOrderedByItsNumber) {
  EXPECT_LT(KeyframeId{2}, KeyframeId{10});
  EXPECT_EQ(KeyframeId{7}, KeyframeId{7});
  EXPECT_NE(KeyframeId{7}, KeyframeId{8});
}

TEST(Id, WorksAsAKeyOfHashTables) {
  std::unordered_set<LandmarkId> ids;
  for (std::uint32_t i = 0; i < 100; ++i) ids.insert(LandmarkId{i % 10});
  EXPECT_EQ(ids.size(), 10u);
  EXPECT_TRUE(ids.contains(LandmarkId{9}));
  EXPECT_FALSE(ids.contains(LandmarkId{10}));
}

}  // namespace
}  // namespace semslam
