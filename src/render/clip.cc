// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/clip.h"

#include <cmath>

#include "semslam/base/check.h"
#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr TimeNs kStart = 1000 * kNsPerSecond;  // So that no time is 0, as in a real recording.
constexpr TimeNs kTick = 1000;                  // Times are whole microseconds: exact in TUM files.

const RenderedClip::Options& Checked(const RenderedClip::Options& options) {
  options.Validate();
  return options;
}

}  // namespace

void RenderedClip::Options::MakeClean() {
  color = ColorSensorOptions::Clean();
  depth = DepthSensorOptions::Clean();
}

void RenderedClip::Options::Validate() const {
  color.Validate();
  depth.Validate();
  if (num_frames < 1)
    throw InputError("frames: expected at least 1, found " + std::to_string(num_frames));
  if (!(fps > 0) || fps > 1e4)
    throw InputError("fps: expected a number in (0, 10000], found " + std::to_string(fps));
  if (!(depth_factor > 0))
    throw InputError("depth factor: expected a number > 0, found " + std::to_string(depth_factor));
  if (covered && !(covered->from_s >= 0 && covered->to_s > covered->from_s)) {
    throw InputError("covered: expected 0 <= FROM < TO in seconds, found " +
                     std::to_string(covered->from_s) + " to " + std::to_string(covered->to_s));
  }
}

RenderedClip::RenderedClip(const Options& options)
    : options_(Checked(options)),
      camera_(options_.camera),
      rays_(camera_),
      staged_(std::make_unique<const StagedScene>(
          MakeScene(options_.scene, options_.seed, options_.num_threads))),
      renderer_(staged_->scene, options_.rendering) {}

std::optional<RgbdImage> RenderedClip::Next() {
  if (next_ >= num_frames()) return std::nullopt;
  return Image(next_++);
}

TimeNs RenderedClip::Time(std::size_t index) const {
  const double ticks = static_cast<double>(index) / options_.fps * 1e9 / static_cast<double>(kTick);
  return kStart + static_cast<TimeNs>(std::llround(ticks)) * kTick;
}

bool RenderedClip::IsCovered(std::size_t index) const {
  const double seconds = ToSeconds(Time(index) - kStart);
  return options_.covered && seconds >= options_.covered->from_s &&
         seconds < options_.covered->to_s;
}

Rigid3 RenderedClip::T_world_camera(std::size_t index) const {
  return staged_->path.At(ToSeconds(Time(index) - kStart));
}

RenderedFrame RenderedClip::Frame(std::size_t index, int num_threads) const {
  SEMSLAM_CHECK(index < num_frames()) << "frame " << index << " of " << num_frames();
  const double seconds = ToSeconds(Time(index) - kStart);
  const double half_exposure = 0.5 * options_.color.exposure_s;
  const FrameMotion motion = {.seed = options_.seed,
                              .frame = index,
                              .time_s = seconds,
                              .T_world_camera = staged_->path.At(seconds),
                              .T_world_camera_open = staged_->path.At(seconds - half_exposure),
                              .T_world_camera_close = staged_->path.At(seconds + half_exposure)};
  RenderedFrame frame;
  frame.time = Time(index);
  frame.T_world_camera = motion.T_world_camera;
  frame.ideal = renderer_.Render(rays_, motion.T_world_camera, num_threads);
  IdealImage reaching = frame.ideal;  // What reaches the sensors.
  if (IsCovered(index)) {
    reaching.radiance = cv::Mat::zeros(frame.ideal.radiance.size(), CV_32FC3);
    reaching.depth = cv::Mat::zeros(frame.ideal.depth.size(), CV_64FC1);
  }
  frame.color = SenseColor(reaching, camera_, rays_, motion, options_.color, num_threads);
  frame.depth_16u =
      SenseDepth(reaching, motion, options_.depth, options_.depth_factor, num_threads);
  return frame;
}

RgbdImage RenderedClip::Image(std::size_t index) const {
  const RenderedFrame frame = Frame(index);
  return {frame.time, frame.color, DepthToMetres(frame.depth_16u, options_.depth_factor)};
}

}  // namespace semslam
