// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/stream_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semslam {
namespace {

using ::testing::HasSubstr;

// Images every 33 ms up to these times, pairs as long as both come; then the verdict at `now`.
std::string VerdictAt(double now, double last_color, double last_depth) {
  StreamWatch watch(1.0, 3.0);
  watch.Start(100);
  for (double time = 0; time <= now; time += 0.033) {
    if (time <= last_color) watch.OnImage(StreamKind::kColor, 100 + time);
    if (time <= last_depth) watch.OnImage(StreamKind::kDepth, 100 + time);
    if (time <= last_color && time <= last_depth) watch.OnPair(100 + time);
  }
  return watch.Check(100 + now).value_or("");
}

TEST(StreamWatch, SaysNothingWhileImagesCome) { EXPECT_EQ(VerdictAt(10, 10, 10), ""); }

TEST(StreamWatch, GivesACameraTimeToStart) {
  EXPECT_EQ(VerdictAt(2.9, -1, -1), "");
  EXPECT_THAT(VerdictAt(3.1, -1, -1), HasSubstr("no images for 3.1 s"));
}

TEST(StreamWatch, NoticesAStallAfterASecond) {
  EXPECT_EQ(VerdictAt(5.9, 5, 5), "");
  EXPECT_THAT(VerdictAt(6.1, 5, 5), HasSubstr("no images for 1.1 s"));
}

TEST(StreamWatch, TellsWhichStreamIsMissing) {
  EXPECT_THAT(VerdictAt(6.1, 5, 10), HasSubstr("no colour images for 1.1 s, depth images still"));
  EXPECT_THAT(VerdictAt(6.1, 10, 5), HasSubstr("no depth images for 1.1 s, colour images still"));
}

TEST(StreamWatch, OneStreamAloneMayStartLater) {
  EXPECT_EQ(VerdictAt(2.9, -1, 10), "");
  EXPECT_THAT(VerdictAt(3.1, -1, 10), HasSubstr("no colour images"));
}

// The last pair may be a frame older than the last image of the stream that stopped.
TEST(StreamWatch, OneStreamThatStopsIsNotTakenForImagesThatDoNotFit) {
  StreamWatch watch(1.0, 3.0);
  watch.Start(0);
  watch.OnPair(5);
  watch.OnImage(StreamKind::kColor, 5.033);
  watch.OnImage(StreamKind::kDepth, 6.02);
  EXPECT_FALSE(watch.Check(6.02));
}

TEST(StreamWatch, NoticesImagesThatNeverBelongTogether) {
  StreamWatch watch(1.0, 3.0);
  watch.Start(0);
  for (double time = 0; time <= 3.1; time += 0.033) {
    watch.OnImage(StreamKind::kColor, time);
    watch.OnImage(StreamKind::kDepth, time);
  }
  EXPECT_THAT(watch.Check(3.1).value_or(""), HasSubstr("none that belong together"));
}

}  // namespace
}  // namespace semslam
