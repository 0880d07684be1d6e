// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/cell_votes.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <gmock/gmock.h>

namespace semslam {
namespace {

using ::testing::ElementsAre;

// The n-th cell of a row along x.
Cell InRow(int n) { return VoxelKey::Pack({n, -3, 7}); }

// Cells [first, last] of the row, one of them twice.
std::vector<Cell> Row(int first, int last) {
  std::vector<Cell> cells = {InRow(last)};
  for (int n = first; n <= last; ++n) cells.push_back(InRow(n));
  return cells;
}

TEST(CellOf, RoundsDown) { EXPECT_EQ(CellOf({0.01F, -0.01F, 0.03F}), VoxelKey::Pack({0, -1, 1})); }

TEST(ForEachNeighbour, VisitsTheCubeAroundInOrder) {
  std::vector<Cell> visited;
  ForEachNeighbour(VoxelKey::Pack({0, 0, 0}), [&](Cell cell) { visited.push_back(cell); });
  ASSERT_EQ(visited.size(), 27U);
  EXPECT_EQ(visited.front(), VoxelKey::Pack({-1, -1, -1}));
  EXPECT_EQ(visited[13], VoxelKey::Pack({0, 0, 0}));
  EXPECT_TRUE(std::is_sorted(visited.begin(), visited.end()));
}

TEST(CellVotes, FindThePlaceThatMostBoxesHold) {
  CellVotes votes;
  for (int box = 0; box < 5; ++box) votes.AddBox(Row(2, 4));
  for (int box = 0; box < 3; ++box) votes.AddBox(Row(3, 6));
  for (int box = 0; box < 2; ++box) votes.AddBox(Row(7, 7));
  const std::optional<Place> place = votes.TakePlace();
  ASSERT_TRUE(place.has_value());
  EXPECT_THAT(place->core, ElementsAre(InRow(2), InRow(3), InRow(4)));
  EXPECT_THAT(place->reach,
              ElementsAre(InRow(2), InRow(3), InRow(4), InRow(5), InRow(6), InRow(7)));
  EXPECT_FALSE(votes.TakePlace().has_value());
}

TEST(CellVotes, TellThingsApartOneAfterTheOther) {
  CellVotes votes;
  for (int box = 0; box < 3; ++box) votes.AddBox(Row(0, 1));
  for (int box = 0; box < 4; ++box) votes.AddBox(Row(5, 6));
  EXPECT_THAT(votes.TakePlace().value().core, ElementsAre(InRow(5), InRow(6)));
  EXPECT_THAT(votes.TakePlace().value().core, ElementsAre(InRow(0), InRow(1)));
  EXPECT_FALSE(votes.TakePlace().has_value());
}

TEST(CellVotes, CountABoxOnce) {
  CellVotes votes;
  for (int box = 0; box < 2; ++box) votes.AddBox(Row(0, 0));  // Twice in each.
  EXPECT_FALSE(votes.TakePlace().has_value());
}

}  // namespace
}  // namespace semslam
