// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>

namespace semslam {

enum class QueueOrder { kOldestFirst, kNewestFirst };

// Hands values from producers to consumers. Safe for any number of both.
template <typename T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t capacity, QueueOrder order = QueueOrder::kOldestFirst)
      : capacity_(capacity), order_(order) {}

  // Waits for room. False, and the item is dropped, once the queue is closed or `stop` is
  // requested.
  bool Push(T item, std::stop_token stop = {}) {
    std::unique_lock lock(mutex_);
    // The predicate's value is what wait returns, also after a stop: so the stop is tested as well.
    has_room_.wait(lock, stop, [this] { return closed_ || items_.size() < capacity_; });
    if (closed_ || stop.stop_requested()) {
      has_room_.notify_one();  // In case this thread's wake-up was meant for another producer.
      return false;
    }
    items_.push_back(std::move(item));
    lock.unlock();
    has_items_.notify_one();
    return true;
  }

  // Never waits; false, and the item is dropped, if the queue is full or closed.
  bool TryPush(T item) {
    {
      const std::lock_guard lock(mutex_);
      if (closed_ || items_.size() >= capacity_) return false;
      items_.push_back(std::move(item));
    }
    has_items_.notify_one();
    return true;
  }

  // Waits for an item. Nothing once the queue is closed and drained, or `stop` is requested.
  std::optional<T> Pop(std::stop_token stop = {}) {
    std::unique_lock lock(mutex_);
    has_items_.wait(lock, stop, [this] { return closed_ || !items_.empty(); });
    if (items_.empty() || stop.stop_requested()) {
      has_items_.notify_one();  // In case this thread's wake-up was meant for another consumer.
      return std::nullopt;
    }
    std::optional<T> item = TakeNext();
    lock.unlock();
    has_room_.notify_one();
    return item;
  }

  // The same, but never waits: nothing if the queue is empty.
  std::optional<T> TryPop() {
    std::optional<T> item;
    {
      const std::lock_guard lock(mutex_);
      if (items_.empty()) return std::nullopt;
      item = TakeNext();
    }
    has_room_.notify_one();
    return item;
  }

  // No further items; those already queued can still be popped.
  void Close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    has_items_.notify_all();
    has_room_.notify_all();
  }

  // Drops what is queued. Returns how many items that were.
  std::size_t Clear() {
    std::deque<T> dropped;
    {
      const std::lock_guard lock(mutex_);
      dropped.swap(items_);
    }
    has_room_.notify_all();
    return dropped.size();
  }

  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }

 private:
  // With the mutex locked and items there.
  T TakeNext() {
    const bool is_oldest = order_ == QueueOrder::kOldestFirst;
    T item = std::move(is_oldest ? items_.front() : items_.back());
    is_oldest ? items_.pop_front() : items_.pop_back();
    return item;
  }

  const std::size_t capacity_;
  const QueueOrder order_;
  mutable std::mutex mutex_;
  std::condition_variable_any has_items_;
  std::condition_variable_any has_room_;
  std::deque<T> items_;
  bool closed_ = false;
};

}  // namespace semslam
