// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/clip_writer.h"

#include <array>
#include <cstdio>
#include <sstream>

#include <nlohmann/json.hpp>

#include "semslam/base/error.h"
#include "semslam/base/guarded.h"
#include "semslam/base/parallel.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/png_writer.h"
#include "semslam/io/trajectory_io.h"

#include "render/true_surface.h"

namespace semslam {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInstancesFile = "instances.json";
constexpr std::array kListFiles = {"rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt"};
constexpr std::array kFrameFolders = {"rgb", "depth", "labels", "detections"};

// Makes the folder, or takes an earlier clip out of it: its lists first, so that what is left never
// looks complete. Nothing else is ever deleted.
void PrepareFolder(const fs::path& folder) {
  CheckOutputFolder(folder);
  if (!fs::is_empty(folder) && !fs::exists(folder / kInstancesFile)) {
    throw InputError(folder.string() +
                     ": expected a new or empty folder or an earlier rendered clip, found other "
                     "files in it");
  }
  for (const char* name : kListFiles) fs::remove(folder / name);
  for (const char* name : kFrameFolders) {
    CheckOutputFolder(folder / name);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / name)) {
      const fs::path extension = entry.path().extension();
      if (entry.is_regular_file() && (extension == ".png" || extension == ".txt"))
        fs::remove(entry.path());
    }
  }
}

std::string SettingsText(const RenderedClip& clip) {
  const PinholeCamera::Parameters& camera = clip.options().camera;
  std::ostringstream text;
  text.precision(10);
  text << "%YAML:1.0\n\n# Camera of this rendered clip: " << clip.options().scene << ", seed "
       << clip.options().seed << ".\n"
       << "Camera.fx: " << camera.fx << "\nCamera.fy: " << camera.fy << "\nCamera.cx: " << camera.cx
       << "\nCamera.cy: " << camera.cy << "\n\nCamera.k1: " << camera.k1
       << "\nCamera.k2: " << camera.k2 << "\nCamera.p1: " << camera.p1
       << "\nCamera.p2: " << camera.p2 << "\nCamera.k3: " << camera.k3
       << "\n\nCamera.width: " << camera.width << "\nCamera.height: " << camera.height
       << "\nCamera.fps: " << clip.options().fps << "\n\n"
       << "# Baseline of the imagined stereo pair (m) times fx.\nCamera.bf: 40.0\n\n"
       << "# 1: colour images are RGB; 0: BGR.\nCamera.RGB: 1\n\n"
       << "# Points nearer than this many baselines are close.\nThDepth: 40.0\n\n"
       << "# Value of a depth pixel at 1 m.\nDepthMapFactor: " << clip.options().depth_factor
       << "\n\n"
       << "ORBextractor.nFeatures: 1000\nORBextractor.scaleFactor: 1.2\nORBextractor.nLevels: 8\n"
       << "ORBextractor.iniThFAST: 20\nORBextractor.minThFAST: 7\n";
  return text.str();
}

