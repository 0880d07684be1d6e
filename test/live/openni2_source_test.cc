// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/live/openni2_source.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "semslam/base/error.h"
#include "semslam/base/pause.h"
#include "semslam/live/device_list.h"

#include "live/virtual_camera.h"

namespace semslam {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::InputErrorOf;
using ::testing::IsEmpty;
using testing::Read;
using testing::VirtualCamera;

TEST(OpenNi2Source, FramesOfACameraComeAtItsRateAndInPairs) {
  VirtualCamera camera("");
  OpenNi2Source source(camera.Options());
  const std::vector<RgbdImage> images = Read(source, 10);
  ASSERT_EQ(images.size(), 10u);
  for (std::size_t i = 1; i < images.size(); ++i)
    EXPECT_NEAR(ToSeconds(images[i].time - images[i - 1].time), 1.0 / 30, 1e-4) << i;
  EXPECT_THAT(camera.messages(), IsEmpty());
}

TEST(OpenNi2Source, TimesAreThoseOfTheSystem) {
  VirtualCamera camera("");
  OpenNi2Source source(camera.Options());
  const TimeNs time = source.Next().value().time;
  const TimeNs now = std::chrono::duration_cast<std::chrono::nanoseconds>(
                         std::chrono::system_clock::now().time_since_epoch())
                         .count();
  EXPECT_NEAR(ToSeconds(now - time), 0, 0.5);
}

TEST(OpenNi2Source, TheNewestFrameWaitsAndTheRestIsCounted) {
  VirtualCamera camera("");
  OpenNi2Source source(camera.Options());
  const TimeNs first = source.Next().value().time;
  Pause(0.5);
  const TimeNs second = source.Next().value().time;
  EXPECT_GE(ToSeconds(second - first), 0.4);
  EXPECT_LT(source.SecondsSinceArrival(), 0.1);
  const OpenNi2Source::Statistics statistics = source.statistics();
  EXPECT_GE(statistics.num_dropped, 11u);
  EXPECT_EQ(statistics.num_pairs, 2u);
}

TEST(OpenNi2Source, ItEndsAfterTheDuration) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = camera.Options();
  options.duration = FromSeconds(0.5);
  OpenNi2Source source(options);
  const std::vector<RgbdImage> images = Read(source, 100);
  EXPECT_LT(ToSeconds(images.back().time - images.front().time), 0.5);
  EXPECT_GT(ToSeconds(images.back().time - images.front().time), 0.3);
  EXPECT_FALSE(source.failure());
}

TEST(OpenNi2Source, ItEndsWhenAskedTo) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = camera.Options();
  bool is_asked = false;
  options.should_stop = [&is_asked] { return is_asked; };
  OpenNi2Source source(options);
  EXPECT_EQ(Read(source, 3).size(), 3u);
  is_asked = true;
  EXPECT_FALSE(source.Next());
  EXPECT_FALSE(source.failure());
}

TEST(OpenNi2Source, TheFieldOfViewGivesIntrinsics) {
  VirtualCamera camera("");
  const OpenNi2Source source(camera.Options());
  const PinholeCamera::Parameters intrinsics = source.NominalIntrinsics().value();
  EXPECT_NEAR(intrinsics.fx, 570.0 / 4, 0.5);
  EXPECT_NEAR(intrinsics.fy, intrinsics.fx, 0.01);
  EXPECT_EQ(intrinsics.cx, 79.5);
  EXPECT_EQ(intrinsics.cy, 59.5);
}

TEST(OpenNi2Source, WithoutACameraItSaysWhatToDo) {
  VirtualCamera camera("absent");
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(camera.Options()); }),
              AllOf(HasSubstr("no camera found"), HasSubstr("lsusb")));
}

TEST(OpenNi2Source, ACameraThatAnotherProgramHasIsNamedWithTheReason) {
  VirtualCamera camera("locked Resource busy");
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(camera.Options()); }),
              AllOf(HasSubstr("clip@1"), HasSubstr("Resource busy"), HasSubstr("another program")));
}

TEST(OpenNi2Source, ACameraThatMayNotBeUsedIsNamedWithTheRuleThatAllowsIt) {
  VirtualCamera camera("locked Access denied (insufficient permissions)");
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(camera.Options()); }),
              AllOf(HasSubstr("clip@1"), HasSubstr("insufficient"), HasSubstr("udev rule")));
}

