// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "semslam/base/guarded.h"
#include "semslam/base/stage.h"
#include "semslam/camera/rgbd_image.h"

namespace semslam {

// Writes frames as a sequence in the format of the TUM RGB-D benchmark, which TumDataset reads:
// rgb/, depth/, rgb.txt, depth.txt, associations.txt. Images are compressed in a thread of its own;
// the lists grow with them, so that what was written before a crash can be read. Add and Finish
// belong to one thread.
class TumRecorder {
 public:
  struct Options {
    double depth_factor = 5000;       // Value of a depth pixel at 1 m.
    std::size_t queue_capacity = 30;  // Frames that may wait for the disk; 2 MB each.
    bool waits = false;               // Add waits for room; else it drops the frame.
    void Validate() const;            // Throws std::invalid_argument.
  };

  struct Statistics {
    std::size_t num_frames = 0;        // Written.
    std::size_t num_dropped = 0;       // Came faster than they could be written.
    std::optional<std::string> error;  // Why it stopped, if it did.
  };

  // The folder must be new, or empty. Throws InputError.
  TumRecorder(const std::filesystem::path& folder, const Options& options);

  // Once something could not be written, nothing more is.
  void Add(const RgbdImage& image);
  // Writes what waits. Once, after the last frame.
  Statistics Finish();

 private:
  void Write(const RgbdImage& image);
  void AppendToLists(const std::string& time);

  const std::filesystem::path folder_;
  const Options options_;
  Guarded<Statistics> statistics_;
  Stage<RgbdImage> stage_;  // Last: it uses the rest.
};

// Depth in metres as 16-bit values of 1 / depth_factor metres; 0, for none, where they do not fit.
cv::Mat DepthFromMetres(const cv::Mat& depth, double depth_factor);

}  // namespace semslam
