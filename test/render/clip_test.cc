// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/clip.h"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "support/desk_clip.h"
#include "support/files.h"

namespace semslam {
namespace {

using testing::CleanDeskClipOptions;
using testing::DeskClipOptions;
using testing::InputErrorOf;

bool SameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

bool SameFrame(const RenderedFrame& a, const RenderedFrame& b) {
  return SameBytes(a.color, b.color) && SameBytes(a.depth_16u, b.depth_16u) &&
         SameBytes(a.ideal.labels, b.ideal.labels) && SameBytes(a.ideal.depth, b.ideal.depth);
}

TEST(RenderedClip, GivesTheSameBytesOnOneThreadAndOnThree) {
  RenderedClip::Options options = DeskClipOptions(8);
  options.num_threads = 1;
  const RenderedFrame one = RenderedClip(options).Frame(5);
  options.num_threads = 3;
  EXPECT_TRUE(SameFrame(one, RenderedClip(options).Frame(5)));
}

TEST(RenderedClip, AFrameDoesNotDependOnWhatWasAskedBefore) {
  const RenderedClip clip(DeskClipOptions(4));
  const RenderedFrame first = clip.Frame(3);
  clip.Frame(0);
  EXPECT_TRUE(SameFrame(first, clip.Frame(3)));
}

TEST(RenderedClip, AnotherSeedIsAnotherClip) {
  RenderedClip::Options options = DeskClipOptions(1);
  const RenderedFrame one = RenderedClip(options).Frame(0);
  options.seed = 2;
  EXPECT_FALSE(SameFrame(one, RenderedClip(options).Frame(0)));
}

TEST(RenderedClip, IsASourceOfItsFrames) {
  RenderedClip clip(DeskClipOptions(2));
  EXPECT_EQ(clip.NumFrames(), 2U);
  const std::optional<RgbdImage> first = clip.Next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->time, clip.Time(0));
  EXPECT_EQ(first->color.type(), CV_8UC3);
  EXPECT_EQ(first->depth.type(), CV_32FC1);
  EXPECT_TRUE(clip.Next());
  EXPECT_FALSE(clip.Next());
}

TEST(RenderedClip, TimesAreWholeMicroseconds) {
  const RenderedClip clip(DeskClipOptions(3));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(ParseTime(FormatTime(clip.Time(i))), clip.Time(i));
}

// Every pixel of a clean frame, taken back into the world, lies in the box of the instance that its
// label names: depth, labels, pose, camera and boxes agree.
TEST(RenderedClip, BackProjectedPixelsLieInTheBoxOfTheirInstance) {
  RenderedClip::Options options = CleanDeskClipOptions(60);
  options.camera = CameraByName("TUM1");
  const RenderedClip clip(options);
  const RenderedFrame frame = clip.Frame(40);
  const RayTable rays(clip.camera());
  const cv::Mat depth = DepthToMetres(frame.depth_16u, options.depth_factor);
  std::set<int> seen;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const int id = frame.ideal.labels.at<std::uint16_t>(y, x);
      ASSERT_GT(id, 0);  // The room is closed.
      const Eigen::Vector3d p_world =
          frame.T_world_camera * rays.Unproject(x, y, depth.at<float>(y, x)).cast<double>();
      OrientedBox box = clip.instances()[id - 1].box;
      box.half_size.array() += 4e-4;  // Rounding of depth, at most 0.1 mm times the ray's length.
      ASSERT_TRUE(box.Contains(p_world))
          << clip.instances()[id - 1].class_name << " at " << x << ' ' << y;
      seen.insert(id);
    }
  }
  EXPECT_GT(seen.size(), 10U);
}

TEST(RenderedClip, NoisyDepthLiesOnTheSurfaceWithinTheNoiseModel) {
  const RenderedClip clip(DeskClipOptions(30));
  const RenderedFrame frame = clip.Frame(20);
  const DepthSensorOptions& model = clip.options().depth;
  int num_valid = 0;
  int num_outside = 0;
  for (int y = 0; y < frame.depth_16u.rows; ++y) {
    for (int x = 0; x < frame.depth_16u.cols; ++x) {
      const double measured = frame.depth_16u.at<std::uint16_t>(y, x) / clip.options().depth_factor;
      if (measured <= 0) continue;
      const double truth = frame.ideal.depth.at<double>(y, x);
      // The noise's largest value, half a step, and rounding.
      const double limit = truth * truth / (model.focal_px * model.baseline_m) *
                               (3.5 * model.disparity_noise_px + 0.5 * model.disparity_step_px) *
                               1.05 +
                           1e-4;
      ++num_valid;
      num_outside += std::abs(measured - truth) > limit ? 1 : 0;
    }
  }
  EXPECT_GT(num_valid, 0.75 * frame.depth_16u.rows * frame.depth_16u.cols);
  EXPECT_LT(num_outside, 0.03 * num_valid);  // Frayed edges.
  EXPECT_GT(num_outside, 0);
}

