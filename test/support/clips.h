// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace semslam::testing {

// The folder of a real clip (fr1_xyz_160, fr1_desk_80), in $SEMSLAM_CLIPS or beside the repository.
// Empty where it is not at hand, and then a test skips:
//   const std::filesystem::path clip = testing::FindClip("fr1_xyz_160");
//   if (clip.empty()) GTEST_SKIP() << testing::kHowToGetClips;
// With SEMSLAM_REQUIRE_CLIPS set, as in CI, a missing clip fails the test.
inline constexpr char kHowToGetClips[] =
    "no clip: scripts/get_tum.sh --clips brings them; set SEMSLAM_CLIPS to their folder";

inline std::filesystem::path FindClip(const std::string& name) {
  // Tests read the environment before they start any thread.
  const char* const variable = std::getenv("SEMSLAM_CLIPS");  // NOLINT(concurrency-mt-unsafe)
  const std::filesystem::path clip =
      std::filesystem::path(variable != nullptr ? variable
                                                : SEMSLAM_SOURCE_DIR "/../shared/data/clips") /
      name;
  if (std::filesystem::is_directory(clip)) return clip;
  const bool required =
      std::getenv("SEMSLAM_REQUIRE_CLIPS") != nullptr;  // NOLINT(concurrency-mt-unsafe)
  if (required) ADD_FAILURE() << clip << " is not there, and SEMSLAM_REQUIRE_CLIPS is set";
  return {};
}

}  // namespace semslam::testing
