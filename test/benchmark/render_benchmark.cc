// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <benchmark/benchmark.h>

#include "semslam/io/png_writer.h"
#include "semslam/render/clip.h"

namespace semslam {
namespace {

// Steps of one frame of the desk at 640x480, full noise, on one thread. Look at the CPU column.

constexpr std::size_t kFrame = 20;

RenderedClip::Options DeskOptions() {
  RenderedClip::Options options;
  options.num_frames = 40;
  options.num_threads = 1;
  return options;
}

void BM_WholeFrame(benchmark::State& state) {
  const RenderedClip clip(DeskOptions());
  for (auto _ : state) benchmark::DoNotOptimize(clip.Frame(kFrame, 1).color.data);
}
BENCHMARK(BM_WholeFrame)->Unit(benchmark::kMillisecond);

// Arguments: smoothed edges, shadows and dark corners.
void BM_IdealImage(benchmark::State& state) {
  const RenderedClip clip(DeskOptions());
  const RayTable rays(clip.camera());
  Renderer::Options options;
  options.smooth_edges = state.range(0) != 0;
  options.shadows = state.range(1) != 0;
  if (!options.shadows) options.occlusion_reach = 0;
  const Renderer renderer(clip.scene(), options);
  const Rigid3 T_world_camera = clip.T_world_camera(kFrame);
  for (auto _ : state)
    benchmark::DoNotOptimize(renderer.Render(rays, T_world_camera, 1).depth.data);
}
BENCHMARK(BM_IdealImage)
    ->Args({0, 0})
    ->Args({1, 0})
    ->Args({0, 1})
    ->Args({1, 1})
    ->Unit(benchmark::kMillisecond);

void BM_SenseColor(benchmark::State& state) {
  const RenderedClip clip(DeskOptions());
  const RayTable rays(clip.camera());
  const IdealImage ideal = clip.Frame(kFrame).ideal;
  FrameMotion motion = {.seed = 1, .frame = kFrame};
  motion.T_world_camera = clip.T_world_camera(kFrame);
  motion.T_world_camera_open = motion.T_world_camera;
  // Smeared over a whole interval between frames: three times the usual exposure.
  motion.T_world_camera_close = clip.T_world_camera(kFrame + 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        SenseColor(ideal, clip.camera(), rays, motion, clip.options().color, 1).data);
  }
}
BENCHMARK(BM_SenseColor)->Unit(benchmark::kMillisecond);

void BM_SenseDepth(benchmark::State& state) {
  const RenderedClip clip(DeskOptions());
  const IdealImage ideal = clip.Frame(kFrame).ideal;
  const FrameMotion motion = {.seed = 1, .frame = kFrame};
  for (auto _ : state) {
    benchmark::DoNotOptimize(SenseDepth(ideal, motion, clip.options().depth, 5000, 1).data);
  }
}
BENCHMARK(BM_SenseDepth)->Unit(benchmark::kMillisecond);

// Argument: 0 colour, 1 depth, 2 labels; encoded as WriteClip does.
void BM_EncodePng(benchmark::State& state) {
  const RenderedFrame frame = RenderedClip(DeskOptions()).Frame(kFrame);
  const cv::Mat images[] = {frame.color, frame.depth_16u, frame.ideal.labels};
  const PngContent content = state.range(0) < 2 ? PngContent::kPhoto : PngContent::kFlat;
  std::string bytes;
  for (auto _ : state) {
    bytes = EncodePng(images[state.range(0)], content);
    benchmark::DoNotOptimize(bytes.data());
  }
  state.counters["kB"] = static_cast<double>(bytes.size()) / 1000;
}
BENCHMARK(BM_EncodePng)->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace semslam

BENCHMARK_MAIN();
