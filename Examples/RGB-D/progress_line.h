// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>

#include "semslam/base/stopwatch.h"

// What the program is doing, on standard error. A terminal shows one line that is written over and
// vanishes at the end; a file or pipe gets a line every few seconds. For one thread.
class ProgressLine {
 public:
  // `program` begins the lines that stay.
  explicit ProgressLine(std::string program);
  ~ProgressLine() { Clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Enough time has passed since the last update; ask before making a text.
  bool is_due() const;
  void Update(const std::string& text);
  // At once, on a terminal only: for what follows and takes a while.
  void ShowStep(const std::string& text);
  // A line that stays, above the progress.
  void Report(const std::string& message);
  void Clear();

 private:
  void Overwrite(const std::string& text);

  const std::string program_;
  bool is_terminal_;
  bool is_shown_ = false;
  semslam::Stopwatch since_update_;
};
