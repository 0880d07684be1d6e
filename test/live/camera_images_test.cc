// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// That images arrive as they are, whatever the camera sends and however it was left.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/live/openni2_source.h"

#include "live/camera_pictures.h"
#include "live/driver/script.h"
#include "live/virtual_camera.h"

namespace semslam {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using testing::ExpectShown;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using ::testing::IsEmpty;
using testing::Read;
using testing::ShownColor;
using testing::ShownDepth;
using testing::ShownPicture;
using testing::VirtualCamera;

// So mirrored, unregistered, not taken together or dark ones, as the camera sends by itself, do not
// pass either.
TEST(CameraImages, AreThoseOfTheCamera) {
  VirtualCamera camera("");
  OpenNi2Source source(camera.Options());
  for (const RgbdImage& image : Read(source, 15)) ExpectShown(image, ShownPicture(image));
  EXPECT_THAT(camera.messages(), IsEmpty());
}

TEST(CameraImages, ReversedColorsAreTurned) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = camera.Options();
  options.is_rgb = false;
  OpenNi2Source source(options);
  const RgbdImage image = source.Next().value();
  const cv::Vec3b bgr = ShownColor(ShownPicture(image), 20, 130);
  EXPECT_EQ(image.color.at<cv::Vec3b>(20, 130), cv::Vec3b(bgr[2], bgr[1], bgr[0]));
}

TEST(CameraImages, AFixedExposureStaysAsItIs) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = camera.Options();
  options.auto_exposure = false;
  OpenNi2Source source(options);
  const RgbdImage image = source.Next().value();
  EXPECT_EQ(image.color.at<cv::Vec3b>(100, 30)[1], 25);  // A quarter.
  EXPECT_THAT(camera.messages(), IsEmpty());
}

TEST(CameraImages, UnregisteredDepthComesAsItIs) {
  VirtualCamera camera("refuse registration");
  OpenNi2Source::Options options = camera.Options();
  options.accept_unregistered = true;
  OpenNi2Source source(options);
  const RgbdImage image = source.Next().value();
  const int picture = (image.color.at<cv::Vec3b>(0, 50)[2] - 50) / 16;
  EXPECT_FLOAT_EQ(image.depth.at<float>(0, 50),
                  ShownDepth(picture, 50 - testing::Script::kParallax));
}

TEST(CameraImages, WithoutSynchronizationTheNearestOnesArePaired) {
  VirtualCamera camera("refuse sync");
  OpenNi2Source source(camera.Options());
  const std::vector<RgbdImage> images = Read(source, 15);
  EXPECT_EQ(source.statistics().num_pairs, 15u);
  EXPECT_THAT(camera.messages(), ElementsAre(HasSubstr("not taken at the same time, but 12 ms")));
  const RgbdImage& image = images.front();
  EXPECT_NE(image.color.at<cv::Vec3b>(20, 30)[2], 30 + 16 * ShownPicture(image));
}

TEST(CameraImages, TheBestOfTheOfferedFormatsIsTaken) {
  VirtualCamera camera("color GRAY8 JPEG YUV422 RGB888 YUYV\ndepth 100um 1mm");
  OpenNi2Source source(camera.Options());
  EXPECT_THAT(source.description(), AllOf(HasSubstr("RGB888"), HasSubstr("1 mm")));
  const RgbdImage image = source.Next().value();
  ExpectShown(image, ShownPicture(image));
}

TEST(CameraImages, TenthsOfMillimetresBecomeMetres) {
  VirtualCamera camera("depth 100um");
  OpenNi2Source source(camera.Options());
  EXPECT_THAT(source.description(), HasSubstr("0.1 mm"));
  const RgbdImage image = source.Next().value();
  ExpectShown(image, ShownPicture(image));
}

TEST(CameraImages, BothKindsOfYuvBecomeColors) {
  for (const std::string format : {"YUV422", "YUYV"}) {
    VirtualCamera camera("color " + format);
    OpenNi2Source source(camera.Options());
    EXPECT_THAT(source.description(), HasSubstr(format));
    constexpr int kRounding = 3;  // And two columns share one colour.
    const RgbdImage image = source.Next().value();
    ExpectShown(image, ShownPicture(image), kRounding);
  }
}

TEST(CameraImages, GrayOnesBecomeGrayColors) {
  VirtualCamera camera("color GRAY8");
  OpenNi2Source source(camera.Options());
  const RgbdImage image = source.Next().value();
  ASSERT_EQ(image.color.type(), CV_8UC3);
  const cv::Vec3b bgr = ShownColor(ShownPicture(image), 40, 60);
  const cv::Vec3b gray = image.color.at<cv::Vec3b>(40, 60);
  EXPECT_NEAR(gray[0], 0.114 * bgr[0] + 0.587 * bgr[1] + 0.299 * bgr[2], 1);
  EXPECT_EQ(gray, cv::Vec3b::all(gray[0]));
}

TEST(CameraImages, AFormatThatCannotBeReadIsRefusedByName) {
  VirtualCamera camera("color JPEG");
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(camera.Options()); }),
              AllOf(HasSubstr("expected colour images of 160x120"), HasSubstr("JPEG")));
}

}  // namespace
}  // namespace semslam
