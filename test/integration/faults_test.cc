// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// The whole system on a rendered desk when the camera, or the recording, is at fault.
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/eval/trajectory_error.h"
#include "semslam/pipeline/system.h"

#include "support/desk_clip.h"
#include "support/faulty_source.h"

namespace semslam {
namespace {

using testing::Fault;
using testing::FaultySource;
using Kind = Fault::Kind;

constexpr std::size_t kNumFrames = 120;

// The clip in memory: rendered once for all tests.
class Recording : public FrameSource {
 public:
  explicit Recording(const std::vector<RgbdImage>& images) : images_(images) {}
  std::optional<RgbdImage> Next() override {
    if (next_ == images_.size()) return std::nullopt;
    return images_[next_++];
  }

 private:
  const std::vector<RgbdImage>& images_;
  std::size_t next_ = 0;
};

struct Outcome {
  std::size_t num_unreadable = 0;
  std::size_t num_skipped = 0;
  std::vector<TrackingState> states;  // Of the frames that were read, but for the skipped.
  Trajectory camera;
  std::size_t num_points = 0;

  std::size_t NumLost() const { return states.size() - camera.size(); }
};

class Faults : public ::testing::Test {
 protected:
  static const RenderedClip& Clip() {
    static const RenderedClip clip([] {
      RenderedClip::Options options = testing::SmallDeskClipOptions(kNumFrames);
      options.fps = 20;
      return options;
    }());
    return clip;
  }
  static const std::vector<RgbdImage>& Images() {
    static const std::vector<RgbdImage> images = [] {
      std::vector<RgbdImage> all;
      for (std::size_t i = 0; i < kNumFrames; ++i) all.push_back(Clip().Image(i));
      return all;
    }();
    return images;
  }

  static Outcome Run(const std::vector<Fault>& faults) {
    Settings settings;
    settings.camera = Clip().options().camera;
    settings.fps = Clip().options().fps;
    settings.bf = 20;
    settings.tracking.min_features_to_start = 300;
    static const auto vocabulary = std::make_shared<const Vocabulary>(
        Vocabulary::Load(std::filesystem::path(SEMSLAM_SOURCE_DIR) / "Vocabulary/orb.voc"));
    System system(settings, vocabulary,
                  {.threading = Threading::kInline, .detector = nullptr, .log = {}});
    Recording recording(Images());
    FaultySource source(recording, faults);
    Outcome outcome;
    while (true) {
      std::optional<RgbdImage> image;
      try {
        image = source.Next();
      } catch (const InputError&) {
        ++outcome.num_unreadable;
        continue;
      }
      if (!image) break;
      const auto result = system.TrackRGBD(std::make_shared<const RgbdImage>(*std::move(image)));
      EXPECT_FALSE(result.map_was_reset);
      if (result.was_skipped) {
        ++outcome.num_skipped;
      } else {
        outcome.states.push_back(result.state);
      }
    }
    outcome.num_points = system.Shutdown().cloud.size();
    for (const System::TrackedPose& pose : system.CameraTrajectory())
      outcome.camera.push_back({pose.time, pose.T_world_camera});
    return outcome;
  }

  // Of the frames that were tracked, metres.
  static double Error(const Outcome& outcome) {
    Trajectory truth;
    for (std::size_t i = 0; i < kNumFrames; ++i)
      truth.push_back({Clip().Time(i), Clip().T_world_camera(i)});
    return EvaluateTrajectory(truth, outcome.camera).absolute.rmse;
  }

