// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include "semslam/base/bounded_queue.h"
#include "semslam/base/thread_priority.h"

namespace semslam {

// kInline runs every stage in the caller's thread at once: same input, same bytes out. kWorkers
// gives each its thread.
enum class Threading { kInline, kWorkers };

// Runs one function on the inputs submitted to it. Submit may be called from any thread; Finish and
// Cancel from one.
template <typename Input>
class Stage {
 public:
  struct Options {
    Threading threading = Threading::kWorkers;
    std::size_t queue_capacity = 16;
    QueueOrder order = QueueOrder::kOldestFirst;
    bool is_background = false;  // Its thread yields to others when cores are scarce.
  };

  Stage(Options options, std::function<void(Input)> process)
      : process_(std::move(process)), queue_(options.queue_capacity, options.order) {
    if (options.threading == Threading::kWorkers) {
      worker_.emplace([this, options](std::stop_token stop) {
        if (options.is_background) YieldToOtherThreads();
        Run(stop);
      });
    }
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage() { Cancel(); }

  // kInline: processes it now, and an exception comes straight out. kWorkers: queues it, waits
  // while the queue is full. False, and the input is dropped, once the stage is finished, cancelled
  // or has failed.
  bool Submit(Input input) {
    if (!worker_) return ProcessInline(std::move(input));
    return Count(&BoundedQueue<Input>::Push, std::move(input), std::stop_token());
  }

  // The same, but false at once where Submit would wait.
  bool TrySubmit(Input input) {
    if (!worker_) return ProcessInline(std::move(input));
    return Count(&BoundedQueue<Input>::TryPush, std::move(input));
  }

  // For the function: takes the next input too, to be handled together with the one in hand. Never
  // waits; nothing if none is queued, and always with kInline.
  std::optional<Input> TryTakeNext() {
    std::optional<Input> input = queue_.TryPop();
    if (input) --num_unfinished_;  // The one in hand keeps the stage from being idle.
    return input;
  }

  // Handles all that was submitted, joins the thread and rethrows what the function threw, once.
  void Finish() {
    queue_.Close();
    Join();
    finished_ = true;
    if (const std::exception_ptr error = std::exchange(error_, nullptr)) {
      std::rethrow_exception(error);
    }
  }

  // Ends after the input in hand, drops the rest, joins. Never throws: an error of the function is
  // dropped too.
  void Cancel() noexcept {
    if (worker_) worker_->request_stop();
    queue_.Close();
    Join();
    finished_ = true;
  }

  std::size_t queue_size() const { return queue_.size(); }
  // Nothing queued and nothing in hand.
  bool idle() const { return num_unfinished_.load() == 0; }
  bool failed() const { return failed_.load(); }

 private:
  // Counts an input as unfinished from before it is queued, so that idle() never sees it in neither
  // place.
  template <typename... Args>
  bool Count(bool (BoundedQueue<Input>::*push)(Args...), Args... args) {
    ++num_unfinished_;
    const bool pushed = (queue_.*push)(std::move(args)...);
    if (!pushed) --num_unfinished_;
    return pushed;
  }

  bool ProcessInline(Input input) {
    if (finished_ || failed()) return false;
    try {
      process_(std::move(input));
    } catch (...) {
      failed_.store(true);
      throw;
    }
    return true;
  }

  void Run(const std::stop_token& stop) {
    try {
      while (std::optional<Input> input = queue_.Pop(stop)) {
        process_(*std::move(input));
        --num_unfinished_;
      }
    } catch (...) {  // Carried to the caller of Finish.
      error_ = std::current_exception();
      failed_.store(true);
      --num_unfinished_;
    }
    queue_.Close();
    // Not set to 0: a Submit that is being refused now takes its own count back.
    num_unfinished_ -= static_cast<int>(queue_.Clear());
  }

  void Join() noexcept {
    if (worker_ && worker_->joinable()) worker_->join();
  }

  std::function<void(Input)> process_;
  BoundedQueue<Input> queue_;
  std::atomic<int> num_unfinished_ = 0;
  std::atomic<bool> failed_ = false;
  bool finished_ = false;
  std::exception_ptr error_;  // Written by the worker before it ends, read after the join.
  std::optional<std::jthread> worker_;  // Last: joined before anything it uses is destroyed.
};

}  // namespace semslam
