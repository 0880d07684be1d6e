// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Saving a map, and going on from it.
#include <fstream>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/base/random.h"
#include "semslam/pipeline/system.h"

#include "pipeline/same_poses.h"
#include "pipeline/wall_camera.h"
#include "support/files.h"
#include "support/matchers.h"

namespace semslam {
namespace {

using testing::ExpectSameBits;
using testing::Rigid3Near;
using testing::WallCamera;

constexpr int kNumFrames = 40;

// Finds a book in the left half of every image.
class BookDetector : public Detector {
 public:
  explicit BookDetector(const std::vector<std::string>& names = {"book", "cup"})
      : classes_(names) {}
  std::vector<Detection> Detect(const RgbdImage& image) override {
    Detection detection;
    detection.class_id = 0;
    detection.score = 0.9F;
    detection.box = {10, 10, static_cast<float>(image.color.cols) / 2, 200};
    detection.class_scores.assign(classes_.size(), 0.1F);
    detection.class_scores[0] = 0.9F;
    return {detection};
  }
  const ClassTable& classes() const override { return classes_; }

 private:
  ClassTable classes_;
};

class MapFileTest : public ::testing::Test {
 protected:
  std::unique_ptr<System> MakeSystem(std::unique_ptr<Detector> detector = nullptr,
                                     bool localization_only = false) {
    System::Options options;
    options.threading = Threading::kInline;
    options.detector = std::move(detector);
    options.localization_only = localization_only;
    options.log = [this](LogLevel, std::string_view, std::string_view line) {
      log_.emplace_back(line);
    };
    return std::make_unique<System>(WallCamera::MakeSettings(), vocabulary_, std::move(options));
  }
  // A map of the wall's first frames, shut down and saved.
  std::unique_ptr<System> SaveWall(int num_frames = 25) {
    auto system = MakeSystem(std::make_unique<BookDetector>());
    for (int i = 0; i < num_frames; ++i) system->TrackRGBD(wall_.Image(i));
    result_ = system->Shutdown();
    system->SaveMap(path_);
    return system;
  }

