// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "segment_picture.h"

#include <algorithm>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "semslam/io/atomic_file.h"
#include "semslam/io/map_picture.h"

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
  std::vector<unsigned char> png;
  cv::imencode(".png", panels, png);
  semslam::WriteFileAtomically(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}
