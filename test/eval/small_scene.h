// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/eval/clip_truth.h"
#include "semslam/eval/map_evaluation.h"

namespace semslam::testing {

// The truth of a made-up clip, surface by surface.
class SceneBuilder {
 public:
  explicit SceneBuilder(double spacing = 0.005) : spacing_(spacing) {}

  // A box on the axes of the world; of its six faces the lower one is not seen. Returns its id.
  std::uint32_t AddBox(const std::string& class_name,
                       const Eigen::Vector3d& center,
                       const Eigen::Vector3d& size) {
    const auto id = static_cast<std::uint32_t>(truth_.instances.size() + 1);
    truth_.instances.push_back(
        {id, class_name, {{Eigen::Quaterniond::Identity(), center}, 0.5 * size}});
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        if (size[axis] > 0 ? axis == 2 && side < 0 : side < 0 || axis != 2) continue;
        AddFace(id, center, size, axis, side);
      }
    }
    return id;
  }

  const ClipTruth& truth() {
    if (truth_.trajectory.empty()) AddTrajectory();
    return truth_;
  }

 private:
  // Samples in the middle of cells, so that faces share none.
  void AddFace(std::uint32_t id,
               const Eigen::Vector3d& center,
               const Eigen::Vector3d& size,
               int axis,
               double side) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const Eigen::Vector3d normal = side * Eigen::Vector3d::Unit(axis);
    for (double a = 0.5 * spacing_; a < size[u]; a += spacing_) {
      for (double b = 0.5 * spacing_; b < size[v]; b += spacing_) {
        Eigen::Vector3d point = center + 0.5 * size[axis] * normal;
        point[u] += a - 0.5 * size[u];
        point[v] += b - 0.5 * size[v];
        truth_.positions.push_back(point.cast<float>());
        truth_.normals.push_back(normal.cast<float>());
        truth_.instance_of_sample.push_back(id);
      }
    }
  }

  void AddTrajectory() {
    for (int i = 0; i < 60; ++i) {
      const double s = 0.1 * i;
      truth_.trajectory.push_back(
          {1000 * kNsPerSecond + i * 33'333'000,
           {ExpSO3({0.1 * s, 0.2, 0}), {std::sin(s), std::cos(s), 1.0 + 0.1 * s}}});
    }
  }

  double spacing_;
  ClipTruth truth_;
};

// A desk with a keyboard, two cups, a mouse, a box of no class, and a sheet of paper lying on it.
inline ClipTruth SmallDesk() {
  SceneBuilder scene;
  scene.AddBox("desk", {0, 0, 0}, {1.2, 0.6, 0});
  scene.AddBox("keyboard", {0, -0.1, 0.0125}, {0.4, 0.15, 0.025});
  scene.AddBox("cup", {-0.4, 0.1, 0.05}, {0.08, 0.08, 0.1});
  scene.AddBox("cup", {0.4, 0.1, 0.05}, {0.08, 0.08, 0.1});
  scene.AddBox("mouse", {0.35, -0.1, 0.02}, {0.06, 0.1, 0.04});
  scene.AddBox("box", {0.0, 0.2, 0.05}, {0.1, 0.1, 0.1});
  scene.AddBox("paper", {-0.45, -0.15, 0.001}, {0.15, 0.2, 0});
  return scene.truth();
}

// The numbers of the classes in results that are made from the truth.
inline const std::map<std::string, std::uint32_t>& LabelOfClass() {
  static const std::map<std::string, std::uint32_t> kLabels = {
      {"cup", 5}, {"keyboard", 3}, {"mouse", 9}, {"teddy bear", 2}, {"tvmonitor", 4}};
  return kLabels;
}

// The result of a run without any error: every sample is a point, with the right segment and label,
// and all objects are there.
inline MapResult PerfectResult(const ClipTruth& truth) {
  MapResult result;
  result.trajectory = truth.trajectory;
  result.positions = truth.positions;
  for (const auto& [name, label] : LabelOfClass()) result.classes.push_back({label, name, {}});
  const std::map<std::uint32_t, std::uint32_t> region = RegionOfInstance(truth);
  std::map<std::uint32_t, std::uint32_t> label_of_instance;
  for (const InstanceRecord& instance : truth.instances) {
    const auto label = LabelOfClass().find(instance.class_name);
    if (label == LabelOfClass().end()) continue;
    label_of_instance[instance.id] = label->second;
    const SeenPart part = FindSeenPart(truth, instance);
    if (part.num_samples == 0) continue;
    ObjectRecord object;
    object.id = static_cast<std::uint32_t>(result.objects.size() + 1);
    object.label = label->second;
    object.box = part.box;
    object.centroid = part.centroid;
    result.objects.push_back(object);
  }
  for (const std::uint32_t instance : truth.instance_of_sample) {
    const auto label = label_of_instance.find(instance);
    result.segments.push_back(region.at(instance) + 100);
    result.labels.push_back(label == label_of_instance.end() ? 0 : label->second);
  }
  return result;
}

inline void ExpectPerfect(const MapEvaluation& evaluation, double tolerance = 1e-9) {
  EXPECT_LT(evaluation.trajectory.absolute.max, 1e-6);
  EXPECT_LT(evaluation.surface.Quantile(1.0), 1e-6);
  EXPECT_EQ(evaluation.surface.num_off_surface, 0U);
  EXPECT_NEAR(evaluation.surface.completeness, 1.0, tolerance);
  EXPECT_NEAR(evaluation.segmentation.adjusted_rand_index, 1.0, tolerance);
  EXPECT_NEAR(evaluation.segmentation.over_segmentation, 0.0, tolerance);
  EXPECT_NEAR(evaluation.segmentation.under_segmentation, 0.0, tolerance);
  EXPECT_NEAR(evaluation.segmentation.coverage, 1.0, tolerance);
  EXPECT_NEAR(evaluation.boundaries.recall, 1.0, tolerance);
  EXPECT_NEAR(evaluation.boundaries.precision, 1.0, tolerance);
  EXPECT_NEAR(evaluation.labels.ObjectAccuracy(), 1.0, tolerance);
  EXPECT_NEAR(evaluation.labels.Accuracy(), 1.0, tolerance);
  EXPECT_NEAR(evaluation.labels.MeanIntersectionOverUnion(), 1.0, tolerance);
  EXPECT_NEAR(evaluation.bleeding.Share(), 0.0, tolerance);
  for (const ObjectScore& score : evaluation.objects) {
    EXPECT_DOUBLE_EQ(score.Precision(), 1.0);
    EXPECT_DOUBLE_EQ(score.Recall(), 1.0);
    EXPECT_DOUBLE_EQ(score.ClassAccuracy(), 1.0);
    EXPECT_LT(score.MedianCentroidError(), 1e-6);
    for (const ObjectMatch& match : score.matches) EXPECT_NEAR(match.overlap, 1.0, 1e-6);
  }
}

}  // namespace semslam::testing
