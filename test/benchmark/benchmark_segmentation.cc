// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's table 1 on this machine: time and memory of this project's segmentation, and of PCL's
// LCCP and region growing, on clouds of several sizes. The clouds are made: the true surface of a
// rendered room or desk, roughened like a map, cut to size about its middle, and repeated where it
// is too small. Each measurement runs in a process of its own, so that its peak memory is its own.
//   benchmark_segmentation [room | desk] [--steps] [millions of points ...]
//     --steps   instead, the time of each step of ours, the least of seven runs, on one thread and
//               on all cores
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "semslam/base/random.h"
#include "semslam/base/stopwatch.h"
#include "semslam/render/clip.h"
#include "semslam/segmentation/segmenter.h"

#include "pcl_methods.h"
#include "render/true_surface.h"

namespace {

using semslam::PointCloudView;

struct Cloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
};

struct Measurement {
  double milliseconds = 0;
  double cpu_milliseconds = 0;  // Of all threads: tells more on a busy machine.
  double peak_bytes = 0;        // Above what the process had before, the cloud among it.
  double num_segments = 0;
};

Cloud MakeScene(const std::string& name) {
  constexpr double kRoomSpacing = 0.005;  // Metres; a desk is smaller.
  constexpr double kDeskSpacing = 0.002;
  constexpr float kNoise = 0.0015F;  // Metres.
  semslam::RenderedClip::Options options;
  options.scene = name;
  options.num_frames = 60;
  options.fps = 4;
  const semslam::TrueSurface surface = semslam::SampleTrueSurface(
      semslam::RenderedClip(options), name == "desk" ? kDeskSpacing : kRoomSpacing);
  semslam::Random random(1);
  Cloud cloud;
  cloud.normals = surface.normals;
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    cloud.points.push_back(surface.positions[i] +
                           kNoise * static_cast<float>(random.Gaussian()) * surface.normals[i]);
  }
  return cloud;
}

// The scene, made in a process that ends with it: threads of a pool do not live on in children, and
// the parent, which the measurements are children of, must have none.
Cloud MakeSceneAside(const std::string& name) {
  std::FILE* const file = std::tmpfile();
  if (file == nullptr) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    const Cloud room = MakeScene(name);
    std::fwrite(room.points.data(), sizeof(Eigen::Vector3f), room.points.size(), file);
    std::fwrite(room.normals.data(), sizeof(Eigen::Vector3f), room.normals.size(), file);
    std::fflush(file);
    ::_exit(EXIT_SUCCESS);
  }
  ::waitpid(child, nullptr, 0);
  std::fseek(file, 0, SEEK_END);
  const auto num_points =
      static_cast<std::size_t>(std::ftell(file)) / (2 * sizeof(Eigen::Vector3f));
  std::rewind(file);
  Cloud room = {std::vector<Eigen::Vector3f>(num_points), std::vector<Eigen::Vector3f>(num_points)};
  const std::size_t num_read =
      std::fread(room.points.data(), sizeof(Eigen::Vector3f), num_points, file) +
      std::fread(room.normals.data(), sizeof(Eigen::Vector3f), num_points, file);
  std::fclose(file);
  return num_read == 2 * num_points ? room : Cloud();
}

// Copies of the room side by side until there are enough points, then those nearest to the middle.
Cloud CutToSize(const Cloud& room, std::size_t num_points) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : room.points) box.extend(point);
  const float width = box.sizes().x() + 0.5F;
  Cloud whole;
  for (int copy = 0; whole.points.size() < num_points; ++copy) {
    const Eigen::Vector3f shift(width * static_cast<float>(copy), 0, 0);
    for (const Eigen::Vector3f& point : room.points) whole.points.push_back(point + shift);
    whole.normals.insert(whole.normals.end(), room.normals.begin(), room.normals.end());
  }
  const Eigen::Vector3f middle = box.center();
  std::vector<std::size_t> order(whole.points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(num_points) - 1,
                   order.end(), [&](std::size_t a, std::size_t b) {
                     return (whole.points[a] - middle).squaredNorm() <
                            (whole.points[b] - middle).squaredNorm();
                   });
  order.resize(num_points);
  std::sort(order.begin(), order.end());
  Cloud cloud;
  for (const std::size_t i : order) {
    cloud.points.push_back(whole.points[i]);
    cloud.normals.push_back(whole.normals[i]);
  }
  return cloud;
}

double ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0;
  double resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

double CpuMilliseconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto milliseconds = [](const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
  };
  return milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
}

double PeakBytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

// What `function` returns, numbers without pointers, from a process of its own. If that crashes:
// zeros.
template <typename Function>
auto RunAside(const Function& function) {
  ::malloc_trim(0);  // What is free but kept would hide what the method takes.
  decltype(function()) result{};
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) return result;
  const pid_t child = ::fork();
  if (child == 0) {
    result = function();
    const bool is_written = ::write(pipe[1], &result, sizeof(result)) == ssize_t{sizeof(result)};
    ::_exit(is_written ? EXIT_SUCCESS : EXIT_FAILURE);
  }
  ::close(pipe[1]);
  if (::read(pipe[0], &result, sizeof(result)) != ssize_t{sizeof(result)}) result = {};
  ::close(pipe[0]);
  ::waitpid(child, nullptr, 0);
  return result;
}