  WallCamera wall_{kNumFrames};
  std::shared_ptr<const Vocabulary> vocabulary_ = wall_.Train();
  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "wall.map";
  std::vector<std::string> log_;
  PointCloudMapping::Result result_;
};

TEST_F(MapFileTest, LoadedAndShutDownGivesTheSameResults) {
  const auto saved = SaveWall();
  const auto loaded = MakeSystem();
  loaded->LoadMap(path_);
  const PointCloudMapping::Result result = loaded->Shutdown();
  ExpectSameBits(loaded->CameraTrajectory(), saved->CameraTrajectory());
  ExpectSameBits(loaded->KeyframeTrajectory(), saved->KeyframeTrajectory());
  EXPECT_EQ(result.cloud.positions, result_.cloud.positions);
  EXPECT_EQ(result.cloud.colors, result_.cloud.colors);
  EXPECT_EQ(result.segmentation.segment_of_point, result_.segmentation.segment_of_point);
  EXPECT_EQ(result.semantics.class_of_point, result_.semantics.class_of_point);
  EXPECT_EQ(result.semantics.object_of_point, result_.semantics.object_of_point);
  EXPECT_EQ(result.semantics.confidence_of_point, result_.semantics.confidence_of_point);
  EXPECT_EQ(result.semantics.classes.size(), 2u) << "the map's own, without a detector";
}

TEST_F(MapFileTest, SavedAgainItIsTheSameFile) {
  SaveWall();
  const auto loaded = MakeSystem(std::make_unique<BookDetector>());
  loaded->LoadMap(path_);
  loaded->Shutdown();
  loaded->SaveMap(folder_.path() / "again.map");
  EXPECT_TRUE(testing::ReadAll(path_) == testing::ReadAll(folder_.path() / "again.map"));
}

TEST_F(MapFileTest, GoesOnMappingWhereTheCameraIsFound) {
  const auto saved = SaveWall();
  const std::size_t num_keyframes = saved->status().num_keyframes;
  const auto system = MakeSystem(std::make_unique<BookDetector>());
  system->LoadMap(path_);
  for (int i = 18; i < kNumFrames; ++i) {
    const Tracking::Result result = system->TrackRGBD(wall_.Image(i));
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    ASSERT_THAT(
        result.T_world_camera,
        Rigid3Near(Rigid3{Eigen::Quaterniond::Identity(), WallCamera::Position(i)}, 0.02, 0.03))
        << "frame " << i;
  }
  EXPECT_GT(system->status().num_keyframes, num_keyframes);
  const PointCloudMapping::Result result = system->Shutdown();
  EXPECT_GT(result.cloud.size(), result_.cloud.size());
  EXPECT_EQ(system->CameraTrajectory().size(), static_cast<std::size_t>(kNumFrames - 18))
      << "of the new frames";
}

TEST_F(MapFileTest, LocalisationLeavesTheMapAsItIs) {
  const auto saved = SaveWall();
  const auto system = MakeSystem(nullptr, true);
  system->LoadMap(path_);
  for (int i = 0; i < 30; ++i) {
    const Tracking::Result result = system->TrackRGBD(wall_.Image(i));
    ASSERT_EQ(result.state, TrackingState::kTracking) << "frame " << i;
    EXPECT_FALSE(result.new_keyframe);
  }
  system->Shutdown();
  ExpectSameBits(system->KeyframeTrajectory(), saved->KeyframeTrajectory());
  EXPECT_EQ(system->CameraTrajectory().size(), 30u);
}

TEST_F(MapFileTest, LocalisationWithoutAMapFindsNothing) {
  const auto system = MakeSystem(nullptr, true);
  EXPECT_EQ(system->TrackRGBD(wall_.Image(0)).state, TrackingState::kNotInitialized);
}

TEST_F(MapFileTest, ALoadedMapIsNotGivenUpInAnUnknownPlace) {
  SaveWall(3);
  const auto system = MakeSystem();
  system->LoadMap(path_);
  for (int i = 0; i < 20; ++i) {
    const Tracking::Result result = system->TrackRGBD(WallCamera::Blank(i));
    EXPECT_EQ(result.state, TrackingState::kLost);
    EXPECT_FALSE(result.map_was_reset);
  }
  system->Shutdown();
  system->SaveMap(path_);  // While lost.
  const auto again = MakeSystem();
  again->LoadMap(path_);
  EXPECT_EQ(again->TrackRGBD(wall_.Image(1)).state, TrackingState::kTracking);
}

TEST_F(MapFileTest, AMapWithoutAnythingCanBeSavedAndFilled) {
  const auto empty = MakeSystem();
  empty->Shutdown();
  empty->SaveMap(path_);
  const auto system = MakeSystem();
  system->LoadMap(path_);
  EXPECT_EQ(system->TrackRGBD(wall_.Image(0)).state, TrackingState::kTracking);
}

TEST_F(MapFileTest, LabelsOfOtherClassesAreDroppedAndThatIsSaid) {
  SaveWall();
  const auto system = MakeSystem(std::make_unique<BookDetector>(std::vector<std::string>{"mug"}));
  system->LoadMap(path_);
  EXPECT_EQ(log_.size(), 1u);
  const PointCloudMapping::Result result = system->Shutdown();
  EXPECT_EQ(result.cloud.size(), result_.cloud.size());
  EXPECT_EQ(result.semantics.classes.size(), 1u);
}

TEST_F(MapFileTest, AnotherCameraIsRefused) {
  SaveWall();
  Settings settings = WallCamera::MakeSettings();
  settings.camera.fx += 1;
  System system(settings, vocabulary_,
                {.threading = Threading::kInline, .detector = nullptr, .log = {}});
  const std::string error = testing::InputErrorOf([&] { system.LoadMap(path_); });
  EXPECT_THAT(
      error, ::testing::AllOf(::testing::HasSubstr("wall.map"), ::testing::HasSubstr("Camera.fx")));
}

TEST_F(MapFileTest, EveryDamageOfTheFileIsNoticed) {
  SaveWall(5);
  const std::string bytes = testing::ReadAll(path_);
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    std::string damaged = bytes;
    const std::size_t place = random.Index(static_cast<std::uint32_t>(bytes.size()));
    if (i % 4 == 0) {
      damaged.resize(place);
    } else {
      damaged[place] = static_cast<char>(damaged[place] ^ (1 << random.Index(8)));
    }
    if (place >= 12 && place < 16 && i % 4 != 0) continue;  // Bytes without a meaning.
    std::ofstream(path_, std::ios::binary) << damaged;
    const auto system = MakeSystem();
    EXPECT_THROW(system->LoadMap(path_), InputError) << "byte " << place;
  }
  EXPECT_THROW(MakeSystem()->LoadMap(folder_.path() / "nothing.map"), InputError);
  EXPECT_THROW(MakeSystem()->LoadMap(folder_.path()), InputError);
}

}  // namespace
}  // namespace semslam
