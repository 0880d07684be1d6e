// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "baselines.h"

#include <algorithm>
#include <cstdint>
#include <set>

#include "semslam/base/error.h"
#include "semslam/config/settings.h"
#include "semslam/io/tum_dataset.h"
#include "semslam/semantics/label_baselines.h"
#include "semslam/semantics/recorded_detector.h"

namespace {

using semslam::ClassTable;
using semslam::Detection;
using semslam::LabelBaselines;
using semslam::TumDataset;

constexpr std::uint32_t kFirstLabel = 1;  // Of files: class id 0.

// The file's labels of the result are class ids plus one.
std::uint32_t LabelOf(int class_id) {
  return class_id == semslam::kNoClass ? 0 : static_cast<std::uint32_t>(class_id) + kFirstLabel;
}

void CheckClasses(const ClassTable& classes,
                  const semslam::MapResult& result,
                  const BaselineFolders& folders) {
  for (const semslam::ClassRecord& record : result.classes) {
    const std::uint32_t id = record.label - kFirstLabel;
    if (id < classes.size() && classes.name(static_cast<int>(id)) == record.name) continue;
    throw semslam::InputError((folders.detections / "classes.names").string() +
                              ": expected the classes of the result, " + record.name + " in line " +
                              std::to_string(record.label) + ", found others");
  }
}

TumDataset OpenClip(const std::filesystem::path& folder, const semslam::Settings& settings) {
  TumDataset::Options options;
  options.width = settings.camera.width;
  options.height = settings.camera.height;
  options.depth_factor = settings.depth_factor;
  return {folder, folder / "associations.txt", options};
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
  const TumDataset clip = OpenClip(folders.clip, settings);
  for (const auto& pose : semslam::ReadTrajectory(folders.result / "KeyFrameTrajectory.txt")) {
    const semslam::RgbdImage image = clip.Read(EntryAt(clip, pose.time, folders));
    std::vector<Detection> detections = detector.Detect(image);
    std::erase_if(detections, [&](const Detection& detection) {
      return !labels.contains(LabelOf(detection.class_id));
    });
    baselines.AddView({pose.T_world_camera, image.depth, std::move(detections)});
  }
}

std::vector<std::uint32_t> LabelsOf(const std::vector<int>& classes) {
  std::vector<std::uint32_t> labels;
  labels.reserve(classes.size());
  for (const int class_id : classes) labels.push_back(LabelOf(class_id));
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