// The nearest triangle that a ray from `origin` meets, found by trying all, in double precision.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  int instance_id = 0;
};

Nearest NearestTriangle(const Scene& scene,
                        const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& direction) {
  Nearest nearest;
  for (const ScenePart& part : scene.parts()) {
    for (const Eigen::Vector3i& corners : part.mesh.triangles) {
      // Moeller and Trumbore, 1997.
      const Eigen::Vector3d a = part.mesh.positions[corners[0]].cast<double>();
      const Eigen::Vector3d ab = part.mesh.positions[corners[1]].cast<double>() - a;
      const Eigen::Vector3d ac = part.mesh.positions[corners[2]].cast<double>() - a;
      const Eigen::Vector3d h = direction.cross(ac);
      const double determinant = ab.dot(h);
      if (std::abs(determinant) < 1e-18) continue;
      const Eigen::Vector3d s = origin - a;
      const double u = s.dot(h) / determinant;
      if (u < 0 || u > 1) continue;
      const Eigen::Vector3d q = s.cross(ab);
      const double v = direction.dot(q) / determinant;
      if (v < 0 || u + v > 1) continue;
      const double distance = ac.dot(q) / determinant;
      if (distance > 0 && distance < nearest.distance) nearest = {distance, part.instance_id};
    }
  }
  return nearest;
}

TEST(RenderedClip, DepthAndLabelsAreThoseOfAnExhaustiveSearch) {
  RenderedClip::Options options = testing::SmallDeskClipOptions(60);
  const RenderedClip clip(options);
  const RayTable rays(clip.camera());
  const RenderedFrame frame = clip.Frame(25);
  int num_wrong = 0;
  int num_tried = 0;
  for (int y = 3; y < 240; y += 19) {
    for (int x = 5; x < 320; x += 13) {
      const Eigen::Vector3d direction =
          frame.T_world_camera.rotation * rays.Unproject(x, y, 1.0F).cast<double>();
      const Nearest expected =
          NearestTriangle(clip.scene(), frame.T_world_camera.translation, direction);
      const bool is_right =
          std::abs(frame.ideal.depth.at<double>(y, x) - expected.distance) < 1e-4 &&
          frame.ideal.labels.at<std::uint16_t>(y, x) == expected.instance_id;
      num_wrong += is_right ? 0 : 1;
      ++num_tried;
    }
  }
  EXPECT_GT(num_tried, 300);
  EXPECT_LE(num_wrong, 1);  // A ray within a rounding error of an edge may go either way.
}

// Where depth jumps near a border between two labels: how often the border is between the same two
// pixels, with the labels taken `shift` pixels to the right.
double ShareOfJumpsOnLabelBorders(const RenderedFrame& frame, int shift) {
  constexpr double kJump = 0.05;  // m; no surface slopes as much within a pixel at this range.
  constexpr int kReach = 3;       // Pixels.
  const cv::Mat& depth = frame.ideal.depth;
  int num_jumps = 0;
  int num_on_borders = 0;
  for (int y = 0; y < depth.rows; ++y) {
    const auto* z = depth.ptr<double>(y);
    const auto* label = frame.ideal.labels.ptr<std::uint16_t>(y) + shift;
    for (int x = kReach; x + kReach + shift < depth.cols; ++x) {
      if (std::abs(z[x] - z[x - 1]) < kJump) continue;
      const auto differs = [&](int i) { return label[i] != label[i - 1]; };
      bool is_near_a_border = false;
      for (int i = x - kReach + 1; i < x + kReach; ++i) is_near_a_border |= differs(i);
      if (!is_near_a_border) continue;  // A thing before itself.
      ++num_jumps;
      num_on_borders += differs(x) ? 1 : 0;
    }
  }
  EXPECT_GT(num_jumps, 500);
  return static_cast<double>(num_on_borders) / num_jumps;
}

TEST(RenderedClip, LabelsChangeWhereDepthJumps) {
  const RenderedFrame frame = RenderedClip(CleanDeskClipOptions(30)).Frame(20);
  EXPECT_GT(ShareOfJumpsOnLabelBorders(frame, 0), 0.97);  // The rest: a thing before itself.
  EXPECT_LT(ShareOfJumpsOnLabelBorders(frame, 1), 0.5);   // A pixel off would be noticed.
}