  // Twice what is measured without any fault.
  static constexpr double kMaxError = 0.008;
};

TEST_F(Faults, WithoutAnyEveryFrameIsTracked) {
  const Outcome outcome = Run({});
  EXPECT_EQ(outcome.camera.size(), kNumFrames);
  EXPECT_EQ(outcome.num_skipped + outcome.num_unreadable, 0u);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, GapsOfSomeFramesAreBridged) {
  const Outcome outcome =
      Run({{Kind::kDropped, 20, 1}, {Kind::kDropped, 40, 3}, {Kind::kDropped, 70, 6}});
  EXPECT_EQ(outcome.states.size(), kNumFrames - 10);
  EXPECT_EQ(outcome.NumLost(), 0u);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, AFrameThatComesTwiceCountsOnce) {
  const Outcome outcome = Run({{Kind::kRepeated, 30, 10}});
  EXPECT_EQ(outcome.num_skipped, 10u);
  EXPECT_EQ(outcome.camera.size(), kNumFrames);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, AFrameThatComesTooLateIsLeftOut) {
  const Outcome outcome = Run({{Kind::kSwapped, 30, 1}, {Kind::kSwapped, 50, 1}});
  EXPECT_EQ(outcome.num_skipped, 2u);
  EXPECT_EQ(outcome.camera.size(), kNumFrames - 2);
  for (std::size_t i = 1; i < outcome.camera.size(); ++i)
    EXPECT_GT(outcome.camera[i].time, outcome.camera[i - 1].time);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, UnreadableFramesAreLeftOut) {
  const Outcome outcome = Run({{Kind::kUnreadable, 25, 3}, {Kind::kUnreadable, 60, 1}});
  EXPECT_EQ(outcome.num_unreadable, 4u);
  EXPECT_EQ(outcome.camera.size(), kNumFrames - 4);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, BlackFramesAreLostAndTheNextOnesAreNot) {
  const Outcome outcome = Run({{Kind::kBlack, 60, 3}});
  EXPECT_EQ(outcome.NumLost(), 3u);
  EXPECT_EQ(outcome.states.at(62), TrackingState::kLost);
  EXPECT_EQ(outcome.states.at(63), TrackingState::kTracking);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, WithoutDepthForASecondTheCameraIsTrackedOnTheMap) {
  const Outcome outcome = Run({{Kind::kNoDepth, 50, 20}});
  EXPECT_EQ(outcome.NumLost(), 0u);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, ExposureMayJump) {
  const Outcome outcome = Run({{Kind::kExposure, 40, 20, 0.6}, {Kind::kExposure, 80, 20, 1.5}});
  EXPECT_EQ(outcome.NumLost(), 0u);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, AJumpOfTheClockChangesTimesOnly) {
  Outcome jumped = Run({{Kind::kTimeJump, 60, 1, 100.0}});
  EXPECT_EQ(jumped.camera.size(), kNumFrames);
  for (TimedPose& pose : jumped.camera) {
    if (pose.time > Clip().Time(kNumFrames)) pose.time -= FromSeconds(100.0);
  }
  EXPECT_LE(Error(jumped), kMaxError);
}

// Frames of a clock that was set back are left out until it has caught up: times must increase.
TEST_F(Faults, AClockThatIsSetBackCostsTheFramesOfThatTime) {
  const Outcome outcome = Run({{Kind::kTimeJump, 60, 1, -0.5}});
  EXPECT_EQ(outcome.num_skipped, 10u);
  EXPECT_EQ(outcome.NumLost(), 0u);
}

TEST_F(Faults, ACoveredCameraIsFoundAgainWithinFiveFrames) {
  const Outcome outcome = Run({{Kind::kCovered, 50, 40}});  // 2 s.
  EXPECT_LE(outcome.NumLost(), 45u);
  EXPECT_EQ(outcome.states.at(89), TrackingState::kLost) << "nothing can be seen";
  EXPECT_EQ(outcome.states.at(95), TrackingState::kTracking);
  EXPECT_LE(Error(outcome), kMaxError);
}

TEST_F(Faults, ManyAtOnceLeaveAMap) {
  const Outcome outcome = Run({{Kind::kUnreadable, 10, 2},
                               {Kind::kExposure, 0, kNumFrames, 0.8},
                               {Kind::kSwapped, 33, 1},
                               {Kind::kNoDepth, 44, 3},
                               {Kind::kDropped, 55, 4},
                               {Kind::kBlack, 70, 2},
                               {Kind::kRepeated, 90, 5}});
  EXPECT_LE(outcome.NumLost(), 4u);
  EXPECT_GT(outcome.num_points, 10'000u);
  EXPECT_LE(Error(outcome), kMaxError);
}

}  // namespace
}  // namespace semslam
