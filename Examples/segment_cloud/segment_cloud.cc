// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Divides one point cloud into segments:
//   segment_cloud room.ply segments.pcd --planes planes.json --picture segments.png
#include <filesystem>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"
#include "semslam/segmentation/segmenter.h"

#include "interrupt.h"
#include "pcl_methods.h"
#include "run_program.h"
#include "segment_picture.h"
#include "viewer_directions.h"

namespace {

using Json = nlohmann::ordered_json;

enum class Method { kGraph, kLccp, kRegionGrowing };

struct Arguments {
  std::string input;
  std::string output;
  Method method = Method::kGraph;
  std::string planes;
  std::string picture;
};

// Ctrl-C was pressed: nothing is written.
struct Interrupted {};

void AddArguments(CLI::App& app, Arguments& arguments) {
  const std::map<std::string, Method> methods = {{"graph", Method::kGraph},
                                                 {"lccp", Method::kLccp},
                                                 {"region-growing", Method::kRegionGrowing}};
  app.add_option(
         "IN", arguments.input,
         "PCD or PLY file, metres; normals tell the side a surface was seen from, without any it "
         "is the origin")
      ->required();
  app.add_option("OUT", arguments.output,
                 "PCD or PLY file to write: the points of IN with their segment, 0 for none")
      ->required();
  app.add_option("--method", arguments.method,
                 "graph, this project's, or of PCL lccp or region-growing (default: graph)")
      ->transform(CLI::Transformer(methods));
  app.add_option("--planes", arguments.planes,
                 "JSON file to write the planes and segments to; with graph only");
  app.add_option("--picture", arguments.picture,
                 "PNG file to draw the points to, in their colours and those of their segments");
  app.set_version_flag("--version", "segment_cloud " SEMSLAM_VERSION);
}

Json ToJson(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json ToJson(const semslam::Plane& plane) {
  return {{"normal", ToJson(plane.normal)}, {"offset", plane.offset}};
}

// Metres; points x of a plane have normal . x + offset = 0.
std::string PlanesJson(const semslam::Segmentation& result) {
  Json json = {{"planes", Json::array()}, {"segments", Json::array()}};
  for (const semslam::Plane& plane : result.planes) json["planes"].push_back(ToJson(plane));
  for (const semslam::Segment& segment : result.segments) {
    Json entry = {{"id", segment.id},
                  {"points", segment.num_points},
                  {"area", segment.area},
                  {"centroid", ToJson(segment.centroid)},
                  {"structural", segment.is_structural},
                  {"neighbours", segment.neighbours}};
    if (segment.plane) entry["plane"] = ToJson(*segment.plane);
    json["segments"].push_back(std::move(entry));
  }
  return json.dump(1) + '\n';
}

bool IsPly(const std::string& path) { return std::filesystem::path(path).extension() == ".ply"; }

// On standard error: over itself on a terminal, else nothing.
void ShowStep(std::string_view step) {
  if (interrupt_requested != 0) throw Interrupted();
  if (::isatty(STDERR_FILENO) == 0) return;
  std::cerr << "\r\033[K" << step << (step == "done" ? "\r\033[K" : " ...") << std::flush;
}

struct Segments {
  std::vector<semslam::SegmentId> of_point;
  std::string planes_json;  // With graph only.
};

Segments SegmentWithGraph(const semslam::CloudColumns& cloud) {
  const std::vector<Eigen::Vector3f> views = ViewerDirections(cloud.positions, cloud.normals);
  const semslam::Segmenter segmenter{semslam::Segmenter::Options()};
  semslam::Segmentation result = segmenter.Segment({cloud.positions, views}, ShowStep);
  ShowStep("done");
  std::cout << result.segments.size() << " segments, " << result.planes.size() << " planes, "
            << result.num_supervoxels << " supervoxels of " << result.num_voxels << " voxels of "
            << result.voxel_size << " m\n";
  return {std::move(result.segment_of_point), PlanesJson(result)};
}

Segments Segment(const semslam::CloudColumns& cloud, const Arguments& arguments) {
  if (arguments.method == Method::kGraph) return SegmentWithGraph(cloud);
  const semslam::PointCloudView view = {cloud.positions, cloud.normals};
  PclSegmentation result =
      arguments.method == Method::kLccp ? SegmentWithLccp(view) : SegmentWithRegionGrowing(view);
  std::cout << result.num_segments << " segments\n";
  return {std::move(result.segment_of_point), {}};
}

void Write(const Arguments& arguments,
           const semslam::CloudColumns& cloud,
           const Segments& segments) {
  const semslam::CloudView view = {.positions = cloud.positions,
                                   .colors = cloud.colors,
                                   .normals = cloud.normals,
                                   .labels = cloud.labels,
                                   .segments = segments.of_point};
  IsPly(arguments.output) ? semslam::WritePly(arguments.output, view)
                          : semslam::WritePcd(arguments.output, view);
  if (!arguments.planes.empty()) {
    semslam::WriteFileAtomically(arguments.planes, segments.planes_json);
  }
  if (!arguments.picture.empty()) WriteSegmentPicture(arguments.picture, view);
}

int SegmentFile(const Arguments& arguments) {
  if (!arguments.planes.empty() && arguments.method != Method::kGraph) {
    throw semslam::InputError("--planes: expected with --method graph, found another method");
  }
  ShowStep("reading");
  const semslam::CloudColumns cloud = IsPly(arguments.input) ? semslam::ReadPly(arguments.input)
                                                             : semslam::ReadPcd(arguments.input);
  ShowStep("done");
  if (cloud.positions.empty()) {
    throw semslam::InputError(arguments.input + ": expected points, found none");
  }
  std::cout << cloud.positions.size() << " points\n" << std::flush;
  const semslam::Stopwatch watch;
  const Segments segments = Segment(cloud, arguments);
  if (interrupt_requested != 0) throw Interrupted();
  std::cout << watch.Milliseconds() << " ms\n";
  Write(arguments, cloud, segments);
  return 0;
}

int Run(const Arguments& arguments) {
  constexpr int kInterrupted = 130;  // As shells have it for Ctrl-C.
  InstallInterruptHandler();
  try {
    return SegmentFile(arguments);
  } catch (const Interrupted&) {
    std::cerr << "\nsegment_cloud: interrupted, nothing was written\n";
    return kInterrupted;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("segment_cloud",
                               "Divides a point cloud into surfaces and things by its geometry.",
                               argc, argv, AddArguments, Run);
}