TEST(RenderedClip, CoveredFramesAreDarkNoiseWithoutDepth) {
  RenderedClip::Options options = testing::SmallDeskClipOptions(6);
  const RenderedClip open(options);
  options.covered = {.from_s = 2 / 30.0 - 1e-3, .to_s = 4 / 30.0 - 1e-3};
  const RenderedClip covered(options);
  for (std::size_t i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    const RenderedFrame frame = covered.Frame(i);
    if (i == 2 || i == 3) {
      EXPECT_TRUE(covered.IsCovered(i));
      EXPECT_EQ(cv::countNonZero(frame.depth_16u), 0);
      EXPECT_GT(cv::countNonZero(frame.color.reshape(1)), 1000);
      double largest = 0;
      cv::minMaxLoc(frame.color.reshape(1), nullptr, &largest);
      EXPECT_LT(largest, 8);  // Five standard deviations.
      EXPECT_TRUE(SameBytes(frame.ideal.labels, open.Frame(i).ideal.labels));
    } else {
      EXPECT_TRUE(SameFrame(frame, open.Frame(i)));
    }
  }
}

TEST(RenderedClip, CleanFramesSeeTheSamePointInTheSameColour) {
  // A point seen in frame 0 is looked up in frame 6 by pose and depth alone.
  const RenderedClip clip(CleanDeskClipOptions(8));
  const RenderedFrame a = clip.Frame(0);
  const RenderedFrame b = clip.Frame(6);
  const RayTable rays(clip.camera());
  const Rigid3 T_b_a = b.T_world_camera.Inverse() * a.T_world_camera;
  int num_compared = 0;
  double sum_depth = 0;
  double sum_color = 0;
  for (int y = 20; y < 460; y += 3) {
    for (int x = 20; x < 620; x += 3) {
      const Eigen::Vector3d p_b =
          T_b_a *
          rays.Unproject(x, y, static_cast<float>(a.ideal.depth.at<double>(y, x))).cast<double>();
      const Eigen::Vector2d pixel = clip.camera().Project(p_b);
      const int u = cvRound(pixel.x());
      const int v = cvRound(pixel.y());
      if (u < 0 || v < 0 || u >= 640 || v >= 480) continue;
      if (a.ideal.labels.at<std::uint16_t>(y, x) != b.ideal.labels.at<std::uint16_t>(v, u))
        continue;
      const double depth_error = std::abs(b.ideal.depth.at<double>(v, u) - p_b.z());
      if (depth_error > 0.02) continue;  // Hidden by another part of the same thing.
      sum_depth += depth_error;
      sum_color +=
          cv::norm(cv::Vec3i(a.color.at<cv::Vec3b>(y, x)) - cv::Vec3i(b.color.at<cv::Vec3b>(v, u)));
      ++num_compared;
    }
  }
  ASSERT_GT(num_compared, 20000);
  EXPECT_LT(sum_depth / num_compared, 1.5e-3);  // The slope of a surface times half a pixel.
  EXPECT_LT(sum_color / num_compared, 12);      // Texture times half a pixel.
}

TEST(RenderedClip, ASmallFrameSeesWhatTheLargeOneSees) {
  const RenderedFrame small = RenderedClip(testing::SmallDeskClipOptions(1)).Frame(0);
  const RenderedFrame large = RenderedClip(DeskClipOptions(1)).Frame(0);
  ASSERT_EQ(small.color.size(), cv::Size(320, 240));
  int num_equal = 0;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      num_equal += small.ideal.labels.at<std::uint16_t>(y, x) ==
                           large.ideal.labels.at<std::uint16_t>(2 * y, 2 * x)
                       ? 1
                       : 0;
    }
  }
  EXPECT_GT(num_equal, 0.97 * 320 * 240);  // Half a pixel of all edges.
}

TEST(RenderedClip, UnknownNamesAreErrorsThatListTheKnown) {
  EXPECT_EQ(
      InputErrorOf([] { RenderedClip({.scene = "moon"}); }),
      "scene moon: unknown, expected one of desk, random, room, structure, wall or a .yaml file");
  EXPECT_EQ(InputErrorOf([] { CameraByName("Leica"); }),
            "camera Leica: unknown, expected one of TUM1, TUM3, Xtion");
}

TEST(RenderedClip, ImpossibleOptionsAreErrors) {
  EXPECT_EQ(InputErrorOf([] { RenderedClip({.num_frames = 0}); }),
            "frames: expected at least 1, found 0");
  EXPECT_NE(InputErrorOf([] { RenderedClip({.fps = -1}); }).find("fps"), std::string::npos);
  RenderedClip::Options backwards;
  backwards.covered = {.from_s = 2, .to_s = 1};
  EXPECT_NE(InputErrorOf([&] { RenderedClip{backwards}; }).find("covered"), std::string::npos);
}

}  // namespace
}  // namespace semslam
