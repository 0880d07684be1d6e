// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "semslam/map/map.h"

#include "support/synthetic_frames.h"

namespace semslam::testing {

// A camera that turns on a small circle inside a world that is all around it, more than once, and
// drifts: a map with a loop to close, whose truth is known. Keyframe i of the map is number i; they
// are added one by one, as local mapping hands them on.
class RingWalk {
 public:
  struct Options {
    int num_keyframes_a_round = 36;
    int num_keyframes = 46;
    // Error of each step: rotation vector, translation.
    Vector6d drift_a_step = Vector6d::Zero();
    double pixel_noise = 0.5;
    int lost_before = -1;  // This keyframe is the first of another piece of the map.
  };

  explicit RingWalk(const Options& options)
      : options_(options),
        world_({.num_points = 8000, .pixel_noise = options.pixel_noise, .all_around = true}),
        vocabulary_(world_.Train()),
        map_(std::make_unique<SharedMap>()) {}

  bool is_finished() const { return num_added_ == options_.num_keyframes; }
  KeyframeId AddKeyframe() {
    const int i = num_added_++;
    Rigid3 T_world_camera;
    if (i == options_.lost_before) {
      landmark_of_.clear();
      T_world_camera = PoseOf(i - 1);
    } else if (i > 0) {
      // From where the map has the last one now: it may have been corrected.
      T_world_camera =
          PoseOf(i - 1) * Retract(Truth(i - 1).Inverse() * Truth(i), options_.drift_a_step);
    }
    Add(i, T_world_camera);
    return {static_cast<std::uint32_t>(i)};
  }

  SharedMap& map() { return *map_; }
  const PinholeCamera& camera() const { return world_.camera(); }
  std::shared_ptr<const Vocabulary> vocabulary() const { return vocabulary_; }
  const SyntheticWorld& world() const { return world_; }

  // Relative to the first keyframe, as the map is.
  Rigid3 Truth(int keyframe) const { return PoseInWorld(0).Inverse() * PoseInWorld(keyframe); }
  // How far a keyframe is from the truth, metres.
  double ErrorOf(int keyframe) const {
    return (PoseOf(keyframe).translation - Truth(keyframe).translation).norm();
  }
  Rigid3 PoseOf(int keyframe) const {
    return map_->Read([&](const Map& map) {
      return *map.ResolvePose(KeyframeId{static_cast<std::uint32_t>(keyframe)});
    });
  }
  double LargestError() const {
    double largest = 0;
    for (int i = 0; i < num_added_; ++i) largest = std::max(largest, ErrorOf(i));
    return largest;
  }
  // The same point is one landmark only while it stays in view: odometry knows no return.
  static constexpr int kMemory = 8;

 private:
  Rigid3 PoseInWorld(int keyframe) const {
    const double angle = 2 * std::numbers::pi * keyframe / options_.num_keyframes_a_round;
    return {ExpSO3({0, angle, 0}), 0.8 * Eigen::Vector3d(std::sin(angle), 0, std::cos(angle))};
  }

  void Add(int number, const Rigid3& T_world_camera) {
    const SyntheticView view = world_.Look(number, PoseInWorld(number));
    map_->Write([&](Map& map) {
      const KeyframeId id = map.AddKeyframe(view.frame, T_world_camera);
      for (std::size_t i = 0; i < view.points.size(); ++i) {
        const auto feature = static_cast<int>(i);
        if (const auto known = FindKnown(map, view.points[i], number)) {
          if (!map.Sees(id, *known)) map.AddObservation(*known, {id, feature});
          continue;
        }
        const Keypoint& keypoint = view.frame->keypoints[i];
        const Eigen::Vector3d p_world =
            T_world_camera * camera().Unproject(keypoint.pixel.cast<double>(), keypoint.depth);
        landmark_of_[view.points[i]] = {map.AddLandmark(p_world, {id, feature}), number};
      }
      map.SetWords(
          id, std::make_shared<const BagOfWords>(vocabulary_->Transform(view.frame->descriptors)));
      if (number != options_.lost_before) map.ChooseParent(id);
    });
  }

  std::optional<LandmarkId> FindKnown(const Map& map, int point, int number) {
    const auto known = landmark_of_.find(point);
    if (known == landmark_of_.end() || known->second.last_seen + kMemory < number) return {};
    known->second.last_seen = number;
    return map.ResolveLandmark(known->second.landmark);
  }

  struct Known {
    LandmarkId landmark;
    int last_seen = 0;
  };

  Options options_;
  SyntheticWorld world_;
  std::shared_ptr<const Vocabulary> vocabulary_;
  std::unique_ptr<SharedMap> map_;
  int num_added_ = 0;
  std::map<int, Known> landmark_of_;  // By point of the world.
};

}  // namespace semslam::testing
