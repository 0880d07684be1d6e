// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include "semslam/viewer/map_scene.h"

namespace semslam {

// From where a map is seen.
enum class Viewpoint {
  kTop,          // Straight from above.
  kPerspective,  // From behind and above the first camera.
  kFront,        // As the first camera, level;
  kBack,         // the other way round,
  kLeft,         // and from its sides.
  kRight,
};

struct PictureOptions {
  int width = 1280;  // Pixels.
  int height = 800;
  Viewpoint from = Viewpoint::kPerspective;
  ColorMode color = ColorMode::kPhoto;
  bool eye_dome = true;
  bool legend = true;     // What the colours mean, where they mean something.
  int supersampling = 2;  // Drawn so many times larger, then averaged.
  OverlayOptions overlay;
  void Validate() const;  // Throws InputError.
};

// A picture of the map, drawn with OpenGL, without a window or a window system: CV_8UC3, BGR.
// Throws InputError if there is no OpenGL here. One at a time in a process.
cv::Mat TakePicture(const MapScene& scene, const PictureOptions& options);

// The way in which a viewpoint looks, as OrbitCamera has it.
struct ViewDirection {
  double azimuth = 0;
  double elevation = 0;
};
ViewDirection DirectionOf(Viewpoint viewpoint);

// What the colours of a map mean; nothing for kPhoto and kSegments.
std::vector<std::pair<std::string, Rgb>> ColorLegend(const LabelledMapView& map,
                                                     ColorMode mode,
                                                     const HeightRange& heights);

}  // namespace semslam
