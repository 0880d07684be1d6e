// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "report.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "semslam/io/atomic_file.h"

#include "format_line.h"
#include "printable.h"
#include "segment_picture.h"

namespace {

using Json = nlohmann::ordered_json;

std::string Row(const std::string& name,
                const std::string& num_points,
                const std::string& method,
                const Measures* measures,
                double num_segments,
                double milliseconds) {
  std::string row = Line("%-16.16s %9s %-15s", name.c_str(), num_points.c_str(), method.c_str());
  if (measures != nullptr) {
    row += Line(" %6.3f %6.3f %6.3f %6.3f %9.3f %8.3f", measures->adjusted_rand_index,
                measures->over_segmentation, measures->under_segmentation,
                measures->boundary_recall, measures->boundary_precision, measures->coverage);
  } else {
    row += Line(" %6s %6s %6s %6s %9s %8s", "-", "-", "-", "-", "-", "-");
  }
  return row + Line(" %8.0f %8.0f\n", num_segments, milliseconds);
}

// Means of a method over the clouds, the measures over those with labels.
struct Means {
  Measures measures;
  double num_segments = 0;
  double milliseconds = 0;
  double num_clouds = 0;
  double num_labelled = 0;

  void Add(const MethodResult& result) {
    ++num_clouds;
    num_segments += static_cast<double>(result.num_segments);
    milliseconds += result.milliseconds;
    if (!result.scores) return;
    ++num_labelled;
    const Measures m = MeasuresOf(*result.scores);
    measures.adjusted_rand_index += m.adjusted_rand_index;
    measures.over_segmentation += m.over_segmentation;
    measures.under_segmentation += m.under_segmentation;
    measures.boundary_recall += m.boundary_recall;
    measures.boundary_precision += m.boundary_precision;
    measures.coverage += m.coverage;
  }
  void Finish() {
    num_segments /= num_clouds;
    milliseconds /= num_clouds;
    if (num_labelled == 0) return;
    for (double* sum :
         {&measures.adjusted_rand_index, &measures.over_segmentation, &measures.under_segmentation,
          &measures.boundary_recall, &measures.boundary_precision, &measures.coverage}) {
      *sum /= num_labelled;
    }
  }
};

// By method, in the order of the first report's results; all reports have the same methods.
std::vector<Means> MeansOf(const std::vector<CloudReport>& reports) {
  std::vector<Means> means(reports.front().results.size());
  for (const CloudReport& report : reports) {
    for (std::size_t i = 0; i < means.size(); ++i) means[i].Add(report.results[i]);
  }
  for (Means& mean : means) mean.Finish();
  return means;
}

Json ToJson(const Measures& measures) {
  return {{"adjusted_rand_index", measures.adjusted_rand_index},
          {"over_segmentation", measures.over_segmentation},
          {"under_segmentation", measures.under_segmentation},
          {"boundary_recall", measures.boundary_recall},
          {"boundary_precision", measures.boundary_precision},
          {"coverage", measures.coverage}};
}

Json ToJson(const MethodResult& result) {
  Json json = {{"method", MethodName(result.method)},
               {"num_segments", result.num_segments},
               {"milliseconds", result.milliseconds}};
  if (result.scores) json["measures"] = ToJson(MeasuresOf(*result.scores));
  return json;
}

void WritePicture(const std::filesystem::path& path,
                  const LabelledCloud& cloud,
                  const std::vector<std::uint32_t>& numbers) {
  WriteSegmentPicture(path, {.positions = cloud.points,
                             .colors = cloud.colors,
                             .normals = cloud.normals,
                             .segments = numbers});
}

}  // namespace

std::string TableHead() {
  return Line("%-16s %9s %-15s %6s %6s %6s %6s %9s %8s %8s %8s\n", "cloud", "points", "method",
              "ARI", "over", "under", "recall", "precision", "coverage", "segments", "ms");
}

std::string TableRows(const CloudReport& report) {
  std::string rows;
  for (const MethodResult& result : report.results) {
    const bool is_first = &result == &report.results.front();
    const Measures measures = result.scores ? MeasuresOf(*result.scores) : Measures();
    rows += Row(is_first ? Printable(report.name) : "",
                is_first ? std::to_string(report.num_points) : "", MethodName(result.method),
                result.scores ? &measures : nullptr, static_cast<double>(result.num_segments),
                result.milliseconds);
  }
  return rows;
}

std::string TableMeans(const std::vector<CloudReport>& reports) {
  std::string rows;
  const std::vector<Means> means = MeansOf(reports);
  for (std::size_t i = 0; i < means.size(); ++i) {
    rows += Row(i == 0 ? "mean" : "", "", MethodName(reports.front().results[i].method),
                means[i].num_labelled > 0 ? &means[i].measures : nullptr, means[i].num_segments,
                means[i].milliseconds);
  }
  return rows;
}

std::string ComparisonJson(const std::vector<CloudReport>& reports) {
  Json json = {{"clouds", Json::array()}, {"mean", Json::array()}};
  for (const CloudReport& report : reports) {
    Json cloud = {{"name", report.name},
                  {"num_points", report.num_points},
                  {"num_regions", report.num_regions},
                  {"methods", Json::array()}};
    for (const MethodResult& result : report.results) cloud["methods"].push_back(ToJson(result));
    json["clouds"].push_back(std::move(cloud));
  }
  const std::vector<Means> means = MeansOf(reports);
  for (std::size_t i = 0; i < means.size(); ++i) {
    Json mean = {{"method", MethodName(reports.front().results[i].method)},
                 {"num_segments", means[i].num_segments},
                 {"milliseconds", means[i].milliseconds}};
    if (means[i].num_labelled > 0) mean["measures"] = ToJson(means[i].measures);
    json["mean"].push_back(std::move(mean));
  }
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

void WritePictures(const std::filesystem::path& folder,
                   const LabelledCloud& cloud,
                   const std::vector<MethodResult>& results) {
  for (const MethodResult& result : results) {
    WritePicture(folder / (cloud.name + '_' + MethodName(result.method) + ".png"), cloud,
                 result.segments);
  }
  if (!cloud.truth.empty()) {
    WritePicture(folder / (cloud.name + "_truth.png"), cloud, cloud.truth);
  }
}
