// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/base/guarded.h"
#include "semslam/base/stopwatch.h"

namespace openni {
class VideoStream;
}

namespace semslam {

// Notes when the newest image of a stream came, before it is read. The stream must be there as long
// as this.
class Arrivals {
 public:
  Arrivals() = default;
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;
  ~Arrivals() { Detach(); }

  void Attach(openni::VideoStream& stream);
  void Detach();

  double SecondsSinceLast() const {
    return since_last_.Read([](const Stopwatch& watch) { return watch.Seconds(); });
  }

 private:
  // Called in a thread of OpenNI2.
  static void OnImage(void* arrivals);

  Guarded<Stopwatch> since_last_;
  openni::VideoStream* stream_ = nullptr;
  void* callback_ = nullptr;
};

}  // namespace semslam
