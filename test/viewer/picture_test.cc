// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// What the renderer draws, looked at pixel by pixel.
#include "semslam/viewer/picture.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "semslam/base/error.h"
#include "semslam/viewer/renderer.h"

#include "viewer/gl_objects.h"
#include "viewer/offscreen.h"

namespace semslam {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr float kSpacing = 0.01F;
constexpr Rgb kRed{255, 0, 0};
constexpr Rgb kBlue{0, 0, 255};
constexpr Rgb kWhite{255, 255, 255};

// At the origin, looking along z: a point (x, y, z) is in pixel 300 x / z + 159.5, ...
ViewCamera Camera() {
  ViewCamera camera;
  camera.focal_length = 300;
  camera.width = kWidth;
  camera.height = kHeight;
  return camera;
}

// A square upright surface, in the middle of the picture unless moved.
std::vector<Eigen::Vector3f> Plate(float z, float half_size, float x = 0, float y = 0) {
  std::vector<Eigen::Vector3f> points;
  const int steps = static_cast<int>(std::lround(half_size / kSpacing));
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j)
      points.emplace_back(x + kSpacing * static_cast<float>(i),
                          y + kSpacing * static_cast<float>(j), z);
  }
  return points;
}

Renderer::Options PlainOptions() {
  Renderer::Options options;
  options.point_size = kSpacing;
  options.eye_dome = false;
  options.background_top = options.background_bottom = {0, 0, 0};
  return options;
}

// Draws into pictures without a window.
class Studio {
 public:
  Studio() { target_.Resize(kWidth, kHeight); }

  Renderer::ChunkId Add(const std::vector<Eigen::Vector3f>& points, Rgb color) {
    const Renderer::ChunkId chunk = renderer.AddChunk(points, {});
    renderer.SetColors(chunk, std::vector<Rgb>(points.size(), color));
    return chunk;
  }

  cv::Mat Draw(const Renderer::Options& options = PlainOptions(), const DrawList& list = {}) {
    renderer.Draw(Camera(), list, options, target_.framebuffer());
    return target_.Read();
  }

 private:
  OffscreenContext context_;

 public:
  Renderer renderer;

 private:
  GlTarget target_{false};
};

Rgb At(const cv::Mat& picture, int x, int y) {
  const auto bgr = picture.at<cv::Vec3b>(y, x);
  return {bgr[2], bgr[1], bgr[0]};
}

int CountPixels(const cv::Mat& picture, Rgb color) {
  const cv::Scalar bgr(color.b, color.g, color.r);
  cv::Mat mask;
  cv::inRange(picture, bgr - cv::Scalar(8, 8, 8), bgr + cv::Scalar(8, 8, 8), mask);
  return cv::countNonZero(mask);
}

int Brightness(Rgb color) { return color.r + color.g + color.b; }

class PictureTest : public ::testing::Test {
 protected:
  void SetUp() override { SEMSLAM_NEEDS_OPENGL(); }
};

TEST_F(PictureTest, ARedSquareIsWhereItIsToBe) {
  Studio studio;
  studio.Add(Plate(2, 0.3F, 0.2F, 0.1F), kRed);
  const cv::Mat picture = studio.Draw();
  // Its middle is 30 pixels to the right and 15 below the picture's; it is 90 pixels wide.
  EXPECT_EQ(At(picture, 189, 134), kRed);
  for (const int side : {-1, 1}) {
    EXPECT_EQ(At(picture, 189 + 42 * side, 134), kRed);
    EXPECT_EQ(At(picture, 189 + 50 * side, 134), Rgb());
    EXPECT_EQ(At(picture, 189, 134 + 42 * side), kRed);
    EXPECT_EQ(At(picture, 189, 134 + 50 * side), Rgb());
  }
  EXPECT_NEAR(CountPixels(picture, kRed), 91 * 91, 600);
}

