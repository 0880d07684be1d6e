// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace semslam {

// OpenNI2 is there while one of these is. Throws InputError if it cannot be.
class OpenNiContext {
 public:
  OpenNiContext();
  OpenNiContext(const OpenNiContext&) = delete;
  OpenNiContext& operator=(const OpenNiContext&) = delete;
  ~OpenNiContext();
};

// While one of these is there, threads that OpenNI2 starts have small stacks. The library
// (2.2.0.33) remembers the threads that called it, and at the first call in another one asks the
// system about all of them: which crashes where one has ended and its memory was given back. Small
// stacks are kept for the threads to come, big ones are not.
class SmallStacks {
 public:
  SmallStacks();
  SmallStacks(const SmallStacks&) = delete;
  SmallStacks& operator=(const SmallStacks&) = delete;
  ~SmallStacks();

 private:
  std::size_t usual_size_ = 0;  // Bytes; 0: it is not known.
};

// What OpenNI2 says about the last failure in this thread, in one line; often nothing.
std::string OpenNiReason();

// The next step for one whose camera is there but cannot be opened, for that reason.
std::string AdviceFor(const std::string& reason);

}  // namespace semslam
