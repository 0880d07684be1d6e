// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "semslam/render/clip.h"

namespace semslam {

// What a good detector might say of a rendered picture: the boxes of what is visible of each
// object, with a detector's small faults.
struct TrueDetection {
  int class_index = 0;  // Into Options::class_names.
  cv::Rect2d box;       // Pixels.
  double score = 0;     // 0 to 1.
};
struct DetectionOptions {
  std::vector<std::string> class_names = {"cup", "keyboard", "tvmonitor", "mouse", "teddy bear"};
  int min_pixels = 120;      // Visible parts smaller than this are not found.
  double miss_rate = 0.08;   // Part of the objects that is overlooked in a frame.
  double box_jitter = 0.02;  // Standard deviation of the box's sides, parts of its size.
};
std::vector<TrueDetection> DetectFromLabels(const cv::Mat& labels,
                                            const std::vector<Instance>& instances,
                                            std::uint64_t seed,
                                            std::uint64_t frame,
                                            const DetectionOptions& options);

// Writes a clip as a folder in the format of the TUM RGB-D benchmark, with its truth:
//   rgb/*.png  depth/*.png  rgb.txt  depth.txt  associations.txt  groundtruth.txt
//   settings.yaml     the camera and the stock ORB-SLAM2 keys
//   labels/*.png      16 bit: id of the instance in each pixel
//   instances.json    id, class and oriented box (world) of each instance
//   surface.pcd       exact points of the surface that was seen, 5 mm apart: position, normal, and
//                     the instance's id as label
//   detections/*.txt  `class_index cx cy w h score` a line, relative to the picture; classes.names
// The lists are written last: a folder without them is unfinished. An earlier clip in the folder is
// replaced; a folder that holds something else is refused. `progress` is called after every frame
// with the number of frames written, by one thread at a time but not always the same; what it
// throws ends the writing. Throws InputError if something cannot be written.
void WriteClip(const RenderedClip& clip,
               const std::filesystem::path& folder,
               const DetectionOptions& detections,
               const std::function<void(std::size_t num_written)>& progress = {});

}  // namespace semslam
