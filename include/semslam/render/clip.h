// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "semslam/camera/frame_source.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/render/renderer.h"
#include "semslam/render/scenes.h"
#include "semslam/render/sensor.h"

namespace semslam {

// A frame with everything that is true of it.
struct RenderedFrame {
  TimeNs time = 0;
  Rigid3 T_world_camera;  // Exact. World: z up.
  cv::Mat color;          // CV_8UC3, BGR.
  cv::Mat depth_16u;      // CV_16UC1, 1 / depth_factor metres.
  IdealImage ideal;       // True depth, labels, light.
};

// A recording of a made-up scene: frames as a real camera would give them, and their truth. A frame
// is rendered when it is asked for, from its number alone: in any order, as often as wanted, always
// the same bytes. Frame may be called from several threads at once.
//
//   RenderedClip clip({.scene = "desk", .num_frames = 60});
//   while (std::optional<RgbdImage> image = clip.Next()) ...
class RenderedClip : public FrameSource {
 public:
  struct Options {
    std::string scene = "desk";  // One of SceneNames(), or the path of a scene file.
    std::uint64_t seed = 1;      // Of the scene, the path and all noise.
    int num_frames = 150;
    double fps = 30;  // Frames a second.
    PinholeCamera::Parameters camera = CameraByName("TUM1");
    double depth_factor = 5000;  // Depth image units a metre.
    ColorSensorOptions color = {};
    DepthSensorOptions depth = {};
    // While the lens is covered the picture is black but for its noise, and depth is empty. The
    // truth (pose, ideal image) stays what an open lens would see. Seconds since the start; the end
    // is not covered.
    struct Interval {
      double from_s = 0;
      double to_s = 0;
    };
    std::optional<Interval> covered = {};
    Renderer::Options rendering = {};
    int num_threads = 0;  // As ParallelFor.
    // Turns noise, blur, holes and range limits off; lens distortion stays.
    void MakeClean();
    // Throws InputError for what a user can say, std::invalid_argument for the sensors.
    void Validate() const;
  };

  explicit RenderedClip(const Options& options);

  std::optional<RgbdImage> Next() override;
  std::optional<std::size_t> NumFrames() const override { return num_frames(); }

  // Frames are numbered from 0.
  RenderedFrame Frame(std::size_t index) const { return Frame(index, options_.num_threads); }
  // On so many threads; it is the same frame.
  RenderedFrame Frame(std::size_t index, int num_threads) const;
  RgbdImage Image(std::size_t index) const;
  TimeNs Time(std::size_t index) const;
  bool IsCovered(std::size_t index) const;
  Rigid3 T_world_camera(std::size_t index) const;

  std::size_t num_frames() const { return static_cast<std::size_t>(options_.num_frames); }
  const Options& options() const { return options_; }
  const PinholeCamera& camera() const { return camera_; }
  const Scene& scene() const { return staged_->scene; }
  const std::vector<Instance>& instances() const { return staged_->scene.instances(); }

 private:
  Options options_;
  PinholeCamera camera_;
  RayTable rays_;
  std::unique_ptr<const StagedScene> staged_;  // At a fixed place: the renderer refers to it.
  Renderer renderer_;
  std::size_t next_ = 0;
};

}  // namespace semslam
