// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/config/settings.h"

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
  file.Require("ThDepth", &settings.close_depth_factor, Range::Positive());
  file.Require("DepthMapFactor", &settings.depth_factor, Range::Positive());
}

void ReadOrb(SettingsFile& file, Settings::Orb& orb) {
  file.Require("ORBextractor.nFeatures", &orb.num_features, Range::Between(1, 100000));
  file.Require("ORBextractor.scaleFactor", &orb.scale_factor, Range::Between(1.01, 4));
  file.Require("ORBextractor.nLevels", &orb.num_levels, Range::Between(1, 32));
  file.Require("ORBextractor.iniThFAST", &orb.initial_threshold, Range::Between(1, 255));
  file.Require("ORBextractor.minThFAST", &orb.minimum_threshold,
               Range::Between(1, orb.initial_threshold));
}

}  // namespace

Settings LoadSettings(const std::filesystem::path& path) {
  SettingsFile file(path);
  Settings settings;
  ReadCamera(file, settings);
  ReadOrb(file, settings.orb);
  settings.warnings = file.UnknownKeys();
  return settings;
}

}  // namespace semslam
