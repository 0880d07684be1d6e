// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "semslam/optim/bundle_adjuster.h"
#include "semslam/optim/pose_optimizer.h"

#include "optim/synthetic_bundle.h"

namespace semslam {
namespace {

// A frame against its local map, 10 % outliers, from a constant-velocity prediction.
void BM_OptimizePose(benchmark::State& state) {
  const testing::PoseScene scene = testing::MakePoseScene(
      static_cast<int>(state.range(0)), {.pixel = 0.7, .outliers = 0.1, .with_depth = 0.8});
  Random random(7);
  const Rigid3 initial = Retract(scene.T_world_camera, testing::RandomTwist(0.02, 0.03, &random));
  int num_iterations = 0;
  for (auto _ : state) {
    const PoseSolution solution = OptimizePose(scene.camera, initial, scene.observations);
    num_iterations = solution.num_iterations;
    benchmark::DoNotOptimize(solution.num_inliers);
  }
  state.counters["iterations"] = num_iterations;
}
BENCHMARK(BM_OptimizePose)->Arg(150)->Arg(300)->Arg(600)->Arg(1000)->Unit(benchmark::kMicrosecond);

// A local map: arguments are free poses, fixed poses, points; each point is seen about eight times,
// 5 % of it wrong.
void BM_AdjustBundle(benchmark::State& state) {
  const auto num_free = static_cast<int>(state.range(0));
  const auto num_fixed = static_cast<int>(state.range(1));
  const testing::BundleScene scene =
      testing::MakeBundleScene(num_free + num_fixed, num_fixed, static_cast<int>(state.range(2)), 8,
                               {.pixel = 0.7, .outliers = 0.05, .with_depth = 0.8});
  const BundleProblem problem = testing::Disturbed(scene.problem, 0.003, 0.01, 5);
  int num_iterations = 0;
  for (auto _ : state) {
    const BundleSolution solution = AdjustBundle(problem);
    num_iterations = solution.num_iterations;
    benchmark::DoNotOptimize(solution.final_cost);
  }
  state.counters["iterations"] = num_iterations;
  state.counters["observations"] = static_cast<double>(problem.observations.size());
}
BENCHMARK(BM_AdjustBundle)
    ->Args({10, 4, 2000})
    ->Args({20, 10, 3000})
    ->Args({30, 20, 4000})
    ->Args({300, 1, 20000})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace semslam

BENCHMARK_MAIN();