TEST_F(PictureTest, WhatIsNearerHidesWhatIsBehind) {
  for (const bool near_first : {true, false}) {
    Studio studio;
    if (near_first) studio.Add(Plate(1, 0.1F), kRed);
    studio.Add(Plate(2, 0.5F), kBlue);
    if (!near_first) studio.Add(Plate(1, 0.1F), kRed);
    const cv::Mat picture = studio.Draw();
    EXPECT_EQ(At(picture, 160, 120), kRed);
    EXPECT_EQ(At(picture, 210, 120), kBlue);
  }
}

TEST_F(PictureTest, APointTwiceAsFarCoversAQuarter) {
  Renderer::Options options = PlainOptions();
  options.point_size = 0.1;
  std::vector<int> areas;
  for (const float z : {1.0F, 2.0F}) {
    Studio studio;
    studio.Add({{0, 0, z}}, kRed);
    areas.push_back(CountPixels(studio.Draw(options), kRed));
  }
  EXPECT_NEAR(static_cast<double>(areas[0]) / areas[1], 4, 0.5);
  EXPECT_NEAR(areas[0], 0.785 * 48 * 48, 200);  // A disc of 1.6 x 0.1 m at 300 pixels a metre.
}

TEST_F(PictureTest, EyeDomeShadingDarkensWhatIsBehindAnEdge) {
  Studio studio;
  studio.Add(Plate(3, 1.2F), kWhite);
  studio.Add(Plate(2, 0.2F), kWhite);  // 61 pixels wide.
  Renderer::Options options = PlainOptions();
  const cv::Mat plain = studio.Draw(options);
  EXPECT_EQ(At(plain, 160 + 32, 120), kWhite);
  options.eye_dome = true;
  const cv::Mat shaded = studio.Draw(options);
  EXPECT_EQ(At(shaded, 160, 120), kWhite);
  EXPECT_EQ(At(shaded, 160 + 60, 120), kWhite);
  int darkest = 765;
  for (int x = 160 + 28; x < 160 + 36; ++x)
    darkest = std::min(darkest, Brightness(At(shaded, x, 120)));
  EXPECT_LT(darkest, 500);
}

TEST_F(PictureTest, NormalsShadeSurfacesSeenFromTheSide) {
  Studio studio;
  const std::vector<Eigen::Vector3f> points = Plate(2, 0.3F);
  Renderer::Options options = PlainOptions();
  std::vector<int> brightness;
  for (const Eigen::Vector3f& normal : {Eigen::Vector3f(0, 0, -1), {0, 1, 0}}) {
    const auto chunk =
        studio.renderer.AddChunk(points, std::vector<Eigen::Vector3f>(points.size(), normal));
    studio.renderer.SetColors(chunk, std::vector<Rgb>(points.size(), kWhite));
    brightness.push_back(Brightness(At(studio.Draw(options), 160, 120)));
    studio.renderer.RemoveChunk(chunk);
  }
  EXPECT_GT(brightness[0], 740);
  EXPECT_LT(brightness[1], 500);
}

TEST_F(PictureTest, AChunkMovesWithItsPoseAndGoesWhenRemoved) {
  Studio studio;
  const auto chunk = studio.Add(Plate(2, 0.1F), kRed);
  studio.renderer.SetPose(chunk, {Eigen::Quaterniond::Identity(), {0.4, 0, 0}});
  const cv::Mat moved = studio.Draw();
  EXPECT_EQ(At(moved, 160, 120), Rgb());
  EXPECT_EQ(At(moved, 220, 120), kRed);
  EXPECT_EQ(studio.renderer.num_points(), 441U);
  studio.renderer.RemoveChunk(chunk);
  EXPECT_EQ(studio.renderer.num_points(), 0U);
  EXPECT_EQ(CountPixels(studio.Draw(), kRed), 0);
}

