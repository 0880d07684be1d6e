// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "semslam/base/error.h"
#include "semslam/base/time.h"
#include "semslam/camera/frame_source.h"

namespace semslam::testing {

// What goes wrong with some frames of a recording, or of a camera. Frames are numbered from 0 as
// the source without faults gives them.
struct Fault {
  enum class Kind {
    kDropped,
    kRepeated,    // Comes twice.
    kSwapped,     // Comes after the frame that follows it.
    kUnreadable,  // Like a truncated file: the source throws InputError and goes on.
    kBlack,       // No light; depth as ever.
    kNoDepth,
    kCovered,   // A hand on the lens: dark, without depth.
    kExposure,  // Brightness times `amount`.
    kTimeJump,  // From `first` on to the end the clock is `amount` seconds ahead.
  };
  Kind kind = Kind::kDropped;
  std::size_t first = 0;
  std::size_t count = 1;
  double amount = 0;

  bool Concerns(std::size_t frame) const { return frame >= first && frame - first < count; }
};

// Another source with faults. The other one must outlive this.
class FaultySource : public FrameSource {
 public:
  FaultySource(FrameSource& source, std::vector<Fault> faults)
      : source_(source), faults_(std::move(faults)) {}

  std::optional<RgbdImage> Next() override {
    while (waiting_.empty()) {
      std::optional<RgbdImage> image = source_.Next();
      if (!image && !held_back_) return std::nullopt;
      if (image) Take(*std::move(image), next_++);
      const bool is_due = held_back_ && (!waiting_.empty() || !image);
      if (is_due) waiting_.push_back(*std::exchange(held_back_, std::nullopt));
    }
    RgbdImage image = std::move(waiting_.front());
    waiting_.pop_front();
    return image;
  }

 private:
  void Take(RgbdImage image, std::size_t frame) {
    const auto is = [&](Fault::Kind kind) { return Find(kind, frame) != nullptr; };
    for (const Fault& fault : faults_) {
      if (fault.kind == Fault::Kind::kTimeJump && frame >= fault.first)
        image.time += FromSeconds(fault.amount);
    }
    if (is(Fault::Kind::kDropped)) return;
    if (is(Fault::Kind::kUnreadable))
      throw InputError("frame " + std::to_string(frame) + ": PNG image is truncated");
    if (is(Fault::Kind::kBlack)) image.color = Zeros(image.color.size(), CV_8UC3);
    if (is(Fault::Kind::kNoDepth)) image.depth = Zeros(image.depth.size(), CV_32FC1);
    if (const Fault* const exposure = Find(Fault::Kind::kExposure, frame)) {
      cv::Mat color;
      image.color.convertTo(color, CV_8UC3, exposure->amount);
      image.color = color;
    }
    if (is(Fault::Kind::kCovered)) Cover(frame, &image);
    if (is(Fault::Kind::kSwapped)) {
      held_back_ = std::move(image);
      return;
    }
    if (is(Fault::Kind::kRepeated)) waiting_.push_back(image);
    waiting_.push_back(std::move(image));
  }

  // A new image: assigning cv::Mat::zeros() would write into the one that the source still has.
  static cv::Mat Zeros(cv::Size size, int type) { return {size, type, cv::Scalar(0)}; }

  // What a sensor shows of a hand: its own noise.
  static void Cover(std::size_t frame, RgbdImage* image) {
    cv::RNG random(frame + 1);
    cv::Mat noise(image->color.size(), CV_8UC3);
    random.fill(noise, cv::RNG::NORMAL, 6, 2);
    image->color = noise;
    image->depth = Zeros(image->depth.size(), CV_32FC1);
  }

  const Fault* Find(Fault::Kind kind, std::size_t frame) const {
    for (const Fault& fault : faults_) {
      if (fault.kind == kind && fault.Concerns(frame)) return &fault;
    }
    return nullptr;
  }

  FrameSource& source_;
  const std::vector<Fault> faults_;
  std::size_t next_ = 0;
  std::optional<RgbdImage> held_back_;
  std::deque<RgbdImage> waiting_;
};

}  // namespace semslam::testing
