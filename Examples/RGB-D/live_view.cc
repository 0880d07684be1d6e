// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "live_view.h"

#include <exception>
#include <stop_token>
#include <utility>

#include "semslam/base/guarded.h"
#include "semslam/base/pause.h"
#include "semslam/base/stage.h"
#include "semslam/viewer/live_window.h"

#include "run_source.h"

std::optional<std::string> WhyNoViewer() { return std::nullopt; }

class LiveView::Window {
 public:
  explicit Window(const Setup& setup)
      : state_(setup.state),
        title_(setup.title),
        source_(setup),
        stage_({.queue_capacity = 1, .is_background = true},
               [this](const std::stop_token& stop) { Show(stop); }) {
    stage_.Submit(stop_.get_token());
  }
  ~Window() {
    stop_.request_stop();
    stage_.Cancel();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool is_open() const {
    return report_.Read([](const Report& report) { return !report.is_closed; });
  }
  std::optional<std::string> TakeFailure() {
    return report_.Write(
        [](Report& report) { return std::exchange(report.failure, std::nullopt); });
  }
  RunSource& source() { return source_; }

 private:
  struct Report {
    bool is_closed = false;
    std::optional<std::string> failure;
  };

  // In the window's thread. Whatever goes wrong here, the run goes on.
  void Show(const std::stop_token& stop) {
    std::optional<std::string> failure;
    try {
      semslam::ShowRun(source_, {.title = title_}, stop);
    } catch (const std::exception& error) {
      failure = error.what();
    }
    state_->SetPaused(false);  // Nobody is left to go on.
    report_.Write([&](Report& report) { report = {true, failure}; });
  }

  const std::shared_ptr<LiveState> state_;
  const std::string title_;
  RunSource source_;
  std::stop_source stop_;
  semslam::Guarded<Report> report_;
  semslam::Stage<std::stop_token> stage_;  // Last: its thread ends before what it uses.
};

LiveView::LiveView(const Setup& setup) : window_(std::make_unique<Window>(setup)) {}

LiveView::~LiveView() = default;

bool LiveView::is_open() const { return window_->is_open(); }

std::optional<std::string> LiveView::TakeFailure() { return window_->TakeFailure(); }

void LiveView::ShowResult(std::shared_ptr<const semslam::PointCloudMapping::Result> result) {
  window_->source().ShowResult(std::move(result));
}

void LiveView::WaitUntilClosed(const std::function<bool()>& should_stop) {
  constexpr double kLook = 0.05;  // Seconds.
  while (is_open() && !should_stop()) semslam::Pause(kLook);
}
