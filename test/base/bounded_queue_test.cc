// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/base/bounded_queue.h"

#include <atomic>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace semslam {
namespace {

TEST(BoundedQueue, GivesTheOldestFirst) {
  BoundedQueue<int> queue(3);
  for (const int item : {1, 2, 3}) queue.Push(item);
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), 2);
  EXPECT_EQ(queue.Pop(), 3);
}

TEST(BoundedQueue, GivesTheNewestFirstIfAsked) {
  BoundedQueue<int> queue(3, QueueOrder::kNewestFirst);
  for (const int item : {1, 2, 3}) queue.Push(item);
  EXPECT_EQ(queue.Pop(), 3);
  queue.Push(4);
  EXPECT_EQ(queue.Pop(), 4);
  EXPECT_EQ(queue.Pop(), 2);
}

TEST(BoundedQueue, TryPopTakesWhatPopWouldAndNeverWaits) {
  BoundedQueue<int> queue(3, QueueOrder::kNewestFirst);
  EXPECT_EQ(queue.TryPop(), std::nullopt);
  for (const int item : {1, 2, 3}) queue.Push(item);
  EXPECT_EQ(queue.TryPop(), 3);
  EXPECT_TRUE(queue.TryPush(4)) << "there is room again";
  queue.Close();
  EXPECT_EQ(queue.TryPop(), 4);
}

TEST(BoundedQueue, HoldsItemsThatCanOnlyBeMoved) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  queue.Push(std::make_unique<int>(5));
  EXPECT_EQ(**queue.Pop(), 5);
}

TEST(BoundedQueue, RefusesTryPushWhenFull) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.TryPush(1));
  EXPECT_TRUE(queue.TryPush(2));
  EXPECT_FALSE(queue.TryPush(3));
  EXPECT_EQ(queue.size(), 2u);
}

TEST(BoundedQueue, DrainsAfterCloseThenGivesNothing) {
  BoundedQueue<int> queue(2);
  queue.Push(1);
  queue.Close();
  EXPECT_FALSE(queue.Push(2));
  EXPECT_FALSE(queue.TryPush(2));
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), std::nullopt);
}

TEST(BoundedQueue, GivesNothingAfterAStopEvenWithItemsQueued) {
  BoundedQueue<int> queue(2);
  queue.Push(1);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(queue.Pop(stop.get_token()), std::nullopt);
  EXPECT_FALSE(queue.Push(2, stop.get_token()));
  EXPECT_EQ(queue.size(), 1u);
}

TEST(BoundedQueue, ClearSaysHowManyItemsItDropped) {
  BoundedQueue<int> queue(3);
  queue.Push(1);
  queue.Push(2);
  EXPECT_EQ(queue.Clear(), 2u);
  EXPECT_EQ(queue.size(), 0u);
}

TEST(BoundedQueue, PushWaitsUntilThereIsRoom) {
  BoundedQueue<int> queue(1);
  queue.Push(1);
  std::atomic<bool> pushed = false;
  std::jthread producer([&] {
    queue.Push(2);
    pushed = true;
  });
  EXPECT_FALSE(pushed.load());
  EXPECT_EQ(queue.Pop(), 1);
  EXPECT_EQ(queue.Pop(), 2);
  producer.join();
  EXPECT_TRUE(pushed.load());
}

TEST(BoundedQueue, CloseWakesWaitingProducersAndConsumers) {
  BoundedQueue<int> full(1);
  full.Push(1);
  BoundedQueue<int> empty(1);
  std::jthread producer([&] { EXPECT_FALSE(full.Push(2)); });
  std::jthread consumer([&] { EXPECT_EQ(empty.Pop(), std::nullopt); });
  full.Close();
  empty.Close();
}

TEST(BoundedQueue, StopWakesWaitingProducersAndConsumers) {
  BoundedQueue<int> full(1);
  full.Push(1);
  BoundedQueue<int> empty(1);
  std::jthread producer([&](const std::stop_token& stop) { EXPECT_FALSE(full.Push(2, stop)); });
  std::jthread consumer(
      [&](const std::stop_token& stop) { EXPECT_EQ(empty.Pop(stop), std::nullopt); });
  producer.request_stop();
  consumer.request_stop();
}

TEST(BoundedQueue, HandsEveryItemToExactlyOneConsumer) {
  constexpr int kNumProducers = 3;
  constexpr int kNumItems = 2000;  // Of each producer.
  BoundedQueue<int> queue(4);
  std::vector<std::vector<int>> received(3);
  {
    std::vector<std::jthread> consumers;
    for (std::vector<int>& own : received) {
      consumers.emplace_back([&queue, &own] {
        while (const std::optional<int> item = queue.Pop()) own.push_back(*item);
      });
    }
    {
      std::vector<std::jthread> producers;
      for (int p = 0; p < kNumProducers; ++p) {
        producers.emplace_back([&queue, p] {
          for (int i = 0; i < kNumItems; ++i) queue.Push(p * kNumItems + i);
        });
      }
    }
    queue.Close();
  }
  std::multiset<int> all;
  for (const std::vector<int>& own : received) all.insert(own.begin(), own.end());
  EXPECT_EQ(all.size(), static_cast<std::size_t>(kNumProducers * kNumItems));
  EXPECT_EQ(std::set<int>(all.begin(), all.end()).size(), all.size());
}

// A consumer that leaves because of a stop must not take another's wake-up with it.
TEST(BoundedQueue, DoesNotStrandAnItemWhenOneOfTwoConsumersStops) {
  for (int round = 0; round < 300; ++round) {
    BoundedQueue<int> queue(1);
    std::optional<int> kept;
    std::jthread leaving([&](const std::stop_token& stop) {
      if (const std::optional<int> item = queue.Pop(stop)) queue.Push(*item);
    });
    std::jthread staying([&] { kept = queue.Pop(); });
    queue.Push(1);
    leaving.request_stop();
    leaving.join();
    staying.join();
    ASSERT_EQ(kept, 1);
  }
}

}  // namespace
}  // namespace semslam
