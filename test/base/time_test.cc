// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/time.h"

#include <limits>

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr TimeNs kSmallest = std::numeric_limits<TimeNs>::min();
constexpr TimeNs kLargest = std::numeric_limits<TimeNs>::max();

TEST(ParseTime, KeepsEveryDigitOfATimestamp) {
  EXPECT_EQ(ParseTime("1305031102.175304"), 1305031102175304000);
  EXPECT_EQ(ParseTime("1305031102.175304001"), 1305031102175304001);
}

TEST(ParseTime, TakesWholeSecondsAndNegativeTimes) {
  EXPECT_EQ(ParseTime("0"), 0);
  EXPECT_EQ(ParseTime("12"), 12 * kNsPerSecond);
  EXPECT_EQ(ParseTime("-0.5"), -kNsPerSecond / 2);
}

TEST(ParseTime, CutsWhatIsFinerThanNanoseconds) { EXPECT_EQ(ParseTime("0.0000000019"), 1); }

TEST(ParseTime, RejectsWhatIsNotAPlainDecimalNumber) {
  for (const char* text : {"", "-", ".", ".5", "1e9", "1.2.3", "1,5", " 1", "1 ", "1.5s", "--1",
                           "+1", "1.-5", "nan", "inf", "0x10", "1.5\n"}) {
    EXPECT_EQ(ParseTime(text), std::nullopt) << '"' << text << '"';
  }
}

TEST(ParseTime, RejectsTimesThatDoNotFit) {
  EXPECT_EQ(ParseTime("9223372036.854775807"), kLargest);
  EXPECT_EQ(ParseTime("9223372036.854775808"), std::nullopt);
  EXPECT_EQ(ParseTime("99999999999"), std::nullopt);
}

TEST(FormatTime, WritesAsManyDecimalsAsAsked) {
  EXPECT_EQ(FormatTime(1305031102175304000), "1305031102.175304");
  EXPECT_EQ(FormatTime(1'000'000'001, 9), "1.000000001");
  EXPECT_EQ(FormatTime(1'000'000'001, 3), "1.000");
  EXPECT_EQ(FormatTime(1'000'000'001, 0), "1");
}

TEST(FormatTime, RoundsToTheNearestAndCarries) {
  EXPECT_EQ(FormatTime(1'999'999'500), "2.000000");
  EXPECT_EQ(FormatTime(1'999'999'499), "1.999999");
  EXPECT_EQ(FormatTime(-1'500'000'000, 0), "-2");
}

TEST(FormatTime, WritesNoMinusBeforeZero) { EXPECT_EQ(FormatTime(-1), "0.000000"); }

TEST(FormatTime, SurvivesTheExtremes) {
  EXPECT_EQ(FormatTime(kLargest, 9), "9223372036.854775807");
  EXPECT_EQ(FormatTime(kSmallest, 9), "-9223372036.854775808");
}

TEST(FormatTime, IsUndoneByParseTime) {
  for (const TimeNs time : {TimeNs{0}, TimeNs{-1}, TimeNs{123456789}, kLargest, -kLargest}) {
    EXPECT_EQ(ParseTime(FormatTime(time, 9)), time);
  }
}

TEST(Seconds, ConvertBothWays) {
  EXPECT_EQ(FromSeconds(0.02), 20'000'000);
  EXPECT_EQ(FromSeconds(-1.5), -1'500'000'000);
  EXPECT_DOUBLE_EQ(ToSeconds(1'500'000'000), 1.5);
}

}  // namespace
}  // namespace semslam
