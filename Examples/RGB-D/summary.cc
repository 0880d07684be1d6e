// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "summary.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "memory_use.h"
#include "printable.h"
#include "quantile.h"

namespace {

// "2 cup, 1 keyboard".
std::string CountClasses(const semslam::SemanticMap& map) {
  std::map<std::string, int> counts;
  for (const semslam::SemanticObject& object : map.objects)
    ++counts[map.classes.name(object.class_id)];
  std::string text;
  for (const auto& [name, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + name;
  }
  return text;
}

void PrintSemantics(const semslam::System& system, const semslam::PointCloudMapping::Result& map) {
  if (!system.has_detector()) {
    std::printf("objects               no detector was given: geometry and segments only\n");
    return;
  }
  const semslam::DetectorThread::Statistics detector = system.detector_statistics();
  const std::string classes = CountClasses(map.semantics);
  std::printf("objects               %zu%s%s\n", map.semantics.objects.size(),
              classes.empty() ? "" : ": ", classes.c_str());
  std::printf("images labelled       %zu of %zu keyframes, %.1f ms each, at most %zu waited\n",
              detector.num_done, detector.num_submitted, detector.mean_milliseconds,
              detector.longest_queue);
  std::printf(
      "labels fused          in %.0f ms, %.1f ms a keyframe\n", map.fusion_milliseconds,
      map.fusion_milliseconds / static_cast<double>(std::max<std::size_t>(1, detector.num_done)));
  if (detector.num_failed > 0) {
    std::printf("images not labelled   %zu: %s\n", detector.num_failed,
                Printable(detector.first_error).c_str());
  }
}

}  // namespace

void PrintSummary(const RunStatistics& run,
                  const semslam::System& system,
                  const semslam::PointCloudMapping::Result& map,
                  const std::filesystem::path& output) {
  const semslam::System::Status status = system.status();
  std::printf("frames                %zu tracked, %zu lost, %zu unreadable, in %.1f s%s\n",
              run.num_tracked, run.num_lost(), run.num_unreadable, run.seconds,
              run.interrupted ? " (interrupted)" : "");
  if (run.num_left_out > 0)
    std::printf(
        "left out              %zu frames, in pieces of the map that did not meet the rest\n",
        run.num_left_out);
  if (run.num_late)
    std::printf("late by over a frame  %zu of %zu frames\n", *run.num_late, run.num_frames);
  if (run.live) {
    const LiveStatistics& live = *run.live;
    std::printf("dropped               %zu of %zu images came while another was tracked\n",
                live.num_dropped, live.num_dropped + run.num_frames);
    std::printf("frame to pose         median %.1f ms, p95 %.1f ms\n",
                Quantile(live.latency_milliseconds, 0.5),
                Quantile(live.latency_milliseconds, 0.95));
  }
  std::printf("tracking time         median %.1f ms, p95 %.1f ms\n",
              Quantile(run.tracking_milliseconds, 0.5), Quantile(run.tracking_milliseconds, 0.95));
  std::printf("rolling shutter       %.1f ms\n", 1e3 * status.readout_seconds);
  std::printf("keyframes             %zu\n", status.num_keyframes);
  std::printf("landmarks             %zu\n", status.num_landmarks);
  std::printf("loops closed          %zu\n", status.num_loops);
  if (status.num_joins > 0)
    std::printf("pieces joined         %zu, begun after losses in new places\n", status.num_joins);
  if (status.num_relocalizations > 0)
    std::printf("place found again     %zu times after a loss\n", status.num_relocalizations);
  std::printf("map points            %zu, %.1f ms a keyframe\n", map.cloud.size(),
              map.integration_milliseconds);
  std::printf("segments              %zu, in %.0f ms\n", map.segmentation.segments.size(),
              map.segmentation_milliseconds);
  if (map.live.num_keyframes > 0) {
    std::printf(
        "live segments         %zu, %.1f ms a keyframe (%.1f in the first half, %.1f in the "
        "second, %.1f at most)\n",
        map.live.num_segments, map.live.mean_milliseconds, map.live.first_half_milliseconds,
        map.live.second_half_milliseconds, map.live.max_milliseconds);
  }
  PrintSemantics(system, map);
  std::printf("peak memory           %.0f MB\n", PeakMegabytes());
  std::printf("files                 %s\n",
              std::filesystem::absolute(output).lexically_normal().c_str());
}
