// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "semslam/camera/rgbd_image.h"

namespace semslam {

// Where frames come from: a recorded sequence, a camera, a fault-injecting wrapper in tests.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  // The next frame in time; nothing at the end. Throws InputError if this frame cannot be read; the
  // source stays usable and the next call goes on with the frame after it.
  virtual std::optional<RgbdImage> Next() = 0;

  // Number of frames in all, where it is known beforehand.
  virtual std::optional<std::size_t> NumFrames() const { return std::nullopt; }
};

}  // namespace semslam
