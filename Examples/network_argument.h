// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "semslam/base/error.h"
#include "semslam/semantics/network_options.h"

// What --network says: CFG WEIGHTS NAMES of Darknet, or FILE.onnx NAMES. Sets the files of the
// options and returns that of the names. Throws semslam::InputError for anything else.
inline std::filesystem::path TakeNetwork(const std::vector<std::string>& network,
                                         semslam::NetworkOptions& options) {
  options.config = network.empty() ? "" : network.front();
  const std::size_t num_files = options.config.extension() == ".onnx" ? 2 : 3;
  if (network.size() != num_files) {
    throw semslam::InputError("--network: expected CFG WEIGHTS NAMES or FILE.onnx NAMES, found " +
                              std::to_string(network.size()) + " files (--help shows the usage)");
  }
  options.weights = num_files == 3 ? network[1] : "";
  return network.back();
}