// Runs `segment`, which gives the number of segments, in a process of its own.
template <typename Function>
Measurement Measure(const Function& segment) {
  return RunAside([&] {
    Measurement measurement;
    const double before = ResidentBytes();
    const semslam::Stopwatch watch;
    measurement.num_segments = static_cast<double>(segment());
    measurement.cpu_milliseconds = CpuMilliseconds();
    measurement.milliseconds = watch.Milliseconds();
    measurement.peak_bytes = PeakBytes() - before;
    return measurement;
  });
}

void PrintRow(const char* method, std::size_t num_points, const Measurement& m, double ours) {
  const auto points = static_cast<double>(num_points);
  std::printf("%9zu  %-15s %9.0f %9.0f %9.3f %12.0f %9.0f", num_points, method, m.milliseconds,
              m.cpu_milliseconds, 1e3 * m.milliseconds / points, m.peak_bytes / points,
              m.num_segments);
  std::printf(ours > 0 ? " %9.1f x\n" : "\n", m.milliseconds / ours);
  std::fflush(stdout);
}

void Compare(const Cloud& cloud) {
  const PointCloudView view = {cloud.points, cloud.normals};
  const std::size_t num_points = cloud.points.size();
  const Measurement ours = Measure([&] {
    return semslam::Segmenter(semslam::Segmenter::Options()).Segment(view).segments.size();
  });
  PrintRow("graph (ours)", num_points, ours, 0);
  PrintRow("lccp", num_points, Measure([&] { return SegmentWithLccp(view).num_segments; }),
           ours.milliseconds);
  PrintRow("region growing", num_points,
           Measure([&] { return SegmentWithRegionGrowing(view).num_segments; }), ours.milliseconds);
}

using semslam::SegmentationTimes;

struct Step {
  const char* name;
  double SegmentationTimes::*time;
};
constexpr std::array<Step, 10> kSteps = {{{"voxels", &SegmentationTimes::voxels},
                                          {"normals", &SegmentationTimes::normals},
                                          {"supervoxels", &SegmentationTimes::supervoxels},
                                          {"patches", &SegmentationTimes::patches},
                                          {"planes", &SegmentationTimes::planes},
                                          {"selection", &SegmentationTimes::selection},
                                          {"assignment", &SegmentationTimes::assignment},
                                          {"relief", &SegmentationTimes::relief},
                                          {"components", &SegmentationTimes::components},
                                          {"summary", &SegmentationTimes::summary}}};

// The least of several runs, step by step.
SegmentationTimes LeastTimes(const Cloud& cloud, int num_threads) {
  constexpr int kNumRuns = 7;
  SegmentationTimes least;
  for (int run = 0; run < kNumRuns; ++run) {
    const SegmentationTimes times = RunAside([&] {
      semslam::Segmenter::Options options;
      options.num_threads = num_threads;
      return semslam::Segmenter(options).Segment({cloud.points, cloud.normals}).times;
    });
    for (const Step& step : kSteps) {
      const double time = times.*step.time;
      least.*step.time = run == 0 ? time : std::min(least.*step.time, time);
    }
  }
  return least;
}

void CompareSteps(const Cloud& cloud) {
  const SegmentationTimes serial = LeastTimes(cloud, 1);
  const SegmentationTimes parallel = LeastTimes(cloud, 0);
  std::printf("%zu points\n%-12s %14s %14s\n", cloud.points.size(), "step", "ms, one thread",
              "ms, all cores");
  for (const Step& step : kSteps) {
    std::printf("%-12s %14.1f %14.1f\n", step.name, serial.*step.time, parallel.*step.time);
  }
  std::printf("%-12s %14.1f %14.1f\n", "all", serial.Total(), parallel.Total());
  std::fflush(stdout);
}

void PrintHeader(const std::string& scene, std::size_t num_points, bool only_steps) {
  std::printf("a %s of %zu points\n", scene.c_str(), num_points);
  if (only_steps) return;
  std::printf("%9s  %-15s %9s %9s %9s %12s %9s %11s\n", "points", "method", "ms", "cpu ms",
              "us/point", "bytes/point", "segments", "to ours");
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  std::string scene = "room";
  if (!arguments.empty() && (arguments[0] == "room" || arguments[0] == "desk")) {
    scene = arguments[0];
    arguments.erase(arguments.begin());
  }
  const bool only_steps = !arguments.empty() && arguments[0] == "--steps";
  if (only_steps) arguments.erase(arguments.begin());
  if (arguments.empty()) arguments = {"0.1", "0.3", "0.952563", "3"};
  const Cloud whole = MakeSceneAside(scene);
  if (whole.points.empty()) {
    std::cerr << "benchmark_segmentation: the scene could not be made\n";
    return EXIT_FAILURE;
  }
  PrintHeader(scene, whole.points.size(), only_steps);
  for (const std::string& argument : arguments) {
    const double millions = std::atof(argument.c_str());
    if (!(millions > 0)) {
      std::cerr
          << "benchmark_segmentation: expected room or desk, --steps, then millions of points, "
          << "found " << argument << '\n';
      return EXIT_FAILURE;
    }
    const Cloud cloud = CutToSize(whole, static_cast<std::size_t>(1e6 * millions));
    only_steps ? CompareSteps(cloud) : Compare(cloud);
  }
  return EXIT_SUCCESS;
}
