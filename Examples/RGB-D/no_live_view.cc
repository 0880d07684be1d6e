// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Stands in for live_view.cc where the packages of the viewer were missing.
#include "semslam/base/check.h"

#include "live_view.h"

std::optional<std::string> WhyNoViewer() {
  return "--viewer: this program was built without it: install libegl-dev, libopengl-dev, "
         "libglfw3-dev and libimgui-dev, and build again, not with SEMSLAM_VIEWER=OFF";
}

class LiveView::Window {};

LiveView::LiveView(const Setup& /*setup*/) { SEMSLAM_CHECK(false) << *WhyNoViewer(); }
LiveView::~LiveView() = default;
bool LiveView::is_open() const { return false; }
std::optional<std::string> LiveView::TakeFailure() { return std::nullopt; }
// As in live_view.cc, which keeps it.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void LiveView::ShowResult(std::shared_ptr<const semslam::PointCloudMapping::Result> /*result*/) {}
void LiveView::WaitUntilClosed(const std::function<bool()>& /*should_stop*/) {}
