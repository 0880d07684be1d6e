// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "semslam/config/settings.h"
#include "semslam/pipeline/system.h"

#include "keyframe_gallery.h"
#include "live_state.h"

// Whether this program was built with a viewer; if not, what to do about it.
std::optional<std::string> WhyNoViewer();

// A window that shows a run, in a thread of its own that leaves the processor to the run. The run
// does not depend on it: it may be closed at any time, and where there is no screen it says so.
class LiveView {
 public:
  struct Setup {
    std::shared_ptr<LiveState> state;
    semslam::System* system = nullptr;  // Must outlive this.
    semslam::Settings settings;
    semslam::ClassTable classes;  // Of the detector, if there is one.
    std::shared_ptr<KeyframeGallery> gallery;
    std::filesystem::path output;  // Saves go into a folder in it.
    std::string title;
  };

  explicit LiveView(const Setup& setup);
  // Closes the window.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

  bool is_open() const;
  // Why there is no window, once.
  std::optional<std::string> TakeFailure();
  // What to show after the end of the run.
  void ShowResult(std::shared_ptr<const semslam::PointCloudMapping::Result> result);
  // Until the user closes the window.
  void WaitUntilClosed(const std::function<bool()>& should_stop);

 private:
  class Window;
  std::unique_ptr<Window> window_;
};
