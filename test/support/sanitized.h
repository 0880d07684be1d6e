// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace semslam::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// How often to try what must hold for every seed: sanitizers look for errors of memory, which a few
// seeds show as well as many, at a tenth of the speed.
constexpr int NumTrials(int trials) { return kSanitized && trials > 10 ? trials / 5 : trials; }

}  // namespace semslam::testing
