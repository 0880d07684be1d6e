// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// Runs this project's segmentation beside PCL's on clouds, with labels or without:
//   evaluate_segmentation --label-parts mosd
//   evaluate_segmentation result/global_color.pcd
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "semslam/io/atomic_file.h"

#include "report.h"
#include "run_program.h"

namespace {

struct Arguments {
  std::vector<std::string> paths;
  std::vector<Method> methods = {Method::kGraph, Method::kLccp, Method::kRegionGrowing};
  bool label_parts = false;
  std::string json;
  std::string pictures;
};

void AddArguments(CLI::App& app, Arguments& arguments) {
  std::map<std::string, Method> method_of_name;
  for (const Method method : arguments.methods) method_of_name[MethodName(method)] = method;
  app.add_option("CLOUDS", arguments.paths,
                 "PCD files, and folders of PCD files; the field label, if there is one, tells the "
                 "true region of each point, 0 for unknown")
      ->required();
  app.add_flag("--label-parts", arguments.label_parts,
               "Labels are parts: 1-9 of a table, 20-29 of a first thing, 30-39 of a second, ... "
               "(Object Segmentation Database)");
  app.add_option("--methods", arguments.methods, "graph, lccp, region-growing (default: all)")
      ->delimiter(',')
      ->transform(CLI::Transformer(method_of_name));
  app.add_option("--json", arguments.json, "File to write the measures to");
  app.add_option("--pictures", arguments.pictures, "Folder to draw the segments to");
  app.set_version_flag("--version", "evaluate_segmentation " SEMSLAM_VERSION);
}

CloudReport Evaluate(const LabelledCloud& cloud, const Arguments& arguments) {
  CloudReport report;
  report.name = cloud.name;
  report.num_points = cloud.points.size();
  std::set<std::uint32_t> regions(cloud.truth.begin(), cloud.truth.end());
  regions.erase(0);
  report.num_regions = regions.size();
  for (const Method method : arguments.methods) {
    report.results.push_back(RunMethod(method, cloud));
  }
  if (!arguments.pictures.empty()) WritePictures(arguments.pictures, cloud, report.results);
  for (MethodResult& result : report.results) result.segments = {};
  return report;
}

int Run(const Arguments& arguments) {
  const std::vector<std::filesystem::path> paths = FindClouds(arguments.paths);
  if (!arguments.pictures.empty()) semslam::CheckOutputFolder(arguments.pictures);
  std::vector<CloudReport> reports;
  for (const std::filesystem::path& path : paths) {
    const LabelledCloud cloud = ReadLabelledCloud(path, arguments.label_parts);
    reports.push_back(Evaluate(cloud, arguments));
    if (reports.size() == 1) std::cout << TableHead();
    std::cout << TableRows(reports.back()) << std::flush;
  }
  if (reports.size() > 1) std::cout << TableMeans(reports);
  if (!arguments.json.empty())
    semslam::WriteFileAtomically(arguments.json, ComparisonJson(reports));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram<Arguments>("evaluate_segmentation",
                               "Runs this project's segmentation beside PCL's on point clouds.",
                               argc, argv, AddArguments, Run);
}
