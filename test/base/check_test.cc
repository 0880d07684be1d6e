// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/check.h"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string MessageOfFailedCheck(int value) {
  try {
    SEMSLAM_CHECK(value > 0) << "value = " << value;
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST(Check, SaysWhereWhatAndTheValues) {
  EXPECT_THAT(MessageOfFailedCheck(-3),
              AllOf(HasSubstr("check_test.cc:"), HasSubstr("value > 0"), HasSubstr("value = -3")));
}

TEST(Check, DoesNothingIfTheConditionHolds) { EXPECT_EQ(MessageOfFailedCheck(1), ""); }

TEST(Check, EvaluatesItsMessageOnlyOnFailure) {
  int num_evaluations = 0;
  SEMSLAM_CHECK(true) << ++num_evaluations;
  EXPECT_EQ(num_evaluations, 0);
}

}  // namespace
}  // namespace semslam
