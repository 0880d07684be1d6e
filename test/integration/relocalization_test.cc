// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// A hand before the camera, and a camera that is carried elsewhere, on a rendered desk.
#include <memory>

#include <gtest/gtest.h>

#include "semslam/pipeline/system.h"

#include "support/desk_clip.h"

namespace semslam {
namespace {

constexpr int kNumFrames = 140;
constexpr double kMaxError = 0.02;  // Metres; without a loss it is a millimetre or two.

class DeskWithLosses : public ::testing::Test {
 protected:
  static const RenderedClip& Clip() {
    static const RenderedClip clip([] {
      RenderedClip::Options options = testing::SmallDeskClipOptions(kNumFrames);
      options.fps = 15;  // Ground is covered faster, so that there are keyframes to be lost from.
      return options;
    }());
    return clip;
  }
  static std::unique_ptr<System> MakeSystem() {
    Settings settings;
    settings.camera = Clip().options().camera;
    settings.fps = Clip().options().fps;
    settings.bf = 20;
    // So many keyframes that the map is kept.
    settings.tracking.keyframes.changed_ratio = 0.9;
    settings.tracking.keyframes.changed_ratio_at_start = 0.9;
    // The dense map is not what is looked at here.
    settings.cloud.pixel_stride = 16;
    settings.voxels.voxel_size = 0.05;
    const std::filesystem::path source = SEMSLAM_SOURCE_DIR;
    return std::make_unique<System>(
        settings,
        std::make_shared<const Vocabulary>(Vocabulary::Load(source / "Vocabulary/orb.voc")),
        System::Options{.threading = Threading::kInline, .detector = nullptr, .log = {}});
  }

  // Frame `place` of the clip at the time of frame `number`.
  Tracking::Result Show(int place, int number) {
    RgbdImage image = Clip().Image(static_cast<std::size_t>(place));
    image.time = Clip().Time(static_cast<std::size_t>(number));
    const Tracking::Result result =
        system_->TrackRGBD(std::make_shared<const RgbdImage>(std::move(image)));
    if (result.state == TrackingState::kTracking) {
      const Rigid3 T_world_first = Clip().T_world_camera(0);
      const Rigid3 truth = T_world_first.Inverse() * Clip().T_world_camera(place);
      EXPECT_LT((result.T_world_camera.translation - truth.translation).norm(), kMaxError)
          << "place " << place << ", frame " << number;
    }
    return result;
  }
  Tracking::Result ShowNothing(int number) {
    const cv::Size size(Clip().camera().width(), Clip().camera().height());
    return system_->TrackRGBD(std::make_shared<const RgbdImage>(RgbdImage{
        Clip().Time(static_cast<std::size_t>(number)), cv::Mat(size, CV_8UC3, cv::Scalar::all(0)),
        cv::Mat(size, CV_32FC1, cv::Scalar(0))}));
  }

  std::unique_ptr<System> system_ = MakeSystem();
};

TEST_F(DeskWithLosses, ACoveredCameraIsFoundAgainThoughItMovedOn) {
  int num_lost = 0;
  for (int i = 0; i < kNumFrames; ++i) {
    const bool is_covered = i >= 60 && i < 120;
    const Tracking::Result result = is_covered ? ShowNothing(i) : Show(i, i);
    EXPECT_FALSE(result.map_was_reset);
    EXPECT_TRUE(!is_covered || result.state == TrackingState::kLost);
    if (!is_covered && result.state != TrackingState::kTracking) ++num_lost;
  }
  RecordProperty("num_lost", num_lost);
  EXPECT_LE(num_lost, 5);
}

TEST_F(DeskWithLosses, ACameraThatIsCarriedElsewhereIsFound) {
  for (int i = 0; i < kNumFrames; i += 2) {
    ASSERT_EQ(Show(i, i / 2).state, TrackingState::kTracking) << "frame " << i;
  }
  int num_lost = 0;
  int number = kNumFrames / 2;
  for (const int place : {40, 110, 5, 80}) {
    for (int i = 0; i < 8; ++i) {
      if (Show(place + i, number++).state != TrackingState::kTracking) ++num_lost;
    }
  }
  RecordProperty("num_lost", num_lost);
  EXPECT_LE(num_lost, 4) << "one a jump";
}

}  // namespace
}  // namespace semslam
