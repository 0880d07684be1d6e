// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/pipeline/point_cloud_mapping.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/wall_camera.h"

namespace semslam {
namespace {

using testing::WallCamera;

class PointCloudMappingTest : public ::testing::TestWithParam<Threading> {
 protected:
  PointCloudMappingTest() : mapping_(GetParam(), Options(), Camera(), ClassTable(), LookUp()) {}

  static PinholeCamera Camera() { return PinholeCamera(WallCamera::MakeSettings().camera); }
  static PointCloudMapping::Options Options() {
    const Settings settings = WallCamera::MakeSettings();
    PointCloudMapping::Options options;
    options.cloud = settings.cloud;
    options.voxels = settings.voxels;
    options.segmentation = settings.segmentation;
    return options;
  }
  PointCloudMapping::PlaceLookup LookUp() {
    return [this](const std::vector<KeyframeId>& ids) {
      return poses_.Read([&](const std::map<KeyframeId, Rigid3>& poses) {
        PointCloudMapping::Places found;
        for (const KeyframeId id : ids) {
          if (const auto it = poses.find(id); it != poses.end()) found.T_world_camera.insert(*it);
        }
        return found;
      });
    };
  }
  void SetPose(std::uint32_t keyframe, const Eigen::Vector3d& translation) {
    poses_.Write([&](auto& poses) {
      poses[KeyframeId{keyframe}] = {Eigen::Quaterniond::Identity(), translation};
    });
  }
  void Forget(std::uint32_t keyframe) {
    poses_.Write([&](auto& poses) { poses.erase(KeyframeId{keyframe}); });
  }
  bool Insert(std::uint32_t keyframe) {
    return mapping_.InsertKeyframe(KeyframeId{keyframe}, wall_.Image(static_cast<int>(keyframe)));
  }
  static Eigen::Vector3d Mean(const MapCloud& cloud) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3f& p : cloud.positions) sum += p.cast<double>();
    return sum / static_cast<double>(cloud.size());
  }

  WallCamera wall_{10};
  Guarded<std::map<KeyframeId, Rigid3>> poses_;
  PointCloudMapping mapping_;
};

TEST_P(PointCloudMappingTest, PutsAKeyframesPointsWhereItsPoseSays) {
  SetPose(0, {1, 2, 3});
  ASSERT_TRUE(Insert(0));
  const PointCloudMapping::Result result = mapping_.Finish();
  ASSERT_GT(result.cloud.size(), 100u);
  EXPECT_LT((Mean(result.cloud) - Eigen::Vector3d(1, 2, 3 + WallCamera::kDepth)).norm(), 0.03);
  EXPECT_EQ(mapping_.num_voxels(), result.cloud.size());
  EXPECT_GT(result.integration_milliseconds, 0);
}

TEST_P(PointCloudMappingTest, FollowsAPoseThatIsMovedLater) {
  SetPose(0, {0, 0, 0});
  ASSERT_TRUE(Insert(0));
  SetPose(0, {5, 0, 0});
  const Eigen::Vector3d mean = Mean(mapping_.Finish().cloud);
  EXPECT_LT((mean - Eigen::Vector3d(5, 0, WallCamera::kDepth)).norm(), 0.03);
}

TEST_P(PointCloudMappingTest, DropsKeyframesOfAClearedMap) {
  SetPose(0, {0, 0, 0});
  SetPose(1, {5, 0, 0});
  ASSERT_TRUE(Insert(0));
  ASSERT_TRUE(Insert(1));
  Forget(0);
  const Eigen::Vector3d mean = Mean(mapping_.Finish().cloud);
  EXPECT_LT((mean - Eigen::Vector3d(5, 0, WallCamera::kDepth)).norm(), 0.03);
}

TEST_P(PointCloudMappingTest, IgnoresAKeyframeThatIsGoneBeforeItsTurn) {
  ASSERT_TRUE(Insert(0));
  const PointCloudMapping::Result result = mapping_.Finish();
  EXPECT_EQ(result.cloud.size(), 0u);
  EXPECT_TRUE(result.semantics.objects.empty());
}

TEST_P(PointCloudMappingTest, WithoutKeyframesTheMapIsEmpty) {
  const PointCloudMapping::Result result = mapping_.Finish();
  EXPECT_EQ(result.cloud.size(), 0u);
  EXPECT_TRUE(result.segmentation.segments.empty());
}

