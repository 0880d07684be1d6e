// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/eval/true_boxes.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace semslam {
namespace {

// A metre before the camera a metre is 500 pixels, and 7 mm are 4 (rounded up).
class TrueBoxes : public ::testing::Test {
 protected:
  // A cube with 0.2 m edges around the optical axis, its front 1 m away: 100 x 100 pixels.
  static InstanceRecord Cube(std::uint32_t id, const std::string& class_name) {
    return {id, class_name, {{Eigen::Quaterniond::Identity(), {0, 0, 1.1}}, {0.1, 0.1, 0.1}}};
  }

  void Paint(const cv::Rect& rect, int id) { cv::rectangle(labels_, rect, id, cv::FILLED); }

  std::vector<TrueBox> Find(const std::vector<InstanceRecord>& instances) const {
    const PinholeCamera camera(
        {.width = 640, .height = 480, .fx = 500, .fy = 500, .cx = 319.5, .cy = 239.5});
    return FindTrueBoxes(labels_, instances, ClassTable({"cup", "mouse"}), {}, camera);
  }

  cv::Mat labels_ = cv::Mat::zeros(480, 640, CV_16UC1);
};

TEST_F(TrueBoxes, EncloseTheVisiblePixels) {
  Paint({270, 190, 100, 80}, 3);
  const std::vector<TrueBox> boxes = Find({Cube(3, "mouse")});
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_EQ(boxes[0].class_id, 1);
  EXPECT_FALSE(boxes[0].is_hard);
  EXPECT_EQ(boxes[0].box.min_x, 270);
  EXPECT_EQ(boxes[0].box.min_y, 190);
  EXPECT_EQ(boxes[0].box.max_x, 370);
  EXPECT_EQ(boxes[0].box.max_y, 270);
}

TEST_F(TrueBoxes, AreOfTheTablesClassesOnly) {
  Paint({270, 190, 100, 80}, 1);
  Paint({100, 190, 100, 80}, 2);
  EXPECT_EQ(Find({Cube(1, "book"), Cube(2, "mug")}).size(), 1U);
}

TEST_F(TrueBoxes, LeaveOutACableButNotAHandle) {
  Paint({270, 190, 100, 80}, 1);
  Paint({370, 220, 90, 3}, 1);
  EXPECT_EQ(Find({Cube(1, "mouse")}).at(0).box.max_x, 370);
  Paint({370, 220, 90, 6}, 1);
  EXPECT_EQ(Find({Cube(1, "mouse")}).at(0).box.max_x, 460);
}

TEST_F(TrueBoxes, AreHardWhereLittleOfTheWholeIsVisible) {
  // The cube's outline has 100 x 100 pixels.
  Paint({270, 190, 20, 70}, 1);
  EXPECT_FALSE(Find({Cube(1, "cup")}).at(0).is_hard);
  labels_ = 0;
  Paint({270, 190, 20, 50}, 1);
  EXPECT_TRUE(Find({Cube(1, "cup")}).at(0).is_hard);
}

TEST_F(TrueBoxes, AreHardWhereFewOrOnlyThinPixelsAreVisible) {
  const InstanceRecord far_cup = {
      1, "cup", {{Eigen::Quaterniond::Identity(), {0, 0, 5}}, {0.05, 0.05, 0.05}}};
  Paint({300, 200, 16, 10}, 1);
  EXPECT_FALSE(Find({far_cup}).at(0).is_hard);
  labels_ = 0;
  Paint({300, 200, 14, 10}, 1);  // 140 pixels.
  EXPECT_TRUE(Find({far_cup}).at(0).is_hard);
  labels_ = 0;
  Paint({300, 200, 30, 7}, 1);
  EXPECT_TRUE(Find({far_cup}).at(0).is_hard);
}

TEST_F(TrueBoxes, AreNotOfATraceOrOfNothing) {
  EXPECT_TRUE(Find({Cube(1, "cup")}).empty());
  Paint({300, 200, 4, 4}, 1);
  EXPECT_TRUE(Find({Cube(1, "cup")}).empty());
}

}  // namespace
}  // namespace semslam
