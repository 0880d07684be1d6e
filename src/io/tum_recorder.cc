// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/tum_recorder.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "semslam/base/error.h"
#include "semslam/base/time.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/png_writer.h"

namespace semslam {
namespace {

namespace fs = std::filesystem;

fs::path PrepareFolder(const fs::path& folder) {
  CheckOutputFolder(folder);
  std::error_code error;
  if (!fs::is_empty(folder, error))
    throw InputError(folder.string() + ": expected a new or empty folder, found files in it");
  CheckOutputFolder(folder / "rgb");
  CheckOutputFolder(folder / "depth");
  return folder;
}

void Append(const fs::path& path, const std::string& line) {
  std::ofstream file(path, std::ios::app);
  file << line << '\n';
  file.flush();
  if (!file) throw InputError(path.string() + ": cannot be written; is the disk full?");
}

}  // namespace

void TumRecorder::Options::Validate() const {
  if (!(depth_factor > 0) || !std::isfinite(depth_factor))
    throw std::invalid_argument("depth_factor must be positive");
  if (queue_capacity == 0) throw std::invalid_argument("queue_capacity must be positive");
}

TumRecorder::TumRecorder(const fs::path& folder, const Options& options)
    : folder_((options.Validate(), PrepareFolder(folder))),
      options_(options),
      stage_({.queue_capacity = options.queue_capacity, .is_background = !options.waits},
             [this](const RgbdImage& image) { Write(image); }) {}

void TumRecorder::Add(const RgbdImage& image) {
  if (options_.waits) {
    stage_.Submit(image);
  } else if (!stage_.TrySubmit(image) && !stage_.failed()) {
    statistics_.Write([](Statistics& statistics) { ++statistics.num_dropped; });
  }
}

TumRecorder::Statistics TumRecorder::Finish() {
  std::optional<std::string> error;
  try {
    stage_.Finish();
  } catch (const InputError& stopped) {
    error = stopped.what();
  }
  Statistics statistics = statistics_.Read([](const Statistics& all) { return all; });
  statistics.error = error;
  return statistics;
}

void TumRecorder::Write(const RgbdImage& image) {
  const std::string time = FormatTime(image.time);
  WritePng(folder_ / "rgb" / (time + ".png"), image.color, PngContent::kPhoto);
  WritePng(folder_ / "depth" / (time + ".png"), DepthFromMetres(image.depth, options_.depth_factor),
           PngContent::kFlat);
  AppendToLists(time);
  statistics_.Write([](Statistics& statistics) { ++statistics.num_frames; });
}

void TumRecorder::AppendToLists(const std::string& time) {
  const std::string color = time + " rgb/" + time + ".png";
  const std::string depth = time + " depth/" + time + ".png";
  Append(folder_ / "rgb.txt", color);
  Append(folder_ / "depth.txt", depth);
  Append(folder_ / "associations.txt", color + " " + depth);
}

cv::Mat DepthFromMetres(const cv::Mat& depth, double depth_factor) {
  cv::Mat values(depth.size(), CV_16UC1);
  const auto factor = static_cast<float>(depth_factor);
  for (int row = 0; row < depth.rows; ++row) {
    const auto* const metres = depth.ptr<float>(row);
    auto* const value = values.ptr<std::uint16_t>(row);
    for (int column = 0; column < depth.cols; ++column) {
      const float rounded = metres[column] * factor + 0.5F;
      const bool fits = rounded >= 0 && rounded <= std::numeric_limits<std::uint16_t>::max();
      value[column] = fits ? static_cast<std::uint16_t>(rounded) : std::uint16_t{0};
    }
  }
  return values;
}

}  // namespace semslam
