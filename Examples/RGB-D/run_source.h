// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "semslam/base/guarded.h"
#include "semslam/base/stage.h"
#include "semslam/viewer/live_source.h"

#include "live_view.h"

// What a window asks about a run of System, and what its buttons do to it.
class RunSource : public semslam::LiveSource {
 public:
  explicit RunSource(const LiveView::Setup& setup);

  semslam::PinholeCamera::Parameters camera() const override;
  double voxel_size() const override;
  std::shared_ptr<const semslam::LiveFrame> frame() const override;
  std::vector<semslam::LiveCloud> clouds() const override;
  semslam::LiveGraph graph() const override;
  std::shared_ptr<const semslam::LiveMap> map() const override;
  void RequestMap() override;
  std::shared_ptr<const semslam::LiveDetections> detections() const override;
  std::vector<semslam::LiveSighting> Sightings(const semslam::ObjectRecord& object) const override;
  std::vector<semslam::LiveTiming> timings() const override;
  semslam::LiveStatus status() const override;

  void SetPaused(bool paused) override;
  void Step() override;
  void Save() override;
  void Reset() override;
  void SetLocalizationOnly(bool localization_only) override;

  void ShowResult(std::shared_ptr<const semslam::PointCloudMapping::Result> result);

 private:
  using Result = semslam::PointCloudMapping::Result;
  using ResultPtr = std::shared_ptr<const Result>;
  // The newest thing that was made out of another, so that it is made once.
  template <typename From, typename To>
  using Made = semslam::Guarded<std::pair<std::shared_ptr<const From>, std::shared_ptr<const To>>>;

  ResultPtr newest_result() const;
  void WriteSnapshot(const ResultPtr& result);

  const LiveView::Setup setup_;
  semslam::Guarded<ResultPtr> final_result_;
  mutable Made<Result, semslam::LiveMap> map_;
  mutable Made<LiveState::Tracked, semslam::LiveFrame> frame_;
  mutable Made<LiveState::Detected, semslam::LiveDetections> detections_;
  semslam::Stage<ResultPtr> saver_;  // Last: its thread ends before what it uses.
};
