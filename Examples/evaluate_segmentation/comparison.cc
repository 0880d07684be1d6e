// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "comparison.h"

#include <utility>

#include "semslam/base/stopwatch.h"
#include "semslam/segmentation/segmenter.h"

#include "pcl_methods.h"
#include "viewer_directions.h"

namespace {

MethodResult FromPcl(PclSegmentation segmentation) {
  MethodResult result;
  result.milliseconds = segmentation.milliseconds;
  result.num_segments = segmentation.num_segments;
  result.segments = std::move(segmentation.segment_of_point);
  return result;
}

MethodResult RunGraph(const LabelledCloud& cloud) {
  const std::vector<Eigen::Vector3f> views = ViewerDirections(cloud.points, cloud.normals);
  const semslam::Segmenter segmenter{semslam::Segmenter::Options()};
  const semslam::Stopwatch watch;
  semslam::Segmentation segmentation = segmenter.Segment({cloud.points, views});
  MethodResult result;
  result.milliseconds = watch.Milliseconds();
  result.num_segments = segmentation.segments.size();
  result.segments = std::move(segmentation.segment_of_point);
  return result;
}

}  // namespace

std::string MethodName(Method method) {
  switch (method) {
    case Method::kGraph:
      return "graph";
    case Method::kLccp:
      return "lccp";
    default:
      return "region-growing";
  }
}

MethodResult RunMethod(Method method, const LabelledCloud& cloud) {
  const semslam::PointCloudView view = {cloud.points, cloud.normals};
  MethodResult result = method == Method::kGraph  ? RunGraph(cloud)
                        : method == Method::kLccp ? FromPcl(SegmentWithLccp(view))
                                                  : FromPcl(SegmentWithRegionGrowing(view));
  result.method = method;
  if (!cloud.truth.empty()) {
    result.scores = {semslam::ScoreSegmentation(result.segments, cloud.truth),
                     semslam::ScoreBoundaries(cloud.points, result.segments, cloud.truth)};
  }
  return result;
}

Measures MeasuresOf(const MethodResult::Scores& scores) {
  return {scores.segmentation.adjusted_rand_index,
          scores.segmentation.over_segmentation,
          scores.segmentation.under_segmentation,
          scores.boundaries.recall,
          scores.boundaries.precision,
          scores.segmentation.coverage};
}
