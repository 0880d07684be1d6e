// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include <opencv2/core/mat.hpp>

#include "semslam/io/map_files.h"

namespace semslam {

struct MapPictureOptions {
  int panel_width = 720;   // Pixels, of each of the three panels.
  int panel_height = 540;  // Pixels, without title and legend.
  int supersampling = 2;   // Rendered so many times larger, then averaged.
  void Validate() const;   // Throws std::invalid_argument.
};

enum class MapPictureView {
  kTop,          // From straight above, the first camera's view direction upwards.
  kPerspective,  // From behind and above the first camera.
};

// Draws colour, segments and classes side by side, with titles, a legend, and the objects' boxes
// and names: CV_8UC3, BGR. In software: neither window system nor graphics card is needed. The same
// input gives the same pixels.
cv::Mat DrawMapPicture(const LabelledMapView& map,
                       MapPictureView view,
                       const MapPictureOptions& options = {});

// Writes semantic_map_top.png and semantic_map_view.png. Throws InputError.
void WriteMapPictures(const std::filesystem::path& folder,
                      const LabelledMapView& map,
                      const MapPictureOptions& options = {});

}  // namespace semslam
