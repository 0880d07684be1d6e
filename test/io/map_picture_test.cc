// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/map_picture.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "semslam/io/level_frame.h"
#include "semslam/io/view_camera.h"

#include "io/point_renderer.h"
#include "support/file_size_limit.h"
#include "support/files.h"

namespace semslam {
namespace {

using ::testing::HasSubstr;
using testing::InputErrorOf;
using testing::TemporaryFolder;

constexpr MapPictureOptions kSmall{.panel_width = 160, .panel_height = 120, .supersampling = 2};
constexpr double kSpacing = 0.01;

// A table (y = 0, y points down) of 1 m x 1 m in front of the camera, with a red block on it.
struct TableScene {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Rgb> colors;
  std::vector<std::uint32_t> segments;
  std::vector<std::uint32_t> labels;

  TableScene() {
    for (int i = -50; i <= 50; ++i) {
      for (int j = 0; j <= 100; ++j) Add(Cell(i, 0, j), {200, 200, 200}, 1, 0);
    }
    for (int i = 0; i <= 20; ++i) {
      for (int j = 40; j <= 60; ++j) Add(Cell(i, -20, j), {220, 20, 20}, 2, 5);
    }
  }

  static Eigen::Vector3f Cell(int i, int j, int k) {
    return static_cast<float>(kSpacing) * Eigen::Vector3i(i, j, k + 100).cast<float>();
  }
  void Add(const Eigen::Vector3f& p, Rgb color, std::uint32_t segment, std::uint32_t label) {
    positions.push_back(p);
    normals.push_back(-Eigen::Vector3f::UnitY());
    colors.push_back(color);
    segments.push_back(segment);
    labels.push_back(label);
  }
  LabelledMapView Input() const {
    LabelledMapView input;
    input.cloud = {.positions = positions,
                   .colors = colors,
                   .normals = normals,
                   .labels = labels,
                   .segments = segments};
    input.point_size = kSpacing;
    input.classes = {{5, "block", {0, 0, 255}}};
    return input;
  }
};

// Pixels of a panel (0 to 2) whose strongest channel (BGR) is `channel`, by far.
int CountPixels(const cv::Mat& picture, int panel, int channel) {
  const int x = panel * (picture.cols - kSmall.panel_width) / 2;
  const cv::Mat part = picture(cv::Rect(x, 36, kSmall.panel_width, kSmall.panel_height));
  int count = 0;
  for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(part)) {
    const int other = std::max(pixel[(channel + 1) % 3], pixel[(channel + 2) % 3]);
    count += pixel[channel] > other + 60 ? 1 : 0;
  }
  return count;
}

TEST(MapPicture, ShowsColourAndClassAtTheSamePlaces) {
  const TableScene scene;
  const cv::Mat picture = DrawMapPicture(scene.Input(), MapPictureView::kTop, kSmall);
  const int num_red = CountPixels(picture, 0, 2);
  const int num_blue = CountPixels(picture, 2, 0);
  EXPECT_GT(num_red, 100);
  EXPECT_NEAR(num_red, num_blue, 0.1 * num_red);
}

TEST(MapPicture, ShowsAreasInProportionFromAbove) {
  // The block covers 0.21 x 0.21 m of 1.01 x 1.01 m; being 0.2 m nearer it looks a little larger.
  const TableScene scene;
  const cv::Mat picture = DrawMapPicture(scene.Input(), MapPictureView::kTop, kSmall);
  const cv::Mat panel = picture(cv::Rect(0, 36, kSmall.panel_width, kSmall.panel_height));
  int num_points = 0;
  for (const cv::Vec3b& pixel : cv::Mat_<cv::Vec3b>(panel)) num_points += pixel[2] > 120 ? 1 : 0;
  EXPECT_NEAR(CountPixels(picture, 0, 2), num_points * 0.21 * 0.21 / (1.01 * 1.01),
              0.02 * num_points);
  EXPECT_GT(num_points, kSmall.panel_height * kSmall.panel_height / 2);
}

TEST(MapPicture, GivesTheSamePixelsEveryTime) {
  const TableScene scene;
  const cv::Mat a = DrawMapPicture(scene.Input(), MapPictureView::kPerspective, kSmall);
  const cv::Mat b = DrawMapPicture(scene.Input(), MapPictureView::kPerspective, kSmall);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0);
}

TEST(MapPicture, TurnsTheWorldUpright) {
  // The same scene seen by a first camera that looks 0.5 rad down: the picture must stay the same.
  const TableScene scene;
  TableScene turned = scene;
  const Eigen::Matrix3f rotation =
      Eigen::AngleAxisf(0.5F, Eigen::Vector3f::UnitX()).toRotationMatrix();
  for (Eigen::Vector3f& p : turned.positions) p = rotation * p;
  for (Eigen::Vector3f& n : turned.normals) n = rotation * n;
  const cv::Mat upright = DrawMapPicture(scene.Input(), MapPictureView::kPerspective, kSmall);
  const cv::Mat picture = DrawMapPicture(turned.Input(), MapPictureView::kPerspective, kSmall);
  EXPECT_LT(cv::norm(upright, picture, cv::NORM_L1) / static_cast<double>(upright.total()), 3.0);
}