TEST(OpenNi2Source, ACameraIsFoundByItsUri) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = camera.Options();
  options.device = "clip@1";
  EXPECT_TRUE(OpenNi2Source(options).Next());
}

TEST(OpenNi2Source, AnUnknownUriIsAnsweredWithTheKnownOnes) {
  VirtualCamera camera("");
  OpenNi2Source::Options options = camera.Options();
  options.device = "clip@7";
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(options); }),
              AllOf(HasSubstr("clip@7: no such camera"), HasSubstr("found clip@1")));
}

TEST(OpenNi2Source, UnregisteredImagesAreRefusedUnlessAllowed) {
  VirtualCamera camera("refuse registration");
  OpenNi2Source::Options options = camera.Options();
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(options); }), HasSubstr("--unregistered"));
  options.accept_unregistered = true;
  OpenNi2Source source(options);
  EXPECT_TRUE(source.Next());
  EXPECT_THAT(camera.messages(), ElementsAre(HasSubstr("depth is not registered")));
}

TEST(OpenNi2Source, WhatACameraMayRefuseIsToldAndItGoesOn) {
  VirtualCamera camera("refuse exposure\nrefuse mirroring");
  OpenNi2Source::Options options = camera.Options();
  options.auto_exposure = false;
  OpenNi2Source source(options);
  EXPECT_EQ(Read(source, 5).size(), 5u);
  EXPECT_THAT(camera.messages(), ElementsAre(HasSubstr("exposure")));
}

TEST(OpenNi2Source, ImagesThatStayMirroredAreRefused) {
  VirtualCamera camera("refuse unmirroring");
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(camera.Options()); }),
              HasSubstr("colour images are mirrored"));
}

TEST(OpenNi2Source, ACameraWithoutOneOfTheSensorsIsRefused) {
  for (const auto& [script, name] :
       {std::pair("refuse depth", "depth"), {"refuse color", "colour"}}) {
    VirtualCamera camera(script);
    EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(camera.Options()); }),
                HasSubstr("found no " + std::string(name) + " sensor"));
  }
}

TEST(OpenNi2Source, AnotherImageSizeIsRefusedAndTheOfferedOnesAreNamed) {
  VirtualCamera camera("refuse size");
  EXPECT_THAT(InputErrorOf([&] { OpenNi2Source source(camera.Options()); }),
              AllOf(HasSubstr("expected depth images of 160x120"), HasSubstr("80x60, 30/s, 1 mm")));
}

struct FaultCase {
  std::string name;
  std::string script;
  std::string message;
};
void PrintTo(const FaultCase& fault, std::ostream* out) { *out << fault.script; }

class OpenNi2SourceFault : public ::testing::TestWithParam<FaultCase> {};

TEST_P(OpenNi2SourceFault, IsReportedAndFramesComeAgain) {
  VirtualCamera camera(GetParam().script);
  OpenNi2Source::Options options = camera.Options();
  options.duration = FromSeconds(1.6);
  OpenNi2Source source(options);
  const std::vector<RgbdImage> images = Read(source, 1000);
  EXPECT_THAT(camera.messages(),
              ElementsAre(HasSubstr(GetParam().message), HasSubstr("images come again")));
  EXPECT_FALSE(source.failure());
  EXPECT_EQ(source.statistics().num_interruptions, 1u);
  ASSERT_GT(images.size(), 20u);
  EXPECT_GE(ToSeconds(images.back().time - images.front().time), 1.3);
  for (std::size_t i = 1; i < images.size(); ++i) {
    EXPECT_GT(images[i].time, images[i - 1].time);
    EXPECT_EQ(images[i].color.size(), images[0].color.size());
  }
}

TEST_P(OpenNi2SourceFault, ThatLastsTooLongEndsItWithAReason) {
  std::string script = GetParam().script;
  script.replace(script.rfind(' '), std::string::npos, " 100");
  VirtualCamera camera(script);
  OpenNi2Source::Options options = camera.Options();
  options.patience_seconds = 0.5;
  OpenNi2Source source(options);
  EXPECT_GE(Read(source, 1000).size(), 1u);
  EXPECT_THAT(source.failure().value_or(""), HasSubstr("did not come back within 0.5 s"));
  EXPECT_THAT(camera.messages(), ElementsAre(HasSubstr(GetParam().message)));
}

