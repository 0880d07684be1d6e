// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/time.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/geometry/rigid3.h"
#include "semslam/io/map_files.h"
#include "semslam/io/trajectory_io.h"
#include "semslam/semantics/detection.h"

namespace semslam {

// A line of a table: what it is, and its value with unit.
struct ReportFact {
  std::string name;
  std::string value;
};

// A keyframe's picture and what was detected in it.
struct ReportKeyframe {
  TimeNs time = 0;
  Rigid3 T_world_camera;
  std::string jpeg;                   // The colour image as it was recorded.
  std::vector<Detection> detections;  // The classes' labels are class_id + 1.
};

// The estimated trajectory compared with the true one.
struct ReportAccuracy {
  std::vector<ReportFact> facts;
  struct Pose {
    TimeNs time = 0;           // Of the estimate.
    Eigen::Vector3d position;  // The true one, metres, aligned to the estimate's world.
    double error = 0;          // Distance from the estimate, metres.
  };
  std::vector<Pose> poses;  // By time.
};

// What was measured with a clock. All of it stands in one section of the page and one tile, so that
// the rest is the same for the same input.
struct ReportSpeed {
  std::optional<ReportFact> highlight;
  std::vector<ReportFact> facts;
  std::vector<double> tracking_milliseconds;  // One a frame.
  struct Queues {
    std::size_t frame = 0;  // So many had been tracked when they were this long.
    std::size_t mapping = 0;
    std::size_t loop = 0;
    std::size_t dense = 0;
    std::size_t detector = 0;
  };
  std::vector<Queues> queues;  // By frame; empty where there are no queues.
};

// All that a report shows. Texts may hold anything: they are escaped.
struct ReportData {
  std::string title;                   // Such as the name of the sequence.
  std::string program;                 // With its version.
  std::vector<ReportFact> highlights;  // The few numbers to see first; at most a handful.
  std::vector<ReportFact> facts;       // All others.
  std::vector<std::string> notes;      // What the reader must know, a sentence each.
  std::vector<ReportFact> options;     // Of the command line.
  std::string settings_text;           // The settings file.
  ReportSpeed speed;
  Trajectory trajectory;  // Of all tracked frames.
  std::optional<ReportAccuracy> accuracy;
  std::vector<ReportKeyframe> keyframes;  // By time. For the strip and the objects' pictures.
  PinholeCamera::Parameters camera;
  LabelledMapView map;
};

struct ReportOptions {
  std::size_t max_points = 300'000;      // Of the interactive view; a larger map is thinned evenly.
  std::size_t max_keyframes = 40;        // Of the strip; of more, every so many.
  std::size_t max_objects = 300;         // Rows of the table, the largest confidence first.
  std::size_t max_bytes = 15'000'000;    // Of the file; above it there are fewer points.
  std::size_t max_settings = 64 * 1024;  // Bytes of the settings file that are shown.
  void Validate() const;                 // Throws std::invalid_argument.
};

// Writes one HTML page that needs nothing else, neither files nor a network: numbers, plots (SVG),
// pictures (JPEG), and the map as an interactive view (WebGL 2, where the browser has it). The same
// data give the same bytes. The file appears complete or not at all. Throws InputError.
void WriteReport(const std::filesystem::path& path,
                 const ReportData& data,
                 const ReportOptions& options = {});

}  // namespace semslam
