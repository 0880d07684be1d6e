// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/live/openni2_source.h"

#include <stdexcept>
#include <utility>

#include "live/source_reader.h"

namespace semslam {

void OpenNi2Source::Options::Validate() const {
  if (width <= 0 || height <= 0) throw std::invalid_argument("image size must be positive");
  if (fps <= 0) throw std::invalid_argument("fps must be positive");
  if (duration && *duration <= 0) throw std::invalid_argument("duration must be positive");
  if (!(stall_seconds > 0) || !(start_seconds > 0) || !(patience_seconds >= 0))
    throw std::invalid_argument("waiting times must be positive");
}

OpenNi2Source::OpenNi2Source(Options options) {
  options.Validate();
  reader_ = std::make_unique<Reader>(std::move(options));
}

OpenNi2Source::~OpenNi2Source() = default;

std::optional<RgbdImage> OpenNi2Source::Next() { return reader_->Next(); }

std::optional<std::size_t> OpenNi2Source::NumFrames() const { return reader_->NumFrames(); }

std::optional<std::string> OpenNi2Source::failure() const { return reader_->failure(); }

double OpenNi2Source::SecondsSinceArrival() const { return reader_->SecondsSinceArrival(); }

OpenNi2Source::Statistics OpenNi2Source::statistics() const { return reader_->statistics(); }

std::string OpenNi2Source::description() const { return reader_->description(); }

bool OpenNi2Source::is_recording() const { return reader_->is_file(); }

std::optional<PinholeCamera::Parameters> OpenNi2Source::NominalIntrinsics() const {
  return reader_->nominal_intrinsics();
}

}  // namespace semslam
