// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/source_reader.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/base/pause.h"

#include "live/oni_file.h"

namespace semslam {
namespace {

constexpr std::chrono::milliseconds kPollInterval(50);  // How soon stops and faults are seen.
constexpr double kRetryInterval = 0.1;                  // Seconds between attempts to open.

TimeNs SystemTime() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

CameraRequest ToRequest(const OpenNi2Source::Options& options) {
  return {.width = options.width,
          .height = options.height,
          .fps = options.fps,
          .is_rgb = options.is_rgb,
          .auto_exposure = options.auto_exposure,
          .accept_unregistered = options.accept_unregistered,
          .play_in_real_time = options.play_in_real_time};
}

std::string Seconds(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", seconds);
  return text.data();
}

}  // namespace

OpenNi2Source::Reader::Reader(Options options)
    : options_(std::move(options)),
      pairer_(1'000'000 / (2 * options_.fps)),
      watch_(options_.stall_seconds, options_.start_seconds) {
  Open(options_.device);
  is_file_ = session_->is_file();
  description_ = session_->description();
  num_frames_ = session_->NumFrames();
  nominal_intrinsics_ = session_->NominalIntrinsics();
}

std::optional<RgbdImage> OpenNi2Source::Reader::Next() {
  while (session_ && !session_->is_at_end() && !IsStopped()) {
    try {
      std::optional<RgbdImage> image = Step();
      if (!image) continue;
      if (!options_.duration || image->time - *first_time_ < *options_.duration) return image;
      break;
    } catch (const InputError& fault) {
      if (!Recover(fault.what())) break;
    }
  }
  End();
  return std::nullopt;
}

void OpenNi2Source::Reader::End() {
  session_.reset();  // Closes a recording too.
  if (num_damaged_ == 0) return;
  Log(LogLevel::kWarning,
      "the recording is damaged: images that could not be read: " + std::to_string(num_damaged_));
  num_damaged_ = 0;
}

OpenNi2Source::Statistics OpenNi2Source::Reader::statistics() const {
  Statistics statistics = statistics_;
  statistics.num_unpaired = pairer_.num_unpaired();
  return statistics;
}

void OpenNi2Source::Reader::Open(const std::string& device) {
  const auto notice = [this](const std::string& text) {
    if (!interruption_) Log(LogLevel::kWarning, text);  // Once is enough.
  };
  session_ = std::make_unique<CameraSession>(device, ToRequest(options_), notice);
  camera_ = session_->identity();
  is_recording_ = false;
  watch_.Start(waited_);
  clock_.Restart();
}

std::optional<RgbdImage> OpenNi2Source::Reader::Step() {
  const Stopwatch waiting;
  std::optional<CameraSession::Arrival> arrival = session_->Wait(kPollInterval);
  waited_ += waiting.Seconds();
  std::optional<ImagePair> pair;
  double age = 0;
  if (arrival) {
    watch_.OnImage(arrival->kind, waited_);
    if (is_file_ && !options_.play_in_real_time) {
      num_damaged_ += arrival->num_missed;
    } else if (arrival->kind == StreamKind::kColor) {
      statistics_.num_dropped += arrival->num_missed;
    }
    age = arrival->age;
    pair = pairer_.Add(arrival->kind, std::move(arrival->image));
  }
  if (pair) {
    watch_.OnPair(waited_);
    return Join(*std::move(pair), age);
  }
  if (const std::optional<std::string> fault = watch_.Check(waited_)) throw InputError(*fault);
  return std::nullopt;
}

RgbdImage OpenNi2Source::Reader::Join(ImagePair pair, double age) {
  ++statistics_.num_pairs;
  if (!is_file_) LookAtTimes(pair);
  age_ = age;
  since_read_.Restart();
  RgbdImage image;
  image.time =
      is_file_ ? pair.color.time_us * 1000 : clock_.Convert(pair.color.time_us, SystemTime());
  image.color = std::move(pair.color.image);
  image.depth = std::move(pair.depth.image);
  if (!first_time_) first_time_ = image.time;
  if (interruption_) {
    Log(LogLevel::kWarning, "images come again after " + Seconds(interruption_->Seconds()));
    ++statistics_.num_interruptions;
    interruption_.reset();
  }
  if (!options_.recording.empty() && !is_recording_) StartRecording();
  return image;
}

void OpenNi2Source::Reader::LookAtTimes(const ImagePair& pair) {
  constexpr std::size_t kNumPairs = 15;
  constexpr double kSameTime = 0.1;  // Of the time between frames.
  if (statistics_.num_pairs > kNumPairs) return;
  times_apart_us_ += std::abs(pair.color.time_us - pair.depth.time_us);
  if (statistics_.num_pairs < kNumPairs) return;
  const double apart = 1e-6 * static_cast<double>(times_apart_us_) / kNumPairs;
  if (apart < kSameTime / options_.fps) return;
  std::array<char, 32> milliseconds{};
  std::snprintf(milliseconds.data(), milliseconds.size(), "%.0f ms", 1e3 * apart);
  Log(LogLevel::kWarning, std::string("colour and depth are not taken at the same time, but ") +
                              milliseconds.data() + " apart: the nearest ones are paired");
}

void OpenNi2Source::Reader::StartRecording() {
  is_recording_ = true;
  const std::filesystem::path path = RecordingPart(options_.recording, ++num_recordings_);
  try {
    session_->StartRecording(path);
    if (num_recordings_ > 1) Log(LogLevel::kInfo, "recording goes on in " + path.string());
  } catch (const InputError& error) {  // The map is worth going on for.
    Log(LogLevel::kError, error.what());
  }
}

bool OpenNi2Source::Reader::Recover(const std::string& fault) {
  if (is_file_) {
    failure_ = options_.device + ": the recording is damaged, or was cut short: after " +
               std::to_string(statistics_.num_pairs) + " frames " + fault;
    return false;
  }
  if (!interruption_) {
    interruption_.emplace();
    Log(LogLevel::kWarning, fault + "; waiting up to " + Seconds(options_.patience_seconds) +
                                " for the camera to come back");
  }
  session_.reset();
  pairer_.Reset();
  std::string problem = fault;
  while (true) {
    if (interruption_->Seconds() > options_.patience_seconds) {
      failure_ = "the camera did not come back within " + Seconds(options_.patience_seconds) +
                 ": " + problem;
      return false;
    }
    if (TryToOpenAgain(&problem)) return true;
    Pause(kRetryInterval);
    if (IsStopped()) return false;
  }
}

bool OpenNi2Source::Reader::TryToOpenAgain(std::string* problem) {
  try {
    const std::optional<std::string> uri = FindAgain(camera_);
    if (uri) Open(*uri);
    return uri.has_value();
  } catch (const InputError& error) {
    *problem = error.what();
    return false;
  }
}

bool OpenNi2Source::Reader::IsStopped() const {
  // Where no image comes that is late enough to end it.
  const bool is_overdue = !is_file_ && options_.duration && first_time_ &&
                          SystemTime() - *first_time_ > *options_.duration + kNsPerSecond;
  return is_overdue || (options_.should_stop && options_.should_stop());
}

void OpenNi2Source::Reader::Log(LogLevel level, const std::string& message) const {
  if (options_.log) options_.log(level, "camera", message);
}

}  // namespace semslam
