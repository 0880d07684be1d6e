// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/live/openni2_source.h"

#include "support/files.h"

namespace semslam::testing {

// Images of a quarter of the usual width: faults do not depend on it.
inline constexpr int kCameraWidth = 160;
inline constexpr int kCameraHeight = 120;

// Reads so many frames, or all up to the end.
inline std::vector<RgbdImage> Read(OpenNi2Source& source, std::size_t max_frames = 10000) {
  std::vector<RgbdImage> images;
  while (images.size() < max_frames) {
    std::optional<RgbdImage> image = source.Next();
    if (!image) break;
    images.push_back(*std::move(image));
  }
  return images;
}

// The camera of driver/, with a script for as long as this lives. One at a time.
class VirtualCamera {
 public:
  explicit VirtualCamera(const std::string& script) {
    const std::string size = std::to_string(kCameraWidth) + " " + std::to_string(kCameraHeight);
    const std::filesystem::path path = folder_.Write("camera.txt", "size " + size + "\n" + script);
    // Before the threads of OpenNI2 start.
    ::setenv("SEMSLAM_TEST_CAMERA", path.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
  }

  const TemporaryFolder& folder() const { return folder_; }

  // For this camera, with less patience than users have.
  OpenNi2Source::Options Options() {
    OpenNi2Source::Options options;
    options.width = kCameraWidth;
    options.height = kCameraHeight;
    options.stall_seconds = 0.2;
    options.start_seconds = 0.6;
    options.patience_seconds = 5;
    options.log = [this](LogLevel, std::string_view, std::string_view message) {
      messages_.Write([&](std::vector<std::string>& all) { all.emplace_back(message); });
    };
    return options;
  }

  // What the source said.
  std::vector<std::string> messages() const {
    return messages_.Read([](const std::vector<std::string>& all) { return all; });
  }

 private:
  TemporaryFolder folder_;
  Guarded<std::vector<std::string>> messages_;
};

}  // namespace semslam::testing
