// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <opencv2/core/mat.hpp>

namespace semslam {

enum class StreamKind { kColor, kDepth };

// An image of one stream, as it came from the camera.
struct StreamImage {
  std::int64_t time_us = 0;  // Of the camera's clock.
  cv::Mat image;             // CV_8UC3 BGR, or CV_32FC1 metres.
};

struct ImagePair {
  StreamImage color;
  StreamImage depth;
};

// Finds which colour and which depth image belong together. Images of a kind come in the order of
// time. With a limit of half the frame period there is at most one partner within it, the nearest:
// so a pair is known when its second image comes, and nothing waits longer.
class FramePairer {
 public:
  explicit FramePairer(std::int64_t max_difference_us) : max_difference_us_(max_difference_us) {}

  std::optional<ImagePair> Add(StreamKind kind, StreamImage image);

  // Forgets what waits: after it the camera's clock may stand elsewhere.
  void Reset();

  std::size_t num_unpaired() const { return num_unpaired_; }

 private:
  const std::int64_t max_difference_us_;
  // The newest image, while it has no partner; never both.
  struct Waiting {
    StreamKind kind = StreamKind::kColor;
    StreamImage image;
  };
  std::optional<Waiting> waiting_;
  std::size_t num_unpaired_ = 0;
};

}  // namespace semslam
