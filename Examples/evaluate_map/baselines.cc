// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "baselines.h"

#include <algorithm>
#include <cstdint>
#include <set>

#include "semslam/base/error.h"
#include "semslam/semantics/label_baselines.h"
#include "semslam/semantics/recorded_detector.h"

#include "open_sequence.h"

namespace {

using semslam::ClassTable;
using semslam::Detection;
using semslam::LabelBaselines;
using semslam::TumDataset;

void CheckClasses(const ClassTable& classes,
                  const semslam::MapResult& result,
                  const BaselineFolders& folders) {
  for (const semslam::ClassRecord& record : result.classes) {
    const std::uint32_t id = record.label - semslam::LabelOfClass(0);
    if (id < classes.size() && classes.name(static_cast<int>(id)) == record.name) continue;
    throw semslam::InputError((folders.detections / "classes.names").string() +
                              ": expected the classes of the result, " + record.name + " in line " +
                              std::to_string(record.label) + ", found others");
  }
}

const TumDataset::Entry& EntryAt(const TumDataset& clip,
                                 semslam::TimeNs time,
                                 const BaselineFolders& folders) {
  const auto entry =
      std::lower_bound(clip.entries().begin(), clip.entries().end(), time,
                       [](const auto& candidate, auto t) { return candidate.color_time < t; });
  if (entry == clip.entries().end() || entry->color_time != time) {
    throw semslam::InputError((folders.result / "KeyFrameTrajectory.txt").string() +
                              ": expected times of the clip's images, found " +
                              semslam::FormatTime(time));
  }
  return *entry;
}

void AddViews(const BaselineFolders& folders,
              const semslam::Settings& settings,
              const std::set<std::uint32_t>& labels,
              semslam::RecordedDetector& detector,
              LabelBaselines& baselines) {
  const TumDataset clip = OpenSequence(folders.clip, folders.clip / "associations.txt", settings);
  for (const auto& pose : semslam::ReadTrajectory(folders.result / "KeyFrameTrajectory.txt")) {
    const semslam::RgbdImage image = clip.Read(EntryAt(clip, pose.time, folders));
    std::vector<Detection> detections = detector.Detect(image);
    std::erase_if(detections, [&](const Detection& detection) {
      return !labels.contains(semslam::LabelOfClass(detection.class_id));
    });
    baselines.AddView({pose.T_world_camera, image.depth, std::move(detections)});
  }
}

std::vector<std::uint32_t> LabelsOf(const std::vector<int>& classes) {
  std::vector<std::uint32_t> labels;
  labels.reserve(classes.size());
  for (const int class_id : classes) labels.push_back(semslam::LabelOfClass(class_id));
  return labels;
}

}  // namespace

std::vector<Baseline> EvaluateBaselines(const BaselineFolders& folders,
                                        const semslam::ClipTruth& truth,
                                        const semslam::MapResult& result,
                                        const semslam::MapEvaluation& evaluation,
                                        const semslam::MapEvaluationOptions& options) {
  const semslam::Settings settings = semslam::LoadSettings(folders.clip / "settings.yaml");
  const ClassTable classes = ClassTable::FromFile(folders.detections / "classes.names");
  CheckClasses(classes, result, folders);
  std::set<std::uint32_t> labels;
  for (const semslam::ClassRecord& record : result.classes) labels.insert(record.label);
  semslam::RecordedDetector detector({.folder = folders.detections}, classes);
  LabelBaselines baselines(result.positions, semslam::PinholeCamera(settings.camera),
                           classes.size(), {});
  AddViews(folders, settings, labels, detector, baselines);
  const auto evaluate = [&](const char* name, const std::vector<int>& classes_of_points) {
    return Baseline{name, semslam::EvaluateLabels(truth, result, LabelsOf(classes_of_points),
                                                  evaluation, options)};
  };
  return {evaluate("painted boxes", baselines.Painted()),
          evaluate("votes by point", baselines.PointVotes()),
          evaluate("votes by segment", baselines.SegmentVotes(result.segments))};
}
