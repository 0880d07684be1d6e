// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <vector>

#include "semslam/eval/clip_truth.h"
#include "semslam/eval/map_evaluation.h"

#include "baselines.h"

// The measures as a table for people, and as JSON for programs (null where a share is of nothing).
std::string MapTable(const semslam::MapEvaluation& evaluation,
                     const semslam::ClipTruth& truth,
                     const std::vector<Baseline>& baselines);
std::string MapJson(const semslam::MapEvaluation& evaluation,
                    const semslam::ClipTruth& truth,
                    const std::vector<Baseline>& baselines);
