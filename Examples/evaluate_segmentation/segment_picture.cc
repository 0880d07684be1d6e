// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segment_picture.h"

#include <algorithm>

#include "semslam/io/map_picture.h"
#include "semslam/io/png_writer.h"

void WriteSegmentPicture(const std::filesystem::path& path, const semslam::CloudView& cloud) {
  constexpr double kPointSize = 0.008;  // Metres.
  semslam::LabelledMapView view;
  view.cloud = cloud;
  view.point_size = kPointSize;
  const semslam::MapPictureOptions options;
  const cv::Mat picture =
      semslam::DrawMapPicture(view, semslam::MapPictureView::kPerspective, options);
  // Of the three panels, the first two.
  const cv::Mat panels = picture.colRange(0, std::min(picture.cols, 2 * options.panel_width + 8));
  semslam::WritePng(path, panels, semslam::PngContent::kFlat);
}
