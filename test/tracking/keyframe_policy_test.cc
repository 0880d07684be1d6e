// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "semslam/tracking/keyframe_policy.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace semslam {
namespace {

using Situation = KeyframePolicy::Situation;

struct Case {
  std::string name;
  Situation situation;
  bool wants;
};
void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

// 200 landmarks in the reference, an idle mapper, plenty of keyframes and close points.
Situation Usual(int num_inliers) {
  return {.num_frames_since_keyframe = 5,
          .num_inliers = num_inliers,
          .num_reference_landmarks = 200,
          .num_keyframes = 10,
          .num_close_tracked = 150,
          .num_close_untracked = 50,
          .mapper = {.is_idle = true, .num_queued = 0}};
}
Situation With(Situation situation, void (*change)(Situation&)) {
  change(situation);
  return situation;
}
Situation Busy(Situation situation, int num_queued) {
  situation.mapper = {.is_idle = false, .num_queued = num_queued};
  return situation;
}

class KeyframePolicyTest : public ::testing::TestWithParam<Case> {};

TEST_P(KeyframePolicyTest, DecidesAsDescribed) {
  EXPECT_EQ(KeyframePolicy({}).WantsKeyframe(GetParam().situation), GetParam().wants);
}

const auto kFewClose = [](Situation& s) { s.num_close_tracked = 99, s.num_close_untracked = 71; };

INSTANTIATE_TEST_SUITE_P(
    Cases,
    KeyframePolicyTest,
    ::testing::Values(
        Case{"the_view_is_as_it_was", Usual(150), false},
        Case{"the_view_has_changed", Usual(149), true},
        Case{"the_view_has_changed_and_the_mapper_is_busy", Busy(Usual(149), 0), false},
        Case{"it_is_time_but_nothing_has_changed",
             With(Usual(150), [](Situation& s) { s.num_frames_since_keyframe = 100; }), false},
        Case{"it_is_time_and_the_mapper_is_busy",
             Busy(With(Usual(149), [](Situation& s) { s.num_frames_since_keyframe = 30; }), 0),
             true},
        Case{"it_is_nearly_time_and_the_mapper_is_busy",
             Busy(With(Usual(149), [](Situation& s) { s.num_frames_since_keyframe = 29; }), 0),
             false},
        Case{"tracking_is_weak_and_the_mapper_is_busy", Busy(Usual(49), 2), true},
        Case{"tracking_is_not_quite_weak_and_the_mapper_is_busy", Busy(Usual(50), 0), false},
        Case{"tracking_is_weak_and_too_many_wait", Busy(Usual(49), 3), false},
        Case{"a_fifth_of_the_picture_is_new",
             With(Usual(190), [](Situation& s) { s.new_share = 0.21; }), true},
        Case{"little_of_the_picture_is_new",
             With(Usual(190), [](Situation& s) { s.new_share = 0.19; }), false},
        Case{"much_of_the_picture_is_new_but_the_mapper_is_busy",
             Busy(With(Usual(190), [](Situation& s) { s.new_share = 0.5; }), 0), false},
        Case{"too_few_inliers", Usual(15), false},
        Case{"just_enough_inliers", Usual(16), true},
        Case{"close_points_are_missing", With(Usual(180), kFewClose), true},
        Case{"close_points_are_missing_and_the_mapper_is_busy",
             Busy(With(Usual(180), kFewClose), 2), true},
        Case{"enough_close_points_are_tracked",
             With(Usual(180),
                  [](Situation& s) {
                    s.num_close_tracked = 100;
                    s.num_close_untracked = 500;
                  }),
             false},
        Case{"there_are_no_close_points_to_add",
             With(Usual(180),
                  [](Situation& s) {
                    s.num_close_tracked = 10;
                    s.num_close_untracked = 70;
                  }),
             false},
        Case{"one_keyframe_and_half_of_it_seen",
             With(Usual(100), [](Situation& s) { s.num_keyframes = 1; }), false},
        Case{"one_keyframe_and_a_third_of_it_seen",
             With(Usual(70), [](Situation& s) { s.num_keyframes = 1; }), true},
        Case{"the_reference_has_no_landmarks",
             With(Usual(40), [](Situation& s) { s.num_reference_landmarks = 0; }), false}),
    [](const auto& test) { return test.param.name; });

TEST(KeyframePolicyOptionsTest, RefusesWhatMakesNoSense) {
  EXPECT_THROW(KeyframePolicy({.max_frames_between = 0}), std::logic_error);
  EXPECT_THROW(KeyframePolicy({.max_queued = 0}), std::logic_error);
  EXPECT_THROW(KeyframePolicy({.weak_ratio = 0.8, .changed_ratio = 0.7}), std::logic_error);
  EXPECT_THROW(KeyframePolicy({.changed_ratio = 1.1}), std::logic_error);
}

}  // namespace
}  // namespace semslam
