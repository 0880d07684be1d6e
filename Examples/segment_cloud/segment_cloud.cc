// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Divides one point cloud into segments:
//   segment_cloud room.pcd segments.pcd --planes planes.json
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "semslam/base/error.h"
#include "semslam/base/stopwatch.h"
#include "semslam/io/atomic_file.h"
#include "semslam/io/cloud_io.h"
#include "semslam/segmentation/segmenter.h"

#include "pcl_methods.h"
#include "run_program.h"
#include "viewer_directions.h"

namespace {

using Json = nlohmann::ordered_json;

enum class Method { kGraph, kLccp, kRegionGrowing };

struct Arguments {
  std::string input;
  std::string output;
  Method method = Method::kGraph;
  std::string planes;
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  const std::map<std::string, Method> methods = {{"graph", Method::kGraph},
                                                 {"lccp", Method::kLccp},
                                                 {"region-growing", Method::kRegionGrowing}};
  app.add_option("IN", arguments.input,
                 "PCD file, metres; normals tell the side a surface was seen from, without any it "
                 "is the origin")
      ->required();
  app.add_option("OUT", arguments.output,
                 "PCD file to write: the points of IN with their segment, 0 for none")
      ->required();
  app.add_option("--method", arguments.method,
                 "graph, this project's, or of PCL lccp or region-growing (default: graph)")
      ->transform(CLI::Transformer(methods));
  app.add_option("--planes", arguments.planes,
                 "JSON file to write the planes and segments to; with graph only");
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

std::vector<semslam::SegmentId> SegmentWithGraph(const semslam::CloudColumns& cloud,
                                                 const std::string& planes_file) {
  const std::vector<Eigen::Vector3f> views = ViewerDirections(cloud.positions, cloud.normals);
  const semslam::Segmenter segmenter{semslam::Segmenter::Options()};
  semslam::Segmentation result = segmenter.Segment({cloud.positions, views});
  std::cout << result.segments.size() << " segments, " << result.planes.size() << " planes, "
            << result.num_supervoxels << " supervoxels of " << result.num_voxels << " voxels of "
            << result.voxel_size << " m\n";
  if (!planes_file.empty()) semslam::WriteFileAtomically(planes_file, PlanesJson(result));
  return std::move(result.segment_of_point);
}

std::vector<semslam::SegmentId> Segment(const semslam::CloudColumns& cloud,
                                        const Arguments& arguments) {
  if (arguments.method == Method::kGraph) return SegmentWithGraph(cloud, arguments.planes);
  const semslam::PointCloudView view = {cloud.positions, cloud.normals};
  PclSegmentation result =
      arguments.method == Method::kLccp ? SegmentWithLccp(view) : SegmentWithRegionGrowing(view);
  std::cout << result.num_segments << " segments\n";
  return std::move(result.segment_of_point);
}

int Run(const Arguments& arguments) {
  if (!arguments.planes.empty() && arguments.method != Method::kGraph) {
    throw semslam::InputError("--planes: expected with --method graph, found another method");
  }
  const semslam::CloudColumns cloud = semslam::ReadPcd(arguments.input);
  if (cloud.positions.empty()) {
    throw semslam::InputError(arguments.input + ": expected points, found none");
  }
  std::cout << cloud.positions.size() << " points\n" << std::flush;
  const semslam::Stopwatch watch;
  const std::vector<semslam::SegmentId> segments = Segment(cloud, arguments);
  std::cout << watch.Milliseconds() << " ms\n";
  semslam::WritePcd(arguments.output, {.positions = cloud.positions,
                                       .colors = cloud.colors,
                                       .normals = cloud.normals,
                                       .labels = cloud.labels,
                                       .segments = segments});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("segment_cloud",
                               "Divides a point cloud into surfaces and things by its geometry.",
                               argc, argv, AddArguments, Run);
}
