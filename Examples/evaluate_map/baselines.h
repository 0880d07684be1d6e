// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semslam/eval/clip_truth.h"
#include "semslam/eval/map_evaluation.h"

// The labels that a simpler way than fusion gives the points of a map.
struct Baseline {
  std::string name;
  semslam::LabelEvaluation evaluation;
};

struct BaselineFolders {
  std::filesystem::path clip;
  std::filesystem::path result;
  std::filesystem::path detections;
};

// Brings the detections onto the result's points, seen from its keyframes. Classes that the result
// leaves out are left out here too. Throws semslam::InputError.
std::vector<Baseline> EvaluateBaselines(const BaselineFolders& folders,
                                        const semslam::ClipTruth& truth,
                                        const semslam::MapResult& result,
                                        const semslam::MapEvaluation& evaluation,
                                        const semslam::MapEvaluationOptions& options);
