// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string_view>

namespace semslam {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

// The library prints nothing. Classes with something to tell while they run take a sink in their
// options and call it at events (keyframe added, tracking lost), never per frame above kDebug.
// Called from several threads, one at a time.
using LogSink = std::function<void(LogLevel, std::string_view module, std::string_view message)>;

}  // namespace semslam
