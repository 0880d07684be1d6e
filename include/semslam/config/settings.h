// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/dense/keyframe_cloud.h"
#include "semslam/dense/voxel_map.h"
#include "semslam/features/orb_extractor.h"
#include "semslam/loop/loop_closing.h"
#include "semslam/mapping/local_mapping.h"
#include "semslam/segmentation/segmenter.h"
#include "semslam/semantics/semantic_map.h"
#include "semslam/tracking/tracking.h"

namespace semslam {

// Which network looks for which objects. The program's command line can say the same.
struct DetectorSettings {
  // Darknet's cfg or an ONNX file; empty: no detector. Relative paths start at the settings file's
  // folder.
  std::filesystem::path config;
  std::filesystem::path weights;     // Darknet's.
  std::filesystem::path names;       // One class name a line.
  std::vector<std::string> classes;  // Of interest; empty: all.
  double score_threshold = 0.25;
  double nms_threshold = 0.45;  // Overlap above which the weaker detection of a class is dropped.
  int input_size = 0;     // Pixels; 0: as the network's file says, 640 if that leaves it open.
  int batch_size = 1;     // Waiting keyframes that are looked at together.
  bool letterbox = true;  // Images keep their proportions; else they are stretched.
  std::string backend = "opencv";  // What computes: see semantics/network_options.h.
  std::string target = "cpu";
};

// Whether and how drift is corrected where the camera comes back.
struct LoopSettings {
  bool enabled = true;
  LoopClosing::Options closing;
  // Of the whole map, after each loop. What the pose graph leaves is more than the noise: it takes
  // more robust steps than a local adjustment before outliers can be told.
  BundleOptions bundle{.robust_iterations = 20};
  bool final_bundle = false;  // One more at the end of the run.
};

// All that a settings file says. The fields' defaults are those of the optional keys; what has no
// sensible default must be in the file. config/README.md lists every key.
struct Settings {
  PinholeCamera::Parameters camera;
  double fps = 30;                 // Frames per second of the recording.
  double bf = 40;                  // Baseline times fx, pixels * metres.
  double close_depth_factor = 40;  // ThDepth: a depth is close if below this many baselines.
  double depth_factor = 5000;      // Value of a depth pixel at 1 m.
  bool is_rgb = true;              // Camera.RGB; images from files say their order themselves.
  bool auto_exposure = true;       // Camera.autoExposure; of live cameras, and white balance.
  OrbExtractor::Options orb;       // ORBextractor.*
  Tracking::Options tracking;      // Its close_depth_m and frame rate are set from the above.
  LocalMapping::Options mapping;   // The same.
  LoopSettings loop;               // LoopClosing.*

  // PointCloudMapping.*, Segmentation.*, SemanticMap.*
  KeyframeCloud::Options cloud;
  VoxelMap::Options voxels;
  Segmenter::Options segmentation;
  FusionOptions fusion;

  DetectorSettings detector;  // Detector.*

  // What the file holds that nothing here asks for; to be shown to the user once.
  std::vector<std::string> warnings;

  std::string text;  // The file as it is; maps keep it.

  // Depths below this are close (m).
  double CloseDepth() const { return close_depth_factor * bf / camera.fx; }
};

// Reads a settings file, as it comes with ORB-SLAM2 (TUM1.yaml ...) or with more keys of ours.
// Throws InputError naming file, key, what was found and what is allowed.
Settings LoadSettings(const std::filesystem::path& path);
// The same from the text of a file; `path` stands in the messages, and relative paths start at its
// folder.
Settings ParseSettings(const std::filesystem::path& path, std::string text);

}  // namespace semslam
