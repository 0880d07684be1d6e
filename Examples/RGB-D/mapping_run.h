// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <string>

#include "semslam/camera/frame_source.h"
#include "semslam/config/settings.h"

#include "arguments.h"
#include "progress_line.h"
#include "run_loop.h"
#include "run_report.h"

// Everything that does not depend on where the frames come from: maps them, writes the files and
// prints the summary. Returns the exit code: 0, or 2 if tracking was lost too often. Throws
// semslam::InputError; `why_no_frames` says what to tell if there was nothing to map.
int MapFrames(const MappingArguments& arguments,
              const semslam::Settings& settings,
              semslam::FrameSource& source,
              RunOptions options,
              const RunOrigin& origin,
              const std::function<std::string()>& why_no_frames,
              ProgressLine& progress);

// What a main does with its program: the interrupt handler, the threads of OpenCV, and the last
// words of an error, which is exit code 1.
int RunMappingProgram(const char* name, const std::function<int()>& run);

// Shows warnings about the file too.
semslam::Settings LoadSettingsFor(const MappingArguments& arguments, ProgressLine& progress);
