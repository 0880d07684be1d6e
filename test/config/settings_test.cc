// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/config/settings.h"

#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "semslam/config/settings_file.h"

#include "support/files.h"

namespace semslam {
namespace {

using ::testing::ElementsAre;
using testing::InputErrorOf;
using ::testing::IsEmpty;
using testing::ReadAll;
using testing::TemporaryFolder;

const std::filesystem::path kConfigFolder = SEMSLAM_SOURCE_DIR "/config";

// TUM1.yaml with one text of it replaced.
std::string Tum1With(const std::string& from, const std::string& to) {
  std::string text = ReadAll(kConfigFolder / "TUM1.yaml");
  const std::size_t position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from;
  return text.replace(position, from.size(), to);
}

std::string ErrorOfTum1With(const std::string& from, const std::string& to) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.Write("s.yaml", Tum1With(from, to));
  const std::string text = InputErrorOf([&] { LoadSettings(path); });
  EXPECT_TRUE(text.starts_with(path.string() + ": ")) << text;
  return text.substr(path.string().size() + 2);
}

TEST(Settings, LoadEveryShippedFileWithoutWarning) {
  int num_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kConfigFolder)) {
    if (entry.path().extension() != ".yaml") continue;
    const Settings settings = LoadSettings(entry.path());
    EXPECT_THAT(settings.warnings, IsEmpty()) << entry.path();
    EXPECT_NO_THROW(PinholeCamera{settings.camera});
    ++num_files;
  }
  EXPECT_GE(num_files, 5);
}

TEST(Settings, OpenCvReadsTheSameNumbers) {
  for (const char* name : {"TUM1.yaml", "TUM2.yaml", "TUM3.yaml", "Xtion.yaml", "Demo.yaml"}) {
    const Settings settings = LoadSettings(kConfigFolder / name);
    const cv::FileStorage file((kConfigFolder / name).string(), cv::FileStorage::READ);
    const auto number = [&](const char* key) { return static_cast<double>(file[key]); };
    EXPECT_EQ(settings.camera.fx, number("Camera.fx")) << name;
    EXPECT_EQ(settings.camera.fy, number("Camera.fy")) << name;
    EXPECT_EQ(settings.camera.cx, number("Camera.cx")) << name;
    EXPECT_EQ(settings.camera.cy, number("Camera.cy")) << name;
    EXPECT_EQ(settings.camera.k1, number("Camera.k1")) << name;
    EXPECT_EQ(settings.camera.k2, number("Camera.k2")) << name;
    EXPECT_EQ(settings.camera.p1, number("Camera.p1")) << name;
    EXPECT_EQ(settings.camera.p2, number("Camera.p2")) << name;
    EXPECT_EQ(settings.camera.k3, number("Camera.k3")) << name;
    EXPECT_EQ(settings.depth_factor, number("DepthMapFactor")) << name;
    EXPECT_EQ(settings.close_depth_factor, number("ThDepth")) << name;
    EXPECT_EQ(settings.orb.num_levels, number("ORBextractor.nLevels")) << name;
  }
}

TEST(Settings, HoldTheBenchmarksCalibration) {
  const Settings settings = LoadSettings(kConfigFolder / "TUM1.yaml");
  EXPECT_EQ(settings.camera.width, 640);
  EXPECT_EQ(settings.camera.fx, 517.306408);
  EXPECT_EQ(settings.camera.k3, 1.163314);
  EXPECT_EQ(settings.orb.num_features, 1000);
  EXPECT_EQ(settings.orb.min_fast_threshold, 7);
  EXPECT_NEAR(settings.CloseDepth(), 40 * 40 / 517.306408, 1e-12);
}

TEST(Settings, TakeTheRollingShutterAsGivenElseItIsEstimated) {
  const TemporaryFolder folder;
  EXPECT_EQ(LoadSettings(kConfigFolder / "TUM1.yaml").tracking.shutter.readout_seconds, 0.026);
  const auto global =
      folder.Write("global.yaml", Tum1With("Camera.readout:", "Camera.readout: 0 #"));
  EXPECT_EQ(LoadSettings(global).tracking.shutter.readout_seconds, 0);
  const auto unknown = folder.Write("unknown.yaml", Tum1With("Camera.readout:", "#"));
  EXPECT_EQ(LoadSettings(unknown).tracking.shutter.readout_seconds, std::nullopt);
  EXPECT_EQ(ErrorOfTum1With("Camera.readout:", "Camera.readout: 26 #"),
            "Camera.readout: expected a number from -0.05 to 0.05, found 26");
}

TEST(Settings, TakeTheViewersKeysOfThePublishedSystemInSilence) {
  const TemporaryFolder folder;
  const auto path =
      folder.Write("s.yaml", ReadAll(kConfigFolder / "TUM1.yaml") +
                                 "Viewer.KeyFrameSize: 0.05\nViewer.ViewpointZ: -1.8\n");
  EXPECT_THAT(LoadSettings(path).warnings, IsEmpty());
}

TEST(Settings, WarnOfAKeyThatNobodyKnows) {
  const TemporaryFolder folder;
  const auto path = folder.Write("s.yaml", Tum1With("Camera.k3:", "Camera.k4:"));
  EXPECT_THAT(LoadSettings(path).warnings,
              ElementsAre(::testing::EndsWith("Camera.k4: unknown key")));
}

TEST(Settings, NeedEveryKeyOfTheStockFiles) {
  for (const char* key :
       {"Camera.fx", "Camera.fy", "Camera.cx", "Camera.cy", "Camera.k1", "Camera.k2", "Camera.p1",
        "Camera.p2", "Camera.width", "Camera.height", "Camera.fps", "Camera.bf", "ThDepth",
        "DepthMapFactor", "ORBextractor.nFeatures", "ORBextractor.scaleFactor",
        "ORBextractor.nLevels", "ORBextractor.iniThFAST", "ORBextractor.minThFAST"}) {
    EXPECT_EQ(ErrorOfTum1With(std::string(key) + ":", "# "), std::string(key) + ": missing");
  }
}

TEST(Settings, RejectANegativeFocalLength) {
  EXPECT_EQ(ErrorOfTum1With("fx: 517.306408", "fx: -517.3"),
            "Camera.fx: expected a number > 0, found -517.3");
}

TEST(Settings, RejectATextWhereANumberBelongs) {
  EXPECT_EQ(ErrorOfTum1With("Camera.cx: 318.643040", "Camera.cx: centre"),
            "Camera.cx: expected a number, found centre");
}

TEST(Settings, RejectASecondThresholdAboveTheFirst) {
  EXPECT_EQ(ErrorOfTum1With("minThFAST: 7", "minThFAST: 30"),
            "ORBextractor.minThFAST: expected an integer from 1 to 20, found 30");
}

TEST(Settings, AreAllExplained) {
  const std::string explanation = ReadAll(kConfigFolder / "README.md");
  const std::string text = ReadAll(kConfigFolder / "TUM1.yaml");
  SettingsFile file("TUM1.yaml", text);
  for (const std::string& line : file.UnknownKeys()) {  // Nothing read yet: all keys.
    const std::size_t end = line.rfind(": unknown key");
    const std::size_t first = line.rfind(' ', end - 1) + 1;
    const std::string key = line.substr(first, end - first);
    EXPECT_NE(explanation.find(key), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace semslam