nlohmann::ordered_json ToJson(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

std::string InstancesText(const RenderedClip& clip) {
  nlohmann::ordered_json root;
  root["frame"] = "world, z up, metres; quaternions x y z w";
  root["instances"] = nlohmann::ordered_json::array();
  for (const Instance& instance : clip.instances()) {
    const Eigen::Quaterniond& rotation = instance.box.T_world_box.rotation;
    root["instances"].push_back(
        {{"id", instance.id},
         {"class", instance.class_name},
         {"center", ToJson(instance.box.T_world_box.translation)},
         {"orientation", {rotation.x(), rotation.y(), rotation.z(), rotation.w()}},
         {"size", ToJson(2.0 * instance.box.half_size)}});
  }
  return root.dump(1) + "\n";
}

std::string DetectionsText(const std::vector<TrueDetection>& detections, const cv::Size& size) {
  std::string text;
  for (const TrueDetection& detection : detections) {
    const cv::Rect2d& box = detection.box;
    char line[128];
    std::snprintf(line, sizeof(line), "%d %.6f %.6f %.6f %.6f %.4f\n", detection.class_index,
                  (box.x + 0.5 * box.width) / size.width, (box.y + 0.5 * box.height) / size.height,
                  box.width / size.width, box.height / size.height, detection.score);
    text += line;
  }
  return text;
}

// The text files that list the frames.
struct FrameLists {
  std::string color = "# color images\n# timestamp filename\n";
  std::string depth = "# depth images\n# timestamp filename\n";
  std::string associations;
  Trajectory trajectory;

  void Add(TimeNs time, const Rigid3& T_world_camera) {
    const std::string stamp = FormatTime(time);
    const std::string color_entry = stamp + " rgb/" + stamp + ".png";
    const std::string depth_entry = stamp + " depth/" + stamp + ".png";
    color += color_entry + "\n";
    depth += depth_entry + "\n";
    associations += color_entry + " " + depth_entry + "\n";
    trajectory.push_back({time, T_world_camera});
  }
};

void WriteLists(const FrameLists& lists, const fs::path& folder) {
  WriteFileAtomically(folder / "rgb.txt", lists.color);
  WriteFileAtomically(folder / "depth.txt", lists.depth);
  WriteFileAtomically(folder / "associations.txt", lists.associations);
  WriteTrajectory(folder / "groundtruth.txt", lists.trajectory);
}

void WriteClassNames(const DetectionOptions& options, const fs::path& path) {
  std::string names;
  for (const std::string& name : options.class_names) names += name + "\n";
  WriteFileAtomically(path, names);
}

void WriteFrame(const RenderedClip& clip,
                std::size_t index,
                const fs::path& folder,
                const DetectionOptions& options) {
  const RenderedFrame frame = clip.Frame(index, 1);
  const std::string stamp = FormatTime(frame.time);
  // Noise has no runs to look for.
  WritePng(folder / "rgb" / (stamp + ".png"), frame.color, PngContent::kPhoto);
  WritePng(folder / "depth" / (stamp + ".png"), frame.depth_16u, PngContent::kPhoto);
  WritePng(folder / "labels" / (stamp + ".png"), frame.ideal.labels, PngContent::kFlat);
  std::vector<TrueDetection> detections;
  if (!clip.IsCovered(index)) {
    detections =
        DetectFromLabels(frame.ideal.labels, clip.instances(), clip.options().seed, index, options);
  }
  WriteFileAtomically(folder / "detections" / (stamp + ".txt"),
                      DetectionsText(detections, frame.color.size()));
}

}  // namespace

void WriteClip(const RenderedClip& clip,
               const fs::path& folder,
               const DetectionOptions& detections,
               const std::function<void(std::size_t)>& progress) {
  PrepareFolder(folder);
  WriteFileAtomically(folder / kInstancesFile, InstancesText(clip));
  WriteFileAtomically(folder / "settings.yaml", SettingsText(clip));
  WriteClassNames(detections, folder / "detections" / "classes.names");
  Guarded<std::size_t> num_written(0);
  const auto write_frame = [&](std::size_t index) {
    WriteFrame(clip, index, folder, detections);
    if (!progress) return;
    num_written.Write([&](std::size_t& count) { progress(++count); });
  };
  // Whole frames side by side, each on one thread: less waiting than rows side by side. Beside
  // them the surface, which takes longest and so comes first.
  const auto write_piece = [&](std::size_t index) {
    if (index == 0) {
      WriteTrueSurface(folder / "surface.pcd", SampleTrueSurface(clip));
    } else {
      write_frame(index - 1);
    }
  };
  ParallelFor(clip.num_frames() + 1, 1, clip.options().num_threads,
              [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) write_piece(i);
              });
  FrameLists lists;
  for (std::size_t i = 0; i < clip.num_frames(); ++i)
    lists.Add(clip.Time(i), clip.T_world_camera(i));
  WriteLists(lists, folder);
}

}  // namespace semslam
