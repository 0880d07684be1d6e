// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/config/settings.h"

#include <sstream>

#include "semslam/config/settings_file.h"

namespace semslam {
namespace {

// A parameter is one line here, one in config/README.md, and its field with comment and unit.
using Range = NumberRange;

void ReadCamera(SettingsFile& file, Settings& settings) {
  PinholeCamera::Parameters& camera = settings.camera;
  constexpr double kMaxSize = 16384;
  file.Require("Camera.fx", &camera.fx, Range::Positive());
  file.Require("Camera.fy", &camera.fy, Range::Positive());
  file.Require("Camera.cx", &camera.cx);
  file.Require("Camera.cy", &camera.cy);
  file.Require("Camera.k1", &camera.k1);
  file.Require("Camera.k2", &camera.k2);
  file.Require("Camera.p1", &camera.p1);
  file.Require("Camera.p2", &camera.p2);
  file.Read("Camera.k3", &camera.k3);
  file.Require("Camera.width", &camera.width, Range::Between(1, kMaxSize));
  file.Require("Camera.height", &camera.height, Range::Between(1, kMaxSize));
  file.Require("Camera.fps", &settings.fps, Range::Positive());
  file.Require("Camera.bf", &settings.bf, Range::Positive());
  file.Read("Camera.RGB", &settings.is_rgb);
  constexpr double kMaxReadout = RollingShutter::kMaxReadoutSeconds;
  file.Read("Camera.readout", &settings.tracking.shutter.readout_seconds,
            Range::Between(-kMaxReadout, kMaxReadout));
  file.Read("Camera.autoExposure", &settings.auto_exposure);
  file.Require("ThDepth", &settings.close_depth_factor, Range::Positive());
  file.Require("DepthMapFactor", &settings.depth_factor, Range::Positive());
}

void ReadOrb(SettingsFile& file, OrbExtractor::Options& orb) {
  double scale_factor = orb.scale_factor;
  file.Require("ORBextractor.nFeatures", &orb.num_features, Range::Between(1, 100000));
  file.Require("ORBextractor.scaleFactor", &scale_factor, Range::Between(1.01, 4));
  file.Require("ORBextractor.nLevels", &orb.num_levels, Range::Between(1, 32));
  file.Require("ORBextractor.iniThFAST", &orb.initial_fast_threshold, Range::Between(1, 255));
  file.Require("ORBextractor.minThFAST", &orb.min_fast_threshold,
               Range::Between(1, orb.initial_fast_threshold));
  orb.scale_factor = static_cast<float>(scale_factor);
}

void ReadLoopClosing(SettingsFile& file, LoopSettings& loop) {
  file.Read("LoopClosing.enabled", &loop.enabled);
  file.Read("LoopClosing.finalBundleAdjustment", &loop.final_bundle);
}

void ReadPointCloudMapping(SettingsFile& file, Settings& settings) {
  DepthFilterOptions& depth = settings.cloud.depth;
  file.Read("PointCloudMapping.minDepth", &depth.min_depth, Range::Positive());
  file.Read("PointCloudMapping.maxDepth", &depth.max_depth, Range::Above(depth.min_depth));
  file.Read("PointCloudMapping.pixelStride", &settings.cloud.pixel_stride, Range::Between(1, 16));
  file.Read("PointCloudMapping.voxelSize", &settings.voxels.voxel_size, Range::Between(0.001, 1));
  int min_views = static_cast<int>(settings.voxels.min_views);
  file.Read("PointCloudMapping.minViews", &min_views, Range::Between(1, 1000));
  settings.voxels.min_views = static_cast<std::uint32_t>(min_views);
}

void ReadSegmentation(SettingsFile& file, Segmenter::Options& options) {
  file.Read("Segmentation.voxelSize", &options.supervoxels.voxel_size, Range::Between(0.001, 1));
  file.Read("Segmentation.seedSpacing", &options.supervoxels.seed_spacing,
            Range::Above(options.supervoxels.voxel_size));
  file.Read("Segmentation.planeTolerance", &options.planes.tolerance, Range::Between(0.001, 1));
  file.Read("Segmentation.minPlaneArea", &options.planes.min_area, Range::Positive());
  file.Read("Segmentation.minStructuralArea", &options.components.min_structural_area,
            Range::Positive());
}

void ReadSemanticMap(SettingsFile& file, FusionOptions& fusion) {
  file.Read("SemanticMap.minConfidence", &fusion.min_confidence, Range::Between(0, 1));
  int min_views = static_cast<int>(fusion.min_views);
  file.Read("SemanticMap.minViews", &min_views, Range::Between(1, 1000));
  fusion.min_views = static_cast<std::uint32_t>(min_views);
}

std::vector<std::string> SplitAtCommas(const std::string& list) {
  std::vector<std::string> items;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');) {
    if (!item.empty()) items.push_back(item);
  }
  return items;
}

void ReadDetector(SettingsFile& file,
                  const std::filesystem::path& folder,
                  DetectorSettings& detector) {
  const auto read_path = [&](const std::string& key, std::filesystem::path* path) {
    std::string text;
    file.Read(key, &text);
    if (!text.empty()) *path = folder / text;  // An absolute path replaces the folder.
  };
  read_path("Detector.config", &detector.config);
  read_path("Detector.weights", &detector.weights);
  read_path("Detector.names", &detector.names);
  std::string classes;
  file.Read("Detector.classes", &classes);
  detector.classes = SplitAtCommas(classes);
  file.Read("Detector.scoreThreshold", &detector.score_threshold, Range::Between(0, 1));
  file.Read("Detector.nmsThreshold", &detector.nms_threshold, Range::Between(0, 1));
  file.Read("Detector.inputSize", &detector.input_size, Range::Between(0, 4096));
  file.Read("Detector.batchSize", &detector.batch_size, Range::Between(1, 64));
  file.Read("Detector.letterbox", &detector.letterbox);
  file.Read("Detector.backend", &detector.backend);
  file.Read("Detector.target", &detector.target);
}

}  // namespace

Settings ParseSettings(const std::filesystem::path& path, std::string text) {
  SettingsFile file(path.string(), text);
  Settings settings;
  ReadCamera(file, settings);
  ReadOrb(file, settings.orb);
  ReadLoopClosing(file, settings.loop);
  ReadPointCloudMapping(file, settings);
  ReadSegmentation(file, settings.segmentation);
  ReadSemanticMap(file, settings.fusion);
  ReadDetector(file, path.parent_path(), settings.detector);
  settings.warnings = file.UnknownKeys();
  settings.text = std::move(text);
  return settings;
}

Settings LoadSettings(const std::filesystem::path& path) {
  return ParseSettings(path, ReadSettingsText(path));
}

}  // namespace semslam
