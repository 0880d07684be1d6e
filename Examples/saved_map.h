// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <memory>

#include "semslam/config/settings.h"
#include "semslam/pipeline/system.h"
#include "semslam/place/vocabulary.h"

// A vocabulary for those who look for nothing in a map: two words that tell nothing.
inline std::shared_ptr<const semslam::Vocabulary> NoWords() {
  using Node = semslam::Vocabulary::Node;
  return std::make_shared<const semslam::Vocabulary>(
      2, 1,
      std::vector<Node>{{.first_child = 1, .num_children = 2},
                        {.first_child = 0, .num_children = 0},
                        {.first_child = 1, .num_children = 0}},
      std::vector<semslam::Descriptor>(3));
}

// What --save-map wrote, with the settings of the run that saved it, to be looked at. Throws
// semslam::InputError.
inline std::unique_ptr<semslam::System> OpenSavedMap(const std::filesystem::path& path,
                                                     const semslam::Settings& settings) {
  auto system = std::make_unique<semslam::System>(
      settings, NoWords(),
      semslam::System::Options{
          .threading = semslam::Threading::kInline, .detector = nullptr, .log = {}});
  system->LoadMap(path);
  return system;
}
