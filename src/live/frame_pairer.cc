// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/frame_pairer.h"

#include <cstdlib>
#include <utility>

namespace semslam {

std::optional<ImagePair> FramePairer::Add(StreamKind kind, StreamImage image) {
  const bool fits = waiting_ && waiting_->kind != kind &&
                    std::abs(waiting_->image.time_us - image.time_us) <= max_difference_us_;
  if (fits) {
    StreamImage other = std::move(waiting_->image);
    waiting_.reset();
    if (kind == StreamKind::kColor) return ImagePair{std::move(image), std::move(other)};
    return ImagePair{std::move(other), std::move(image)};
  }
  if (waiting_) ++num_unpaired_;
  // Of two that do not fit only the later one may still find a partner.
  if (!waiting_ || waiting_->kind == kind || waiting_->image.time_us <= image.time_us)
    waiting_ = Waiting{kind, std::move(image)};
  return std::nullopt;
}

void FramePairer::Reset() {
  if (waiting_) ++num_unpaired_;
  waiting_.reset();
}

}  // namespace semslam
