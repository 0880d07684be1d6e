// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live/openni_context.h"

#include <algorithm>
#include <cctype>

#include <OpenNI.h>
#include <pthread.h>

#include "semslam/base/error.h"

namespace semslam {
namespace {

bool Contains(const std::string& text, const std::string& part) {
  const auto same = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

// Of threads that are started from now on. Returns the size before, in bytes, or 0 if that fails.
std::size_t SetStackSize(std::size_t size) {
  pthread_attr_t attributes;
  if (::pthread_getattr_default_np(&attributes) != 0) return 0;
  std::size_t size_before = 0;
  const bool is_set = ::pthread_attr_getstacksize(&attributes, &size_before) == 0 &&
                      ::pthread_attr_setstacksize(&attributes, size) == 0 &&
                      ::pthread_setattr_default_np(&attributes) == 0;
  ::pthread_attr_destroy(&attributes);
  return is_set ? size_before : 0;
}

}  // namespace

SmallStacks::SmallStacks() {
  constexpr std::size_t kSmall = 1 << 20;  // Bytes; the system keeps 40 MB.
  usual_size_ = SetStackSize(kSmall);
}

SmallStacks::~SmallStacks() {
  if (usual_size_ > 0) SetStackSize(usual_size_);
}

OpenNiContext::OpenNiContext() {
  const SmallStacks small_stacks;
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

std::string AdviceFor(const std::string& reason) {
  if (Contains(reason, "busy") || Contains(reason, "in use") || Contains(reason, "exclusive"))
    return "another program has it: end that one first";
  if (Contains(reason, "permission") || Contains(reason, "denied") || Contains(reason, "access")) {
    return "you may not use it: a udev rule gives the right (package libopenni2-0 brings one), "
           "then plug the camera in again";
  }
  return "another program may have it, or you may lack the right to use it (udev rule); plugging "
         "it in again often helps";
}

}  // namespace semslam