INSTANTIATE_TEST_SUITE_P(
    All,
    OpenNi2SourceFault,
    ::testing::Values(FaultCase{"Unplugged", "unplug 0.3 0.4", "was unplugged"},
                      FaultCase{"Stalled", "stall 0.3 0.4", "no images for"},
                      FaultCase{"NoColor", "no_color 0.3 0.4", "no colour images for"},
                      FaultCase{"NoDepth", "no_depth 0.3 0.4", "no depth images for"},
                      FaultCase{"Size", "format 0.3 0.4",
                                "expected colour images of 160x120, 30/s, RGB888, found 80x60"}),
    [](const auto& parameter) { return parameter.param.name; });

// The camera was asked for colours each time it was opened; gray is better than nothing.
TEST(OpenNi2Source, AnotherFormatIsReportedAndThenReadAsItComes) {
  VirtualCamera camera("gray 0.3 0.4");
  OpenNi2Source::Options options = camera.Options();
  options.duration = FromSeconds(1);
  OpenNi2Source source(options);
  EXPECT_GT(Read(source).size(), 15u);
  const auto expected = [](const std::string& format, const std::string& found) {
    return HasSubstr("expected colour images of 160x120, 30/s, " + format +
                     ", found 160x120, 30/s, " + found);
  };
  EXPECT_THAT(camera.messages(),
              ElementsAre(expected("RGB888", "GRAY8"), HasSubstr("images come again"),
                          expected("GRAY8", "RGB888"), HasSubstr("images come again")));
}

std::ptrdiff_t NumEntries(const char* folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

// Memory is the address sanitizer's to look at.
TEST(OpenNi2Source, ItCanBeOpenedAndClosedOftenAndLeavesNoThreadOrFile) {
  VirtualCamera camera("");
  std::ptrdiff_t num_threads = 0;
  std::ptrdiff_t num_files = 0;
  for (int i = 0; i < 20; ++i) {
    {
      OpenNi2Source source(camera.Options());
      if (i % 2 == 0) {
        EXPECT_TRUE(source.Next());
      }
    }
    if (i == 0) {
      num_threads = NumEntries("/proc/self/task");
      num_files = NumEntries("/proc/self/fd");
    }
  }
  EXPECT_EQ(NumEntries("/proc/self/task"), num_threads);
  EXPECT_EQ(NumEntries("/proc/self/fd"), num_files);
}

TEST(OpenNi2Source, ItSurvivesTwentyTimesUnplugging) {
  std::string script;
  for (int i = 0; i < 20; ++i) script += "unplug " + std::to_string(0.3 + 0.35 * i) + " 0.05\n";
  VirtualCamera camera(script);
  OpenNi2Source::Options options = camera.Options();
  options.duration = FromSeconds(7.5);
  OpenNi2Source source(options);
  EXPECT_GT(Read(source, 1000).size(), 20u);
  EXPECT_FALSE(source.failure());
  EXPECT_EQ(source.statistics().num_interruptions, 20u);
}

TEST(OpenNi2DeviceList, NamesCamerasAndTheirModes) {
  VirtualCamera camera("");
  const std::vector<OpenNi2Device> devices = ListOpenNi2Devices();
  ASSERT_EQ(devices.size(), 1u);
  EXPECT_EQ(devices[0].uri, "clip@1");
  EXPECT_EQ(devices[0].name, "Virtual camera");
  EXPECT_EQ(devices[0].problem, "");
  EXPECT_TRUE(devices[0].can_register);
  ASSERT_EQ(devices[0].color_modes.size(), 2u);
  EXPECT_EQ(devices[0].color_modes[0].format, "RGB888");
  EXPECT_EQ(devices[0].depth_modes[0].format, "1 mm");
}

TEST(OpenNi2DeviceList, SaysWhyACameraCannotBeOpened) {
  VirtualCamera camera("locked Resource busy");
  const std::vector<OpenNi2Device> devices = ListOpenNi2Devices();
  ASSERT_EQ(devices.size(), 1u);
  EXPECT_THAT(devices[0].problem, HasSubstr("Resource busy"));
}

}  // namespace
}  // namespace semslam
