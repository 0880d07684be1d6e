// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/semantics/class_table.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// A keyframe, and what was detected in it.
struct DetectedView {
  Rigid3 T_world_camera;
  cv::Mat depth;  // As recorded: CV_32FC1, metres, 0 where there is none.
  std::vector<Detection> detections;
};

// The simple ways to bring boxes onto a cloud, to compare the fusion with. A view sees a point if
// the point projects onto a pixel whose depth agrees; the pixel is of the class of the box that it
// is in, without regard to what else the box holds. Not for several threads at once.
class LabelBaselines {
 public:
  struct Options {
    double max_depth_error = 0.02;    // Metres between point and pixel, plus
    double depth_error_at_1m = 0.01;  // this times z^2.
    void Validate() const;            // Throws std::invalid_argument.
  };

  // Points of the world, which must outlive this object.
  LabelBaselines(std::span<const Eigen::Vector3f> positions,
                 const PinholeCamera& camera,
                 std::size_t num_classes,
                 const Options& options);

  // In the order of time. Where boxes overlap, painting takes the last one in the list, as drawing
  // them one after the other does; the votes take the one of the highest score.
  void AddView(const DetectedView& view);

  // The three ways give a class id or kNoClass for each point.
  //
  // The last view that saw the point decides, as if the boxes had been painted into the images
  // before the cloud was made of them.
  const std::vector<int>& Painted() const { return painted_; }
  // What most of the views that saw the point say. Of equally many the lowest class; any class
  // before none.
  std::vector<int> PointVotes() const;
  // What most votes for the points of a segment say; points of segment 0 (none) have no class.
  std::vector<int> SegmentVotes(std::span<const std::uint32_t> segments) const;

 private:
  using Votes = std::span<const std::uint32_t>;
  // Column 0: no class; column c + 1: class c.
  Votes VotesOf(std::size_t point) const {
    return Votes(votes_).subspan(point * num_columns_, num_columns_);
  }

  std::span<const Eigen::Vector3f> positions_;
  PinholeCamera camera_;
  std::size_t num_columns_;
  Options options_;
  std::vector<int> painted_;
  std::vector<std::uint32_t> votes_;  // By point and column.
};

}  // namespace semslam
