// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "semslam/base/id.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/camera/rgbd_image.h"
#include "semslam/dense/keyframe_cloud.h"
#include "semslam/dense/rgb.h"
#include "semslam/features/frame.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/io/map_files.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// The newest frame, and what tracking made of it.
struct LiveFrame {
  std::size_t number = 0;  // Grows from frame to frame.
  RgbdImagePtr image;
  std::shared_ptr<const Frame> features;  // May be null.
  std::vector<bool> shows_landmark;       // One a feature while tracking, else empty.
  std::optional<Rigid3> T_world_camera;   // Nothing: lost.
  std::string state;                      // In a word.
};

// The keyframes and what ties them; edges are pairs of places in `keyframes`.
struct LiveGraph {
  using Edge = std::pair<std::size_t, std::size_t>;
  std::vector<Rigid3> keyframes;  // T_world_camera.
  std::vector<Edge> tree;
  std::vector<Edge> covisible;
  std::vector<Edge> loops;
  std::vector<Eigen::Vector3d> trajectory;  // Of all frames that were tracked, in the world.
};

// What a keyframe saw, and where it stands now.
struct LiveCloud {
  std::shared_ptr<const KeyframeCloud> cloud;
  Rigid3 T_world_keyframe;
};

// The labelled map as it was a moment ago. `owner` keeps what `map` shows.
struct LiveMap {
  std::shared_ptr<const void> owner;
  LabelledMapView map;
};

// An image in which something was detected.
struct LiveDetections {
  struct Box {
    ImageBox box;
    std::string title;
    Rgb color;
  };
  cv::Mat color;  // CV_8UC3, BGR.
  std::vector<Box> boxes;
};

// A keyframe's picture of an object.
struct LiveSighting {
  cv::Mat color;  // CV_8UC3, BGR: the part about the object.
  std::string title;
};

// How long a step of the work took lately.
struct LiveTiming {
  std::string name;
  std::vector<float> milliseconds;  // Newest last.
};

struct LiveStatus {
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::pair<std::string, std::size_t>> queues;  // What waits for each thread.
  double frames_per_second = 0;
  double memory_megabytes = 0;
  bool is_paused = false;
  bool is_localization_only = false;
  bool has_ended = false;  // No more frames, and commands do nothing.
  std::string message;     // What became of the last command.
};

// What a window shows of a run, and what its buttons do. The window asks from a thread of its own,
// whenever it likes: every function must be safe beside the run, cost it nothing to speak of, and
// return copies or what never changes.
class LiveSource {
 public:
  virtual ~LiveSource() = default;

  virtual PinholeCamera::Parameters camera() const = 0;
  virtual double voxel_size() const = 0;                       // Metres.
  virtual std::shared_ptr<const LiveFrame> frame() const = 0;  // Null before the first.
  virtual std::vector<LiveCloud> clouds() const = 0;           // Ascending by keyframe.
  virtual LiveGraph graph() const = 0;
  virtual std::shared_ptr<const LiveMap> map() const = 0;  // Null before the first.
  virtual void RequestMap() = 0;                           // A new one, when there is time.
  virtual std::shared_ptr<const LiveDetections> detections() const = 0;  // Newest; may be null.
  virtual std::vector<LiveSighting> Sightings(const ObjectRecord& object) const = 0;
  virtual std::vector<LiveTiming> timings() const = 0;
  virtual LiveStatus status() const = 0;

  virtual void SetPaused(bool paused) = 0;
  virtual void Step() = 0;  // One frame, while paused.
  virtual void Save() = 0;  // The map as it is, into files.
  virtual void Reset() = 0;
  virtual void SetLocalizationOnly(bool localization_only) = 0;
};

}  // namespace semslam
