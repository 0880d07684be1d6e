// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "semslam/eval/segmentation_score.h"
#include "semslam/segmentation/segmenter.h"

#include "segmentation/labelled_scene.h"

namespace semslam {
namespace {

// SEMSLAM_PICTURES: a folder for coloured pictures of the truth and the result.
void WritePictures(const test::LabelledScene& scene, const Segmentation& result) {
  const char* const folder = std::getenv("SEMSLAM_PICTURES");
  if (folder == nullptr) return;
  const std::string stem = std::string(folder) + "/" + scene.name;
  test::WritePicture(scene, scene.truth, stem + "_truth.png");
  test::WritePicture(scene, result.segment_of_point, stem + "_segments.png");
}

TEST(LabelledScenes, AreSegmentedLikeTheTruth) {
  const std::vector<test::LabelledScene> scenes = test::LoadLabelledScenes();
  if (scenes.empty()) GTEST_SKIP() << "no labelled scenes in ../shared/data/mosd";
  const Segmenter segmenter{Segmenter::Options()};
  double sum = 0;
  for (const test::LabelledScene& scene : scenes) {
    const Segmentation result = segmenter.Segment(scene.View());
    const SegmentationScore score = ScoreSegmentation(result.segment_of_point, scene.truth);
    sum += score.adjusted_rand_index;
    std::printf(
        "%-8s ARI %.3f over %.3f under %.3f  %zu voxels %zu patches %zu planes of %zu, "
        "%zu segments, %.0f ms\n",
        scene.name.c_str(), score.adjusted_rand_index, score.over_segmentation,
        score.under_segmentation, result.num_voxels, result.num_supervoxels, result.planes.size(),
        result.num_hypotheses, result.segments.size(), result.times.Total());
    WritePictures(scene, result);
  }
  const double mean = sum / static_cast<double>(scenes.size());
  std::printf("mean ARI %.3f\n", mean);
  EXPECT_GE(mean, 0.95);
}

}  // namespace
}  // namespace semslam
