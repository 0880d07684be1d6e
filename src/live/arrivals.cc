// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/arrivals.h"

#include <OpenNI.h>

namespace semslam {

void Arrivals::OnImage(void* arrivals) {
  static_cast<Arrivals*>(arrivals)->since_last_.Write([](Stopwatch& watch) { watch.Restart(); });
}

// By OpenNI2's C interface: the listener of the C++ one calls the library in its thread, and the
// library must not be called in threads that end (openni2_source.h).
void Arrivals::Attach(openni::VideoStream& stream) {
  const auto on_image = [](OniStreamHandle /*stream*/, void* cookie) { OnImage(cookie); };
  OniCallbackHandle handle = nullptr;
  if (oniStreamRegisterNewFrameCallback(stream._getHandle(), on_image, this, &handle) !=
      ONI_STATUS_OK)
    return;
  stream_ = &stream;
  callback_ = handle;
}

void Arrivals::Detach() {
  if (callback_ == nullptr) return;
  oniStreamUnregisterNewFrameCallback(stream_->_getHandle(),
                                      static_cast<OniCallbackHandle>(callback_));
  callback_ = nullptr;
}

}  // namespace semslam
