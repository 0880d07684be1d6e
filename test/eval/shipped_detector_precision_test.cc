// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
// The network in config/detector on desks that it was not trained on.
#include <filesystem>

#include <gtest/gtest.h>

#include "semslam/eval/detection_score.h"
#include "semslam/render/clip.h"
#include "semslam/semantics/network_detector.h"

namespace semslam {
namespace {

NetworkDetector Shipped() {
  const std::filesystem::path folder =
      std::filesystem::path(SEMSLAM_SOURCE_DIR) / "config" / "detector";
  NetworkDetector::Options options;
  options.config = folder / "desk.cfg";
  options.weights = folder / "desk.weights";
  options.score_threshold = 0.02F;
  return {options, ClassTable::FromFile(folder / "desk.names")};
}

std::vector<InstanceRecord> RecordsOf(const std::vector<Instance>& instances) {
  std::vector<InstanceRecord> records;
  records.reserve(instances.size());
  for (const Instance& instance : instances)
    records.push_back({instance.id, instance.class_name, instance.box});
  return records;
}

// A few views along the path of a random desk.
void LookAt(std::uint64_t seed, NetworkDetector& detector, std::vector<ScoredPicture>& pictures) {
  RenderedClip::Options options;
  options.scene = "random";
  options.seed = seed;
  options.num_frames = 3;
  options.fps = 0.25;
  const RenderedClip clip(options);
  const std::vector<InstanceRecord> instances = RecordsOf(clip.instances());
  for (std::size_t i = 0; i < clip.num_frames(); ++i) {
    const RenderedFrame frame = clip.Frame(i);
    pictures.push_back({FindTrueBoxes(frame.ideal.labels, instances, detector.classes(),
                                      frame.T_world_camera, clip.camera()),
                        detector.Detect({frame.time, frame.color, {}})});
  }
}

TEST(ShippedDetector, FindsTheObjectsOfDesksItHasNotSeen) {
  NetworkDetector detector = Shipped();
  std::vector<ScoredPicture> pictures;
  for (const std::uint64_t seed : {510, 511, 512}) LookAt(seed, detector, pictures);
  const DetectionScore score = ScoreDetections(pictures, detector.classes().size());
  EXPECT_GE(score.MeanAveragePrecision(), 0.8);
}

}  // namespace
}  // namespace semslam
