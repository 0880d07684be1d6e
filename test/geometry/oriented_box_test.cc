// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/geometry/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

namespace semslam {
namespace {

OrientedBox Box(const Eigen::Vector3d& center,
                const Eigen::Vector3d& half_size,
                const Eigen::Vector3d& rotation_vector = Eigen::Vector3d::Zero()) {
  return {{ExpSO3(rotation_vector), center}, half_size};
}

OrientedBox Move(const Rigid3& T_a_b, OrientedBox box) {
  box.T_world_box = T_a_b * box.T_world_box;
  return box;
}

// By throwing points into the first box.
double MonteCarloIou(const OrientedBox& a, const OrientedBox& b, int num_points) {
  Random random(99);
  int num_inside = 0;
  for (int i = 0; i < num_points; ++i) {
    const Eigen::Vector3d p_box(random.Uniform(-1, 1) * a.half_size.x(),
                                random.Uniform(-1, 1) * a.half_size.y(),
                                random.Uniform(-1, 1) * a.half_size.z());
    num_inside += b.Contains(a.T_world_box * p_box) ? 1 : 0;
  }
  const double intersection = a.Volume() * num_inside / num_points;
  return intersection / (a.Volume() + b.Volume() - intersection);
}

TEST(OrientedBox, ContainsWhatIsWithinItsOwnAxes) {
  const OrientedBox box = Box({1, 0, 0}, {2, 0.5, 0.5}, {0, 0, 0.785398163397});
  EXPECT_TRUE(box.Contains({2.3, 1.3, 0}));
  EXPECT_FALSE(box.Contains({2.3, -1.3, 0}));
}

TEST(IntersectionOverUnion, IsOneForTheSameBox) {
  const OrientedBox box = Box({1, 2, 3}, {0.3, 0.2, 0.1}, {0.3, -0.5, 1.2});
  EXPECT_NEAR(IntersectionOverUnion(box, box), 1.0, 1e-12);
}

TEST(IntersectionOverUnion, IsZeroForBoxesApartOrTouching) {
  const OrientedBox box = Box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(IntersectionOverUnion(box, Box({5, 0, 0}, {1, 1, 1})), 0.0);
  EXPECT_NEAR(IntersectionOverUnion(box, Box({2, 0, 0}, {1, 1, 1})), 0.0, 1e-9);
  // Their spheres meet, the boxes do not.
  EXPECT_EQ(IntersectionOverUnion(box, Box({1.9, 1.9, 0}, {1, 1, 1}, {0, 0, 0.7853981634})), 0.0);
}

// Objects that stand on one table share the planes of faces.
TEST(IntersectionOverUnion, CountsSharedFacePlanesOnce) {
  const Eigen::Vector3d half(0.5, 0.5, 0.5);
  const OrientedBox box = Box({0, 0, 0}, half);
  EXPECT_NEAR(IntersectionOverUnion(box, Box({0.5, 0, 0}, half)), 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(IntersectionOverUnion(box, Box({0.5, 0.5, 0}, half)), 1.0 / 7.0, 1e-9);
  EXPECT_NEAR(IntersectionOverUnion(box, Box({0, 0, 0.25}, {0.5, 0.5, 0.75})), 2.0 / 3.0, 1e-9);
}

TEST(IntersectionOverUnion, OfABoxInsideAnotherIsTheRatioOfVolumes) {
  const OrientedBox outer = Box({0, 0, 0}, {1, 1, 1});
  const OrientedBox inner = Box({0.1, 0, 0}, {0.2, 0.3, 0.4}, {0.5, 0.4, 0.3});
  EXPECT_NEAR(IntersectionOverUnion(outer, inner), inner.Volume() / outer.Volume(), 1e-9);
  EXPECT_NEAR(IntersectionOverUnion(inner, outer), inner.Volume() / outer.Volume(), 1e-9);
}

TEST(IntersectionOverUnion, OfASquareTurnedByAnEighthIsAnOctagon) {
  const OrientedBox a = Box({0, 0, 0}, {1, 1, 1});
  const OrientedBox b = Box({0, 0, 0}, {1, 1, 1}, {0, 0, 0.78539816339744831});
  const double intersection = 2.0 * 8.0 * (std::sqrt(2.0) - 1.0);  // Height times octagon.
  EXPECT_NEAR(IntersectionOverUnion(a, b), intersection / (16.0 - intersection), 1e-9);
}

TEST(IntersectionOverUnion, IsSmoothThroughTinyRotations) {
  const OrientedBox a = Box({0, 0, 0}, {0.5, 0.5, 0.5});
  for (double angle = 1e-13; angle < 1e-5; angle *= 3) {
    const OrientedBox b = Box({0.5, 0, 0}, {0.5, 0.5, 0.5}, {angle, angle, -angle});
    EXPECT_NEAR(IntersectionOverUnion(a, b), 1.0 / 3.0, 1e-8 + 4 * angle) << angle;
  }
}

TEST(IntersectionOverUnion, AgreesWithCountingRandomPoints) {
  Random random(1);
  const auto vector = [&](double scale) {
    return Eigen::Vector3d(scale * random.Gaussian(), scale * random.Gaussian(),
                           scale * random.Gaussian());
  };
  const auto size = [&] {
    return Eigen::Vector3d(random.Uniform(0.1, 0.6), random.Uniform(0.1, 0.6),
                           random.Uniform(0.1, 0.6));
  };
  double largest = 0;
  for (int i = 0; i < 30; ++i) {
    const OrientedBox a = Box(vector(0.2), size(), vector(1));
    const OrientedBox b = Box(vector(0.2), size(), vector(1));
    const double iou = IntersectionOverUnion(a, b);
    EXPECT_NEAR(iou, MonteCarloIou(a, b, 20'000), 0.015) << "pair " << i;
    largest = std::max(largest, iou);
  }
  EXPECT_GT(largest, 0.2);  // The pairs were no trivial ones.
}

TEST(IntersectionOverUnion, DoesNotChangeWhenBothMoveOrSwap) {
  const OrientedBox a = Box({0, 0, 0}, {0.3, 0.2, 0.1}, {0.1, 0.2, 0.3});
  const OrientedBox b = Box({0.1, 0.1, 0}, {0.2, 0.2, 0.2}, {-0.4, 0.2, 0.1});
  const Rigid3 motion{ExpSO3({1, 2, -1}), {10, -20, 5}};
  const double iou = IntersectionOverUnion(a, b);
  EXPECT_NEAR(IntersectionOverUnion(b, a), iou, 1e-9);
  EXPECT_NEAR(IntersectionOverUnion(Move(motion, a), Move(motion, b)), iou, 1e-9);
}

TEST(IntersectionOverUnion, IsZeroForFlatBoxes) {
  const OrientedBox flat = Box({0, 0, 0}, {1, 1, 0});
  EXPECT_EQ(IntersectionOverUnion(flat, flat), 0.0);
}

TEST(FitOrientedBox, FindsTheBoxItsPointsWereDrawnFrom) {
  const OrientedBox truth = Box({1, -2, 3}, {0.6, 0.3, 0.1}, {0.4, 1.0, -0.6});
  Random random(2);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20'000; ++i) {
    points.push_back(truth.T_world_box * Eigen::Vector3d(random.Uniform(-0.6, 0.6),
                                                         random.Uniform(-0.3, 0.3),
                                                         random.Uniform(-0.1, 0.1)));
  }
  const OrientedBox box = FitOrientedBox(points);
  EXPECT_LT((box.half_size - truth.half_size).norm(), 0.02);
  EXPECT_GT(IntersectionOverUnion(box, truth), 0.9);
}

TEST(FitOrientedBox, EnclosesEveryPointWithARotation) {
  Random random(3);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    points.emplace_back(random.Gaussian(), 2 * random.Gaussian(), 0.1 * random.Gaussian());
  }
  OrientedBox box = FitOrientedBox(points);
  EXPECT_NEAR(box.T_world_box.rotation.norm(), 1.0, 1e-12);
  box.half_size.array() += 1e-9;
  for (const Eigen::Vector3d& point : points) EXPECT_TRUE(box.Contains(point));
}

TEST(FitOrientedBox, IsEmptyForNoPointsAndFlatForOne) {
  EXPECT_EQ(FitOrientedBox({}).Volume(), 0.0);
  const std::vector<Eigen::Vector3d> one{{1, 2, 3}};
  const OrientedBox box = FitOrientedBox(one);
  EXPECT_EQ(box.half_size, Eigen::Vector3d::Zero());
  EXPECT_LT((box.T_world_box.translation - one[0]).norm(), 1e-12);
}

}  // namespace
}  // namespace semslam
