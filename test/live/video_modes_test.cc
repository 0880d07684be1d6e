// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/video_modes.h"

#include <gtest/gtest.h>

namespace semslam {
namespace {

const std::vector<OpenNi2Mode> kModes = {{320, 240, 30, "RGB888"}, {640, 480, 30, "YUV422"},
                                         {640, 480, 60, "RGB888"}, {640, 480, 30, "RGB888"},
                                         {640, 480, 30, "1 mm"},   {640, 480, 30, "0.1 mm"},
                                         {640, 480, 30, "JPEG"}};

std::optional<std::size_t> Choose(StreamKind kind, int width, int height, int fps) {
  return ChooseMode(kModes, kind, width, height, fps);
}

TEST(ChooseMode, TakesTheBestFormatAtTheRate) {
  EXPECT_EQ(Choose(StreamKind::kColor, 640, 480, 30), 3u);
  EXPECT_EQ(Choose(StreamKind::kColor, 640, 480, 60), 2u);
  EXPECT_EQ(Choose(StreamKind::kDepth, 640, 480, 30), 4u);
}

TEST(ChooseMode, TakesTheNearestRateWhereThatIsNotOffered) {
  EXPECT_EQ(Choose(StreamKind::kColor, 640, 480, 50), 2u);
  EXPECT_EQ(Choose(StreamKind::kDepth, 640, 480, 60), 4u);
}

TEST(ChooseMode, TakesNoOtherSize) {
  EXPECT_FALSE(Choose(StreamKind::kColor, 1280, 1024, 30));
  EXPECT_FALSE(Choose(StreamKind::kDepth, 320, 240, 30));
}

TEST(ChooseMode, TakesNoFormatThatCannotBeConverted) {
  EXPECT_FALSE(ChooseMode({{640, 480, 30, "JPEG"}}, StreamKind::kColor, 640, 480, 30));
  EXPECT_FALSE(ChooseMode({{640, 480, 30, "1 mm"}}, StreamKind::kColor, 640, 480, 30));
}

TEST(ChooseMode, TakesAnotherFormatWhereThereIsNoRgb) {
  EXPECT_EQ(ChooseMode({{640, 480, 30, "JPEG"}, {640, 480, 30, "YUV422"}}, StreamKind::kColor, 640,
                       480, 30),
            1u);
}

}  // namespace
}  // namespace semslam
