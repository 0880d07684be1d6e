// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// What the extraction of 1000 features from a 640 x 480 image takes, and its steps over all levels.
//   features_benchmark [IMAGE.png]    default: a rendered desk
#include <iostream>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "semslam/features/orb_extractor.h"
#include "semslam/render/clip.h"

#include "features/brief.h"
#include "features/corners.h"
#include "features/orientation.h"
#include "features/pyramid.h"

namespace semslam {
namespace {

constexpr int kEdge = 19;

std::vector<cv::Mat> MakeLevels(const cv::Mat& gray, const OrbExtractor& extractor) {
  std::vector<cv::Mat> levels = {gray};
  for (std::size_t i = 1; i < extractor.scale_factors().size(); ++i) {
    const cv::Size size = LevelSize(gray.size(), extractor.scale_factors()[i]);
    levels.push_back(Shrink(levels.back(), size, extractor.options().scale_factor));
  }
  return levels;
}

// One image for all benchmarks.
struct Subject {
  explicit Subject(cv::Mat image) : gray(std::move(image)) {
    levels = MakeLevels(gray, extractor);
    for (const cv::Mat& level : levels) corners.push_back(DetectCorners(level, kEdge, 20, 7));
  }
  cv::Mat gray;
  OrbExtractor extractor{OrbExtractor::Options{}};
  std::vector<cv::Mat> levels;
  std::vector<std::vector<Corner>> corners;
};

template <typename Step>
void Register(const char* name, Step step) {
  benchmark::RegisterBenchmark(name, [step](benchmark::State& state) {
    for (auto _ : state) step();
  })->Unit(benchmark::kMillisecond);
}

void RegisterAll(const Subject& s) {
  Register("Extract", [&s] { benchmark::DoNotOptimize(s.extractor.Extract(s.gray)); });
  Register("  Pyramid", [&s] { benchmark::DoNotOptimize(MakeLevels(s.gray, s.extractor)); });
  Register("  Corners", [&s] {
    for (const cv::Mat& level : s.levels)
      benchmark::DoNotOptimize(DetectCorners(level, kEdge, 20, 7));
  });
  Register("  Spread", [&s] {
    for (std::size_t i = 0; i < s.levels.size(); ++i) {
      const cv::Rect region(kEdge, kEdge, s.levels[i].cols - 2 * kEdge,
                            s.levels[i].rows - 2 * kEdge);
      benchmark::DoNotOptimize(SpreadCorners(s.corners[i], region, 125));
    }
  });
  Register("  Blur", [&s] {
    for (const cv::Mat& level : s.levels) benchmark::DoNotOptimize(BlurForBrief(level));
  });
  Register("  1000 orientations", [&s] {
    const IntensityCentroid centroid;
    for (int i = 0; i < 1000; ++i)
      benchmark::DoNotOptimize(centroid.AngleDegrees(s.gray, 30 + i % 500, 30 + i % 400));
  });
  Register("  1000 descriptors", [&s] {
    const SteeredBrief brief;
    for (int i = 0; i < 1000; ++i) {
      benchmark::DoNotOptimize(
          brief.Describe(s.gray, 30 + i % 500, 30 + i % 400, static_cast<float>(i % 360)));
    }
  });
}

}  // namespace
}  // namespace semslam

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  cv::setNumThreads(1);
  cv::Mat gray;
  if (argc > 1) {
    gray = cv::imread(argv[1], cv::IMREAD_GRAYSCALE);
    if (gray.empty()) {
      std::cerr << "features_benchmark: " << argv[1] << ": expected an image\n";
      return 1;
    }
  } else {
    cv::cvtColor(semslam::RenderedClip({.num_frames = 1}).Frame(0).color, gray, cv::COLOR_BGR2GRAY);
  }
  const semslam::Subject subject(gray);
  semslam::RegisterAll(subject);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
