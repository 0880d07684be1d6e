// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/io/instances_io.h"
#include "semslam/semantics/class_table.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// Where a rendered object shows in a picture.
struct TrueBox {
  int class_id = kNoClass;
  ImageBox box;          // Around what is visible of it.
  bool is_hard = false;  // So little shows that it need not be found, and is no mistake if it is.
};

// scripts/train_detector/render_data.py draws the boxes that are learned by the same rules.
struct TrueBoxOptions {
  // Boxes are drawn as people draw them: around a mouse without its cable. Thinner parts do not
  // count, metres.
  double min_thickness = 0.007;
  int min_pixels = 150;  // Visible pixels; an object with fewer is hard,
  float min_side = 8;    // and so is one with a smaller box, pixels,
  double min_visible_part =
      0.12;            // or of whose outline less is visible, in and out of the picture.
  int min_trace = 20;  // With fewer pixels there is nothing.
};

// The boxes of the instances whose classes are in the table, by id. `labels`: CV_16UC1, ids of
// instances.
std::vector<TrueBox> FindTrueBoxes(const cv::Mat& labels,
                                   const std::vector<InstanceRecord>& instances,
                                   const ClassTable& classes,
                                   const Rigid3& T_world_camera,
                                   const PinholeCamera& camera,
                                   const TrueBoxOptions& options = {});

}  // namespace semslam
