// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "progress_line.h"

#include <cstddef>
#include <cstdio>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

#include "printable.h"

namespace {

constexpr double kTerminalInterval = 0.2;  // Seconds between updates.
constexpr double kFileInterval = 5.0;
constexpr const char* kEraseLine = "\r\033[K";

// A longer line would wrap, and then could not be written over.
std::size_t TerminalWidth() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsual;
  return size.ws_col;
}

}  // namespace

ProgressLine::ProgressLine(std::string program)
    : program_(std::move(program)), is_terminal_(isatty(STDERR_FILENO) != 0) {}

bool ProgressLine::is_due() const {
  return since_update_.Seconds() >= (is_terminal_ ? kTerminalInterval : kFileInterval);
}

void ProgressLine::Update(const std::string& text) {
  since_update_.Restart();
  if (is_terminal_) {
    Overwrite(text);
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
}

void ProgressLine::ShowStep(const std::string& text) {
  if (is_terminal_) Overwrite(text);
}

void ProgressLine::Report(const std::string& message) {
  Clear();
  std::fprintf(stderr, "%s: %s\n", program_.c_str(), Printable(message).c_str());
}

void ProgressLine::Clear() {
  if (is_shown_) std::fputs(kEraseLine, stderr);
  is_shown_ = false;
}

void ProgressLine::Overwrite(const std::string& text) {
  std::fprintf(stderr, "%s%s", kEraseLine, text.substr(0, TerminalWidth() - 1).c_str());
  is_shown_ = true;
}
