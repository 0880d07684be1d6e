// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/device_clock.h"

#include <gtest/gtest.h>

namespace semslam {
namespace {

constexpr TimeNs kNow = 1'795'000'000 * kNsPerSecond;

TEST(DeviceClock, TheFirstFrameHasTheSystemsTimeAndOthersTheCamerasDistance) {
  DeviceClock clock;
  EXPECT_EQ(clock.Convert(5'000'000, kNow), kNow);
  // The system was busy and saw it late.
  EXPECT_EQ(clock.Convert(5'033'333, kNow + 90'000'000), kNow + 33'333'000);
}

TEST(DeviceClock, AfterARestartTheSystemsTimeIsTakenAgain) {
  DeviceClock clock;
  clock.Convert(5'000'000, kNow);
  clock.Restart();
  EXPECT_EQ(clock.Convert(100, kNow + 400'000'000), kNow + 400'000'000);
}

TEST(DeviceClock, ACamerasClockThatJumpsIsSetAgain) {
  DeviceClock clock;
  clock.Convert(5'000'000, kNow);
  EXPECT_EQ(clock.Convert(33'333, kNow + 33'000'000), kNow + 33'000'000);
  EXPECT_EQ(clock.Convert(900'000'000, kNow + 66'000'000), kNow + 66'000'000);
}

TEST(DeviceClock, TimesAlwaysIncrease) {
  DeviceClock clock;
  const TimeNs first = clock.Convert(5'000'000, kNow);
  const TimeNs repeated = clock.Convert(5'000'000, kNow);
  EXPECT_GT(repeated, first);
  clock.Restart();
  EXPECT_GT(clock.Convert(0, kNow - kNsPerSecond), repeated);  // The system's clock was set back.
}

TEST(DeviceClock, ADriftingClockNeverIsASecondWrong) {
  DeviceClock clock;
  constexpr double kDrift = 1e-3;
  TimeNs last = 0;
  for (int i = 1; i < 200'000; i += 7) {
    const TimeNs now = kNow + static_cast<TimeNs>(i) * 33'333'000;
    const TimeNs time = clock.Convert(static_cast<std::int64_t>(33'333.0 * i * (1 + kDrift)), now);
    ASSERT_LT(std::abs(ToSeconds(time - now)), 1.001);
    ASSERT_GT(time, last);
    last = time;
  }
}

}  // namespace
}  // namespace semslam