TEST_F(PictureTest, FewerPointsStillCoverTheSurface) {
  Studio studio;
  studio.Add(Plate(2, 0.3F), kRed);  // 3721 points.
  Renderer::Options options = PlainOptions();
  const int all = CountPixels(studio.Draw(options), kRed);
  options.max_points = 1000;
  EXPECT_GT(CountPixels(studio.Draw(options), kRed), 0.85 * all);
}

TEST_F(PictureTest, SmallGapsAreFilledIfAskedFor) {
  std::vector<Eigen::Vector3f> points = Plate(2, 0.3F);
  // A column of pixels is missing.
  std::erase_if(points, [](const Eigen::Vector3f& p) { return std::abs(p.x()) < 0.015F; });
  Studio studio;
  studio.Add(points, kRed);
  Renderer::Options options = PlainOptions();
  EXPECT_EQ(At(studio.Draw(options), 160, 120), Rgb());
  options.fill_gaps = true;
  const cv::Mat filled = studio.Draw(options);
  EXPECT_EQ(At(filled, 160, 120), kRed);
  EXPECT_EQ(At(filled, 230, 120), Rgb());  // Beside the surface there is none.
}

TEST_F(PictureTest, PlacesThatAreNoNumbersDoNoHarm) {
  std::vector<Eigen::Vector3f> points = Plate(2, 0.1F);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  points.emplace_back(kNan, kNan, kNan);
  Studio studio;
  studio.Add(points, kRed);
  EXPECT_EQ(At(studio.Draw(), 160, 120), kRed);
}

TEST_F(PictureTest, ALineIsDrawnFromEndToEnd) {
  DrawList list;
  list.AddLine({-0.4, 0.2, 2}, {0.4, 0.2, 2}, {.color = kRed, .width = 3});
  Studio studio;
  const cv::Mat picture = studio.Draw(PlainOptions(), list);
  for (const int x : {102, 130, 160, 190, 217}) EXPECT_EQ(At(picture, x, 150).r, 255) << x;
  EXPECT_EQ(At(picture, 95, 150), Rgb());
  EXPECT_EQ(At(picture, 160, 144), Rgb());
}

TEST_F(PictureTest, ALineThatBeginsBehindTheEyeIsCutOff) {
  DrawList list;
  list.AddLine({0.1, 0, -3}, {0.1, 0, 3}, {.color = kRed, .width = 3});
  Studio studio;
  studio.Add(Plate(4, 0.02F, 1), kBlue);  // Something to fit the range of depths to.
  const cv::Mat picture = studio.Draw(PlainOptions(), list);
  // From the right edge to where its end is seen.
  for (const int x : {172, 220, 300}) EXPECT_GT(At(picture, x, 119).r, 100) << x;
  EXPECT_EQ(At(picture, 150, 119), Rgb());
}

TEST_F(PictureTest, PointsHideALineAsFarAsItSays) {
  Studio studio;
  studio.Add(Plate(1, 0.2F), kBlue);
  for (const float hidden_share : {0.0F, 0.5F}) {
    DrawList list;
    list.AddLine({-1, 0, 2}, {1, 0, 2}, {.color = kRed, .width = 4, .hidden_share = hidden_share});
    const cv::Mat picture = studio.Draw(PlainOptions(), list);
    EXPECT_NEAR(At(picture, 160, 120).r, 255 * hidden_share, 40);
    EXPECT_GT(At(picture, 300, 120).r, 200);
  }
}

// A table of 1 m x 1 m with a red thing on it, seen as a map.
struct TableMap {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Rgb> colors;
  std::vector<std::uint32_t> labels;
  std::vector<std::uint32_t> segments;
  MapScene scene;

