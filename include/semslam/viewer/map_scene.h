// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "semslam/camera/pinhole_camera.h"
#include "semslam/io/level_frame.h"
#include "semslam/io/map_files.h"
#include "semslam/io/trajectory_io.h"
#include "semslam/viewer/draw_list.h"

namespace semslam {

// What the colours of the points tell.
enum class ColorMode { kPhoto, kSegments, kClasses, kHeight };

// A mapped place and how it was mapped, to be shown. The cloud stays where it is.
struct MapScene {
  LabelledMapView map;
  Trajectory trajectory;                            // Of all frames, by time; may be empty.
  Trajectory keyframes;                             // May be empty.
  std::optional<PinholeCamera::Parameters> camera;  // That made it, for the shape of its frusta.
};

// Heights above an arbitrary level between which almost all points lie, metres.
struct HeightRange {
  double low = 0;
  double high = 0;
};
HeightRange FindHeightRange(std::span<const Eigen::Vector3f> points, const Eigen::Vector3d& up);

// From deep blue (0) over green to yellow (1); other values as the nearer end.
Rgb HeightColor(double share);

// One colour a point.
std::vector<Rgb> PointColors(const LabelledMapView& map,
                             ColorMode mode,
                             const Eigen::Vector3d& up,
                             const HeightRange& heights);

// What to show beside the points.
struct OverlayOptions {
  bool grid = true;        // On the floor.
  bool trajectory = true;  // With the keyframes.
  bool objects = true;     // Boxes and names.
  std::optional<std::uint32_t> selected_object;
};

// Points that a picture of all that is shown must hold: of the cloud, and the keyframes' places in
// such number that a fit by quantiles (OrbitCamera::Fit) does not leave them out.
std::vector<Eigen::Vector3f> PointsToShow(const MapScene& scene, const OverlayOptions& options);

// Lines and names for all that is asked for and known.
DrawList MakeOverlay(const MapScene& scene, const LevelFrame& level, const OverlayOptions& options);

// The object whose box a ray enters first; nothing if it meets none.
std::optional<std::uint32_t> PickObject(std::span<const ObjectRecord> objects,
                                        const Eigen::Vector3d& origin,
                                        const Eigen::Vector3d& direction);

// Text on an object's plate: "cup 87 %".
std::string ObjectTitle(const ObjectRecord& object, std::span<const ClassRecord> classes);
// Colour of the class, or white if it is not in the table.
Rgb ObjectColor(const ObjectRecord& object, std::span<const ClassRecord> classes);

}  // namespace semslam
