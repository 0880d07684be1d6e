// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/map/landmark_projection.h"

#include <cmath>

#include <gtest/gtest.h>

namespace semslam {
namespace {

class LandmarkProjectionTest : public ::testing::Test {
 protected:
  // Seen from the origin at (0.2, 0.1, 2), range 1 to 3 m, along z.
  LandmarkAppearance Landmark() const {
    LandmarkAppearance landmark;
    landmark.p_world = {0.2, 0.1, 2};
    landmark.view_direction = Eigen::Vector3f::UnitZ();
    landmark.min_distance = 1;
    landmark.max_distance = 3;
    landmark.descriptor.bits = {1, 2, 3, 4};
    return landmark;
  }
  std::optional<LandmarkProjection> Project(const LandmarkAppearance& landmark,
                                            const Rigid3& T_world_camera = {}) const {
    return ProjectLandmark({camera_, 40.0, ScaleSpace()}, T_world_camera, landmark);
  }

  PinholeCamera camera_{{.width = 640, .height = 480, .fx = 500, .fy = 510, .cx = 320, .cy = 240}};
};

TEST_F(LandmarkProjectionTest, SaysWhereTheLandmarkShouldBe) {
  const auto projection = Project(Landmark());
  ASSERT_TRUE(projection);
  EXPECT_NEAR(projection->point.pixel.x(), 320 + 50, 1e-4);
  EXPECT_NEAR(projection->point.pixel.y(), 240 + 25.5, 1e-4);
  EXPECT_NEAR(projection->point.right_x, 370 - 20, 1e-4);
  EXPECT_EQ(projection->point.descriptor, Landmark().descriptor);
  EXPECT_NEAR(projection->view_cosine, 2 / Landmark().p_world.norm(), 1e-6);
}

TEST_F(LandmarkProjectionTest, ExpectsACoarserLevelFromNearer) {
  LandmarkAppearance landmark = Landmark();
  landmark.min_distance = 0.1F;
  const double distance = landmark.p_world.norm();
  for (int octave = 0; octave < 8; ++octave) {
    // A little less than the distance at which the level is exactly `octave`.
    landmark.max_distance =
        static_cast<float>(distance * std::pow(1.2, static_cast<double>(octave) - 0.1));
    const auto projection = Project(landmark);
    ASSERT_TRUE(projection) << octave;
    EXPECT_EQ(projection->point.max_octave, octave);
    EXPECT_EQ(projection->point.min_octave, std::max(0, octave - 1));
    EXPECT_NEAR(projection->point.radius, std::pow(1.2, octave), 1e-4);
  }
}

TEST_F(LandmarkProjectionTest, GivesNothingBehindTheCamera) {
  EXPECT_FALSE(Project(Landmark(), {Eigen::Quaterniond::Identity(), {0, 0, 2.5}}));
  EXPECT_FALSE(Project(Landmark(), {Eigen::Quaterniond::Identity(), {0, 0, 2.0}}));
}

TEST_F(LandmarkProjectionTest, GivesNothingOutsideTheImage) {
  EXPECT_TRUE(Project(Landmark(), {ExpSO3({0, 0.6, 0}), {0, 0, 0}}));
  EXPECT_FALSE(Project(Landmark(), {ExpSO3({0, 0.75, 0}), {0, 0, 0}}));
  EXPECT_FALSE(Project(Landmark(), {ExpSO3({0.6, 0, 0}), {0, 0, 0}}));
}

TEST_F(LandmarkProjectionTest, GivesNothingFromTooFarOrTooNear) {
  LandmarkAppearance landmark = Landmark();
  const auto distance = static_cast<float>(landmark.p_world.norm());
  for (const auto& [factor, visible] : {std::pair{1.19F, true}, {1.21F, false}}) {
    landmark.max_distance = distance / factor;
    landmark.min_distance = 0.1F;
    EXPECT_EQ(Project(landmark).has_value(), visible) << factor;
  }
  for (const auto& [factor, visible] : {std::pair{0.81F, true}, {0.79F, false}}) {
    landmark.min_distance = distance / factor;
    landmark.max_distance = 10;
    EXPECT_EQ(Project(landmark).has_value(), visible) << factor;
  }
}

TEST_F(LandmarkProjectionTest, GivesNothingFromMoreThan60DegreesAside) {
  LandmarkAppearance landmark = Landmark();
  landmark.p_world = {0, 0, 2};
  for (const auto& [degrees, visible] : {std::pair{59.0, true}, {61.0, false}, {180.0, false}}) {
    const double angle = degrees * M_PI / 180;
    landmark.view_direction = Eigen::Vector3d(std::sin(angle), 0, std::cos(angle)).cast<float>();
    EXPECT_EQ(Project(landmark).has_value(), visible) << degrees;
  }
}

}  // namespace
}  // namespace semslam