TEST_P(PointCloudMappingTest, TakesNothingMoreOnceFinished) {
  SetPose(0, {0, 0, 0});
  mapping_.Finish();
  EXPECT_FALSE(Insert(0));
  EXPECT_FALSE(mapping_.InsertDetections(KeyframeId{0}, {}));
}

TEST_P(PointCloudMappingTest, DetectionsOfAnUnknownKeyframeDoNoHarm) {
  SetPose(0, {0, 0, 0});
  ASSERT_TRUE(Insert(0));
  ASSERT_TRUE(mapping_.InsertDetections(KeyframeId{7}, {}));
  EXPECT_GT(mapping_.Finish().cloud.size(), 100u);
}

TEST_P(PointCloudMappingTest, ShowsTheSegmentsWhileTheMapGrows) {
  PointCloudMapping::Options options = Options();
  options.voxels.voxel_size = 0.04;  // The small camera's points are far apart.
  options.segmentation.supervoxels.voxel_size = 0.04;
  options.segmentation.supervoxels.seed_spacing = 0.2;
  PointCloudMapping mapping(GetParam(), options, Camera(), ClassTable(), LookUp());
  mapping.RequestLiveMap();
  SetPose(0, {0, 0, 0});
  ASSERT_TRUE(mapping.InsertKeyframe(KeyframeId{0}, wall_.Image(0)));
  const PointCloudMapping::Result result = mapping.Finish();
  EXPECT_EQ(result.live.num_keyframes, 1U);
  const std::shared_ptr<const SegmentedCloud> live = mapping.live_map();
  ASSERT_NE(live, nullptr);
  EXPECT_EQ(live->cloud.positions, result.cloud.positions);
  // The wall is one segment, then as in the end.
  EXPECT_THAT(result.segmentation.segment_of_point, ::testing::Each(1U));
  EXPECT_EQ(live->segment_of_point, result.segmentation.segment_of_point);
}

TEST_P(PointCloudMappingTest, LiveSegmentsDoNotChangeTheResult) {
  PointCloudMapping::Options options = Options();
  options.live.enabled = false;
  PointCloudMapping without(GetParam(), options, Camera(), ClassTable(), LookUp());
  for (std::uint32_t keyframe = 0; keyframe < 3; ++keyframe) {
    SetPose(keyframe, {0.05 * keyframe, 0, 0});
    ASSERT_TRUE(Insert(keyframe));
    const int image = static_cast<int>(keyframe);
    ASSERT_TRUE(without.InsertKeyframe(KeyframeId{keyframe}, wall_.Image(image)));
  }
  const PointCloudMapping::Result a = mapping_.Finish();
  const PointCloudMapping::Result b = without.Finish();
  EXPECT_EQ(a.cloud.positions, b.cloud.positions);
  EXPECT_EQ(a.segmentation.segment_of_point, b.segmentation.segment_of_point);
  EXPECT_EQ(without.live_map(), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Threading,
                         PointCloudMappingTest,
                         ::testing::Values(Threading::kInline, Threading::kWorkers),
                         [](const auto& test) {
                           return test.param == Threading::kInline ? "Inline" : "Workers";
                         });

class FailingLookup : public ::testing::Test {
 protected:
  PointCloudMapping Make(Threading threading) const {
    const Settings settings = WallCamera::MakeSettings();
    PointCloudMapping::Options options;
    options.cloud = settings.cloud;
    options.voxels = settings.voxels;
    return {threading, options, PinholeCamera(settings.camera), ClassTable(),
            [](const std::vector<KeyframeId>&) -> PointCloudMapping::Places {
              throw std::runtime_error("no poses today");
            }};
  }
  WallCamera wall_{2};
};

TEST_F(FailingLookup, ReachesTheCallerAtOnceWhenInline) {
  PointCloudMapping mapping = Make(Threading::kInline);
  EXPECT_THROW(mapping.InsertKeyframe(KeyframeId{0}, wall_.Image(0)), std::runtime_error);
  EXPECT_FALSE(mapping.InsertKeyframe(KeyframeId{1}, wall_.Image(1)));
}

TEST_F(FailingLookup, ReachesTheCallerOfFinishFromTheThread) {
  PointCloudMapping mapping = Make(Threading::kWorkers);
  mapping.InsertKeyframe(KeyframeId{0}, wall_.Image(0));
  EXPECT_THROW(mapping.Finish(), std::runtime_error);
}

}  // namespace
}  // namespace semslam
