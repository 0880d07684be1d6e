// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/duplicates.h"

#include <gmock/gmock.h>

namespace semslam {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A cup in two pieces, segments 1 and 2: points of both in the box of the first.
class DuplicatesTest : public ::testing::Test {
 protected:
  DuplicatesTest() {
    segmentation_.segments.resize(2);
    for (int i = 0; i < 30; ++i) Add(1, {0.002F * static_cast<float>(i), 0, 0});
    for (int i = 0; i < 10; ++i) Add(2, {0.002F * static_cast<float>(i), 0.02F, 0});
    for (SegmentId segment = 1; segment <= 2; ++segment) {
      SemanticObject object;
      object.class_id = 4;
      object.segments = {segment};
      object.num_points = segment == 1 ? 30 : 10;
      object.box.half_size = {0.1, 0.05, 0.05};
      objects_.push_back(object);
    }
  }

  void Add(SegmentId segment, const Eigen::Vector3f& position) {
    cloud_.positions.push_back(position);
    segmentation_.segment_of_point.push_back(segment);
  }

  std::vector<SegmentPair> Find() const {
    return FindDuplicates(objects_, cloud_, SegmentPoints(segmentation_), evidence_);
  }

  MapCloud cloud_;
  Segmentation segmentation_;
  Evidence evidence_;
  std::vector<SemanticObject> objects_;
};

TEST_F(DuplicatesTest, ArePiecesOfOneClassInsideTheLargersBox) {
  EXPECT_THAT(Find(), ElementsAre(SegmentPair(1, 2)));
}

TEST_F(DuplicatesTest, AreOfOneClass) {
  objects_[1].class_id = 5;
  EXPECT_THAT(Find(), IsEmpty());
}

TEST_F(DuplicatesTest, AreNotSideBySide) {
  objects_[0].box.half_size.y() = 0.005;
  EXPECT_THAT(Find(), IsEmpty());
}

TEST_F(DuplicatesTest, WereNotSeenInBoxesOfTheirOwn) {
  evidence_.num_separate_boxes[{1, 2}] = 2;
  EXPECT_THAT(Find(), IsEmpty());
  evidence_.num_shared_boxes[{1, 2}] = 2;
  EXPECT_THAT(Find(), ElementsAre(SegmentPair(1, 2)));
}

}  // namespace
}  // namespace semslam