TEST(MapPicture, DrawsTheBoxesOfObjectsOnlyInTheSemanticPanel) {
  const TableScene scene;
  LabelledMapView input = scene.Input();
  const cv::Mat without = DrawMapPicture(input, MapPictureView::kTop, kSmall);
  ObjectRecord object;
  object.label = 5;
  object.centroid = {0.1, -0.1, 1.5};
  object.box = {{Eigen::Quaterniond::Identity(), object.centroid}, {0.1, 0.1, 0.1}};
  input.objects = {object};
  const cv::Mat with = DrawMapPicture(input, MapPictureView::kTop, kSmall);
  const cv::Rect first_two(0, 36, 2 * kSmall.panel_width, kSmall.panel_height);
  const cv::Rect third(with.cols - kSmall.panel_width, 36, kSmall.panel_width, kSmall.panel_height);
  EXPECT_EQ(cv::norm(with(first_two), without(first_two), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(with(third), without(third), cv::NORM_INF), 100);
}

TEST(MapPicture, TakesAnyCloud) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::vector<Eigen::Vector3f>> clouds = {
      {},
      {{nan, 0, 1}},
      {{0, 0, 1}},
      {{1, 2, 3}, {1, 2, 3}},
      {{0, 0, 0}, {1e6F, 0, 0}, {nan, nan, nan}},
      {{-1e-6F, 0, 0}, {0, 1e-6F, 0}}};
  for (const auto& positions : clouds) {
    LabelledMapView input;
    input.cloud.positions = positions;
    for (const MapPictureView view : {MapPictureView::kTop, MapPictureView::kPerspective}) {
      const cv::Mat picture = DrawMapPicture(input, view, kSmall);
      EXPECT_EQ(picture.type(), CV_8UC3);
      EXPECT_GT(picture.cols, 3 * kSmall.panel_width);
    }
  }
}

TEST(MapPicture, WritesBothFiles) {
  const TemporaryFolder folder;
  const TableScene scene;
  WriteMapPictures(folder.path(), scene.Input(), kSmall);
  for (const char* name : {"semantic_map_top.png", "semantic_map_view.png"}) {
    EXPECT_GT(cv::imread((folder.path() / name).string()).cols, 3 * kSmall.panel_width) << name;
  }
  EXPECT_EQ(folder.NumFiles(), 2u);
}

TEST(MapPicture, LeavesNothingOnAFullDisk) {
  const TemporaryFolder folder;
  const TableScene scene;
  const testing::FileSizeLimit limit(1000);
  EXPECT_THAT(InputErrorOf([&] { WriteMapPictures(folder.path(), scene.Input(), kSmall); }),
              HasSubstr("semantic_map_top.png: cannot write"));
  EXPECT_EQ(folder.NumFiles(), 0u);
}

TEST(PointRenderer, ShowsTheNearestPoint) {
  const std::vector<Eigen::Vector3f> positions = {{0, 0, 3}, {0, 0, 2}, {0, 0, 4}, {0, 0, -1}};
  ViewCamera camera;
  camera.focal_length = 100;
  camera.width = camera.height = 11;
  const PointImage image = RenderPoints(positions, camera, 0.02);
  EXPECT_EQ(image.points.at<std::int32_t>(5, 5), 1);
  EXPECT_EQ(image.depths.at<float>(5, 5), 2.0F);
  EXPECT_EQ(image.points.at<std::int32_t>(0, 0), PointImage::kNone);
}

TEST(PointRenderer, DarkensWhatIsBesideNearerPoints) {
  std::vector<Eigen::Vector3f> positions;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) {
      positions.emplace_back(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(j), 2.0F);
    }
  }
  positions.emplace_back(0, 0, 1.0F);
  ViewCamera camera;
  camera.focal_length = 100;
  camera.width = camera.height = 15;
  const PointImage image = RenderPoints(positions, camera, 0.02);
  EXPECT_EQ(image.lighting.at<float>(7, 7), 1.0F);
  EXPECT_LT(image.lighting.at<float>(7, 9), 0.95F);
  EXPECT_EQ(image.lighting.at<float>(1, 1), 1.0F);
}

TEST(PointRenderer, FitsThePointsIntoThePicture) {
  std::vector<Eigen::Vector3f> positions;
  for (int i = 0; i < 1000; ++i) {
    const auto s = static_cast<float>(i);
    positions.emplace_back(std::sin(s) * 3 + 7, std::cos(1.7F * s), std::sin(2.3F * s) * 2 - 5);
  }
  const Eigen::Vector3f forward(0.3F, 0.5F, -0.8F);
  const ViewCamera camera = FitCamera(positions, forward, {0, -1, 0}, 0.8F, 200, 150);
  int num_inside = 0;
  Eigen::AlignedBox2f used;
  for (const Eigen::Vector3f& p : positions) {
    const Eigen::Vector3f p_camera = camera.ToCamera(p);
    ASSERT_GT(p_camera.z(), 0);
    const Eigen::Vector2f pixel = camera.Project(p_camera);
    const bool is_inside = pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < 200 && pixel.y() < 150;
    num_inside += is_inside ? 1 : 0;
    if (is_inside) used.extend(pixel);
  }
  EXPECT_GT(num_inside, 930);
  EXPECT_TRUE(used.sizes().x() > 170 || used.sizes().y() > 125) << used.sizes().transpose();
}

}  // namespace
}  // namespace semslam
