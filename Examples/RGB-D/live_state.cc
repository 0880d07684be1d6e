// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "live_state.h"

#include <utility>

#include "semslam/base/pause.h"

namespace {

class ShownDetector : public semslam::Detector {
 public:
  ShownDetector(std::shared_ptr<LiveState> state, std::unique_ptr<semslam::Detector> detector)
      : state_(std::move(state)), detector_(std::move(detector)) {}

  std::vector<semslam::Detection> Detect(const semslam::RgbdImage& image) override {
    std::vector<semslam::Detection> detections = detector_->Detect(image);
    state_->ShowDetections(image.color, detections);
    return detections;
  }
  const semslam::ClassTable& classes() const override { return detector_->classes(); }

 private:
  std::shared_ptr<LiveState> state_;
  std::unique_ptr<semslam::Detector> detector_;
};

}  // namespace

void LiveState::Show(const semslam::RgbdImagePtr& image, const semslam::Tracking::Result& result) {
  auto tracked = std::make_shared<Tracked>();
  tracked->image = image;
  tracked->result = result;
  tracked_.Write([&](std::shared_ptr<const Tracked>& newest) {
    tracked->number = newest == nullptr ? 1 : newest->number + 1;
    newest = std::move(tracked);
  });
  rate_.Write([](Rate& rate) {
    constexpr std::size_t kFrames = 30;
    rate.times.push_back(rate.watch.Seconds());
    if (rate.times.size() > kFrames) rate.times.pop_front();
  });
}

void LiveState::CountStep(semslam::Step step, double seconds) {
  step_times_.Write([&](StepTimes& times) {
    constexpr std::size_t kMaxTimes = 240;
    std::deque<float>& own = times.at(static_cast<std::size_t>(step));
    own.push_back(static_cast<float>(1e3 * seconds));
    if (own.size() > kMaxTimes) own.pop_front();
  });
}

void LiveState::ShowDetections(const cv::Mat& color,
                               const std::vector<semslam::Detection>& detections) {
  auto detected = std::make_shared<Detected>();
  detected->color = color;
  detected->detections = detections;
  detected_.Write([&](std::shared_ptr<const Detected>& newest) { newest = std::move(detected); });
}

void LiveState::ObeyBetweenFrames(semslam::System& system,
                                  const std::function<bool()>& should_stop) {
  constexpr double kLook = 0.02;  // Seconds.
  while (true) {
    // Taken at once, so that none is done twice.
    const Commands now = commands_.Write([](Commands& commands) {
      const Commands taken = commands;
      commands.reset = commands.may_step = commands.localization_has_changed = false;
      return taken;
    });
    if (now.localization_has_changed) system.SetLocalizationOnly(now.is_localization_only);
    if (now.reset) {
      system.Reset();
      SetMessage("begun anew");
    }
    if (!now.is_paused || now.may_step || should_stop()) return;
    semslam::Pause(kLook);  // A person thinks.
  }
}

void LiveState::SetEnded() {
  ending_.Write([](Ending& ending) { ending.has_ended = true; });
}

void LiveState::SetMessage(const std::string& message) {
  ending_.Write([&](Ending& ending) { ending.message = message; });
}

std::shared_ptr<const LiveState::Tracked> LiveState::tracked() const {
  return tracked_.Read([](const auto& newest) { return newest; });
}

std::shared_ptr<const LiveState::Detected> LiveState::detected() const {
  return detected_.Read([](const auto& newest) { return newest; });
}

LiveState::StepTimes LiveState::step_times() const {
  return step_times_.Read([](const StepTimes& times) { return times; });
}

double LiveState::frames_per_second() const {
  return rate_.Read([](const Rate& rate) {
    if (rate.times.size() < 2) return 0.0;
    const double seconds = rate.times.back() - rate.times.front();
    return seconds > 0 ? static_cast<double>(rate.times.size() - 1) / seconds : 0.0;
  });
}

bool LiveState::has_ended() const {
  return ending_.Read([](const Ending& ending) { return ending.has_ended; });
}

std::string LiveState::message() const {
  return ending_.Read([](const Ending& ending) { return ending.message; });
}

bool LiveState::is_paused() const {
  return commands_.Read([](const Commands& commands) { return commands.is_paused; });
}

bool LiveState::is_localization_only() const {
  return commands_.Read([](const Commands& commands) { return commands.is_localization_only; });
}

void LiveState::SetPaused(bool paused) {
  commands_.Write([paused](Commands& commands) { commands.is_paused = paused; });
}

void LiveState::Step() {
  commands_.Write([](Commands& commands) { commands.is_paused = commands.may_step = true; });
}

void LiveState::RequestReset() {
  commands_.Write([](Commands& commands) { commands.reset = true; });
}

void LiveState::RequestLocalizationOnly(bool localization_only) {
  commands_.Write([localization_only](Commands& commands) {
    commands.is_localization_only = localization_only;
    commands.localization_has_changed = true;
  });
}

void LiveState::StartWithLocalizationOnly(bool localization_only) {
  commands_.Write([localization_only](Commands& commands) {
    commands.is_localization_only = localization_only;
  });
}

std::unique_ptr<semslam::Detector> ShowIn(std::shared_ptr<LiveState> state,
                                          std::unique_ptr<semslam::Detector> detector) {
  if (detector == nullptr) return nullptr;
  return std::make_unique<ShownDetector>(std::move(state), std::move(detector));
}
