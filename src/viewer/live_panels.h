// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "semslam/viewer/live_source.h"

#include "viewer/image_texture.h"

namespace semslam {

inline constexpr float kSidePanelWidth = 300;  // Pixels of an ordinary screen.

// The newest frame with its keypoints, and the newest image in which something was detected.
class CameraPanel {
 public:
  // Below `top`, at the left.
  void Draw(const LiveSource& source, float scale, float top);

 private:
  void DrawFrame(const LiveFrame& frame, float width);
  void DrawDetections(const LiveDetections& detections, float width);

  ImageTexture frame_picture_;
  std::optional<std::size_t> frame_number_;
  ImageTexture detection_picture_;
  std::shared_ptr<const LiveDetections> detections_;
};

// Frame rate, times of the steps, queues, memory; all over time.
class SpeedPanel {
 public:
  // At the right. Where it ends.
  float Draw(const LiveSource& source, const LiveStatus& status, float scale, float window_width);

 private:
  void Sample(const LiveStatus& status);

  std::vector<float> frames_per_second_;
  std::vector<float> memory_;
  std::vector<std::vector<float>> queues_;
};

// Pictures of the selected object.
class SightingsPanel {
 public:
  // Asks the source if the object is another one than before.
  void Select(const LiveSource& source, const ObjectRecord* object);
  void Draw(float width) const;

 private:
  std::optional<std::uint32_t> object_;
  std::vector<std::unique_ptr<ImageTexture>> pictures_;
  std::vector<std::string> titles_;
};

}  // namespace semslam