  TableMap() {
    for (int i = -50; i <= 50; ++i) {
      for (int j = 0; j <= 100; ++j) {
        const bool is_thing = std::abs(i) < 15 && j > 40 && j < 60;
        positions.emplace_back(0.01F * static_cast<float>(i), is_thing ? -0.2F : 0.0F,
                               0.01F * static_cast<float>(j));
        colors.push_back(is_thing ? Rgb{90, 160, 90} : Rgb{200, 200, 200});
        labels.push_back(is_thing ? 1 : 0);
        segments.push_back(is_thing ? 2 : 1);
      }
    }
    scene.map.cloud = {
        .positions = positions, .colors = colors, .labels = labels, .segments = segments};
    scene.map.point_size = 0.01;
    scene.map.up = Eigen::Vector3d(0, -1, 0);
    scene.map.classes = {{1, "cup", {230, 30, 30}}};
    ObjectRecord object;
    object.id = 1;
    object.label = 1;
    object.confidence = 1;
    object.centroid = {0, -0.2, 0.5};
    object.box = {{Eigen::Quaterniond::Identity(), {0, -0.1, 0.5}}, {0.15, 0.1, 0.1}};
    scene.map.objects = {object};
  }
};

PictureOptions FromAbove() {
  PictureOptions options;
  options.width = kWidth;
  options.height = kHeight;
  options.from = Viewpoint::kTop;
  options.overlay.grid = options.overlay.objects = false;
  options.legend = false;
  return options;
}

TEST_F(PictureTest, TheSwitchChangesTheColours) {
  const TableMap map;
  PictureOptions options = FromAbove();
  const Rgb photo = At(TakePicture(map.scene, options), 160, 120);
  EXPECT_NEAR(photo.g, 160, 12);
  options.color = ColorMode::kClasses;
  const Rgb thing = At(TakePicture(map.scene, options), 160, 120);
  EXPECT_GT(thing.r, 180);
  EXPECT_LT(thing.g, 80);
  options.color = ColorMode::kSegments;
  const cv::Mat segments = TakePicture(map.scene, options);
  EXPECT_NE(At(segments, 160, 120), At(segments, 160, 200));
  options.color = ColorMode::kHeight;
  const cv::Mat heights = TakePicture(map.scene, options);
  EXPECT_GT(At(heights, 160, 120).r, At(heights, 160, 200).r + 60);
}

TEST_F(PictureTest, AnObjectHasABoxAndAName) {
  const TableMap map;
  PictureOptions options = FromAbove();
  const cv::Mat without = TakePicture(map.scene, options);
  options.overlay.objects = true;
  const cv::Mat with = TakePicture(map.scene, options);
  EXPECT_LT(CountPixels(without, {230, 30, 30}), 10);
  EXPECT_GT(CountPixels(with, {230, 30, 30}), 60);    // Edges of the box.
  EXPECT_GT(CountPixels(with, {18, 21, 26}), 200);    // The plate,
  EXPECT_GT(CountPixels(with, {236, 238, 240}), 12);  // and its text.
}

TEST_F(PictureTest, TheLegendNamesTheClassesThatAreThere) {
  const TableMap map;
  PictureOptions options = FromAbove();
  options.color = ColorMode::kClasses;
  const cv::Mat without = TakePicture(map.scene, options);
  options.legend = true;
  const cv::Mat with = TakePicture(map.scene, options);
  const cv::Rect corner(0, kHeight - 50, 90, 50);
  EXPECT_GT(cv::norm(with(corner), without(corner), cv::NORM_L1), 1000);
  EXPECT_EQ(
      cv::norm(with(cv::Rect(160, 0, 160, 100)), without(cv::Rect(160, 0, 160, 100)), cv::NORM_L1),
      0);
}

TEST_F(PictureTest, TheSameMapGivesTheSamePixels) {
  const TableMap map;
  const cv::Mat a = TakePicture(map.scene, {});
  EXPECT_EQ(cv::norm(a, TakePicture(map.scene, {}), cv::NORM_INF), 0);
}

TEST(PictureOptionsTest, ImpossibleSizesAreRefused) {
  PictureOptions options;
  options.width = 100'000;
  EXPECT_THROW(options.Validate(), InputError);
  options.width = 0;
  EXPECT_THROW(options.Validate(), InputError);
}

}  // namespace
}  // namespace semslam
