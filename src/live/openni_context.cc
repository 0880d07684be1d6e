// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/openni_context.h"

#include <OpenNI.h>

#include "semslam/base/error.h"

namespace semslam {

OpenNiContext::OpenNiContext() {
  if (openni::OpenNI::initialize() == openni::STATUS_OK) return;
  const std::string reason = OpenNiReason();
  openni::OpenNI::shutdown();
  throw InputError("OpenNI2 cannot start: " + reason +
                   " (expected its drivers in OpenNI2/Drivers beside libOpenNI2.so.0)");
}

OpenNiContext::~OpenNiContext() { openni::OpenNI::shutdown(); }

std::string OpenNiReason() {
  std::string line;
  for (const char c : std::string(openni::OpenNI::getExtendedError())) {
    const bool is_break = c == '\n' || c == '\r' || c == '\t';
    if (!is_break) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line.empty() ? "it gives no reason" : line;
}

}  // namespace semslam
