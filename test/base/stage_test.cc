// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/stage.h"

#include <latch>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semslam {
namespace {

using testing::ElementsAre;

constexpr auto kInline = Threading::kInline;
constexpr auto kWorkers = Threading::kWorkers;

void IgnoreInput(int /*input*/) {}

class StageInBothModes : public testing::TestWithParam<Threading> {};
INSTANTIATE_TEST_SUITE_P(Threading,
                         StageInBothModes,
                         testing::Values(kInline, kWorkers),
                         [](const auto& tested) {
                           return tested.param == kInline ? "Inline" : "Workers";
                         });

TEST_P(StageInBothModes, HandlesEveryInputInOrder) {
  std::vector<int> handled;
  Stage<int> stage({.threading = GetParam(), .queue_capacity = 2},
                   [&](int input) { handled.push_back(input); });
  for (const int input : {1, 2, 3, 4, 5}) EXPECT_TRUE(stage.Submit(input));
  stage.Finish();
  EXPECT_THAT(handled, ElementsAre(1, 2, 3, 4, 5));
}

TEST_P(StageInBothModes, RefusesInputAfterFinish) {
  Stage<int> stage({.threading = GetParam()}, IgnoreInput);
  stage.Finish();
  EXPECT_FALSE(stage.Submit(1));
  EXPECT_FALSE(stage.TrySubmit(1));
}

TEST_P(StageInBothModes, RefusesInputAfterCancel) {
  Stage<int> stage({.threading = GetParam()}, IgnoreInput);
  stage.Cancel();
  EXPECT_FALSE(stage.Submit(1));
}

TEST_P(StageInBothModes, MayBeFinishedAndCancelledMoreThanOnce) {
  Stage<int> stage({.threading = GetParam()}, IgnoreInput);
  stage.Finish();
  stage.Finish();
  stage.Cancel();
  EXPECT_TRUE(stage.idle());
}

TEST(Stage, RunsInTheCallersThreadIfInline) {
  std::thread::id thread;
  Stage<int> stage({.threading = kInline}, [&](int) { thread = std::this_thread::get_id(); });
  stage.Submit(1);
  EXPECT_EQ(thread, std::this_thread::get_id());
}

TEST(Stage, RunsInAThreadOfItsOwnWithWorkers) {
  std::thread::id thread;
  Stage<int> stage({.threading = kWorkers}, [&](int) { thread = std::this_thread::get_id(); });
  stage.Submit(1);
  stage.Finish();
  EXPECT_NE(thread, std::thread::id());
  EXPECT_NE(thread, std::this_thread::get_id());
}

TEST(Stage, ThrowsStraightOutOfSubmitIfInlineAndThenRefuses) {
  Stage<int> stage({.threading = kInline}, [](int) { throw std::runtime_error("broken"); });
  EXPECT_THROW(stage.Submit(1), std::runtime_error);
  EXPECT_TRUE(stage.failed());
  EXPECT_FALSE(stage.Submit(2));
  EXPECT_NO_THROW(stage.Finish());
}

TEST(Stage, RethrowsTheWorkersExceptionFromFinishOnce) {
  Stage<int> stage({.threading = kWorkers}, [](int) { throw std::runtime_error("broken"); });
  stage.Submit(1);
  EXPECT_THROW(stage.Finish(), std::runtime_error);
  EXPECT_TRUE(stage.failed());
  EXPECT_NO_THROW(stage.Finish());
}

TEST(Stage, DropsWhatIsQueuedAfterAnException) {
  std::latch queued(1);
  std::vector<int> handled;
  Stage<int> stage({.threading = kWorkers}, [&](int input) {
    queued.wait();
    handled.push_back(input);
    throw std::runtime_error("broken");
  });
  for (const int input : {1, 2, 3}) stage.Submit(input);
  queued.count_down();
  EXPECT_THROW(stage.Finish(), std::runtime_error);
  EXPECT_THAT(handled, ElementsAre(1));
  EXPECT_TRUE(stage.idle());
  EXPECT_FALSE(stage.Submit(4));
}

TEST(Stage, AFailureFreesASubmitThatWaitsForRoom) {
  std::latch go(1);
  Stage<int> stage({.threading = kWorkers, .queue_capacity = 1}, [&](int) {
    go.wait();
    throw std::runtime_error("broken");
  });
  stage.Submit(1);
  std::jthread producer([&] {
    while (stage.Submit(2)) {
    }
  });
  go.count_down();
  producer.join();
  EXPECT_THROW(stage.Finish(), std::runtime_error);
  EXPECT_TRUE(stage.idle());
}

TEST(Stage, CancelEndsAfterTheInputInHandAndDropsTheRest) {
  std::latch in_hand(1);
  std::latch go(1);
  std::vector<int> handled;
  Stage<int> stage({.threading = kWorkers}, [&](int input) {
    in_hand.count_down();
    go.wait();
    handled.push_back(input);
  });
  for (const int input : {1, 2, 3}) stage.Submit(input);
  in_hand.wait();
  std::jthread canceller([&] { stage.Cancel(); });
  while (stage.Submit(4)) {  // Until the cancellation has been seen.
  }
  go.count_down();
  canceller.join();
  EXPECT_THAT(handled, ElementsAre(1));
  EXPECT_TRUE(stage.idle());
}

TEST(Stage, IsCancelledByItsDestructorEvenWithAnErrorPending) {
  std::latch reached(1);
  {
    Stage<int> stage({.threading = kWorkers}, [&](int) {
      reached.count_down();
      throw std::runtime_error("broken");
    });
    stage.Submit(1);
    reached.wait();
  }
  EXPECT_TRUE(reached.try_wait());
}

TEST(Stage, IsIdleOnlyWhenNothingIsQueuedOrInHand) {
  std::latch in_hand(1);
  std::latch go(1);
  Stage<int> stage({.threading = kWorkers}, [&](int) {
    in_hand.count_down();
    go.wait();
  });
  EXPECT_TRUE(stage.idle());
  stage.Submit(1);
  EXPECT_FALSE(stage.idle());
  in_hand.wait();
  EXPECT_EQ(stage.queue_size(), 0u);
  EXPECT_FALSE(stage.idle());
  go.count_down();
  stage.Finish();
  EXPECT_TRUE(stage.idle());
}

TEST(Stage, TrySubmitRefusesWhenTheQueueIsFull) {
  std::latch in_hand(1);
  std::latch go(1);
  Stage<int> stage({.threading = kWorkers, .queue_capacity = 1}, [&](int input) {
    if (input == 1) in_hand.count_down();
    go.wait();
  });
  EXPECT_TRUE(stage.TrySubmit(1));
  in_hand.wait();
  EXPECT_TRUE(stage.TrySubmit(2));
  EXPECT_FALSE(stage.TrySubmit(3));
  go.count_down();
  stage.Finish();
}

TEST(Stage, TakesTheNewestInputFirstIfAsked) {
  std::latch in_hand(1);
  std::latch go(1);
  std::vector<int> handled;
  Stage<int> stage({.threading = kWorkers, .order = QueueOrder::kNewestFirst}, [&](int input) {
    if (input == 1) in_hand.count_down();
    go.wait();
    handled.push_back(input);
  });
  stage.Submit(1);
  in_hand.wait();
  for (const int input : {2, 3, 4}) stage.Submit(input);
  go.count_down();
  stage.Finish();
  EXPECT_THAT(handled, ElementsAre(1, 4, 3, 2));
}

// Submitters that race with a failure must leave the count of unfinished inputs at zero.
TEST(Stage, TheFunctionMayTakeWhatWaitsAlong) {
  std::latch reached(1);
  std::latch queued(1);
  std::vector<std::vector<int>> batches;
  Stage<int>* self = nullptr;
  Stage<int> stage({.threading = kWorkers}, [&](int input) {
    reached.count_down(batches.empty() ? 1 : 0);
    queued.wait();
    batches.push_back({input});
    while (const std::optional<int> next = self->TryTakeNext()) batches.back().push_back(*next);
  });
  self = &stage;
  stage.Submit(1);
  reached.wait();
  for (const int input : {2, 3}) stage.Submit(input);
  EXPECT_FALSE(stage.idle());
  queued.count_down();
  while (!stage.idle()) std::this_thread::yield();
  stage.Finish();
  EXPECT_THAT(batches, ElementsAre(ElementsAre(1, 2, 3)));
}

TEST(Stage, IsIdleAfterManySubmittersRacedWithAFailure) {
  for (int round = 0; round < 100; ++round) {
    Stage<int> stage({.threading = kWorkers, .queue_capacity = 2}, [](int input) {
      if (input == 5) throw std::runtime_error("broken");
    });
    {
      std::vector<std::jthread> submitters;
      for (int i = 0; i < 3; ++i) {
        submitters.emplace_back([&] {
          for (int input = 0; stage.Submit(input); ++input) {
          }
        });
      }
    }
    EXPECT_THROW(stage.Finish(), std::runtime_error);
    ASSERT_TRUE(stage.idle());
  }
}

}  // namespace
}  // namespace semslam
