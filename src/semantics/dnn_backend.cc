// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/dnn_backend.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr std::array<std::pair<std::string_view, cv::dnn::Backend>, 4> kBackends = {
    {{"opencv", cv::dnn::DNN_BACKEND_OPENCV},
     {"openvino", cv::dnn::DNN_BACKEND_INFERENCE_ENGINE},
     {"cuda", cv::dnn::DNN_BACKEND_CUDA},
     {"vulkan", cv::dnn::DNN_BACKEND_VKCOM}}};
constexpr std::array<std::pair<std::string_view, cv::dnn::Target>, 6> kTargets = {
    {{"cpu", cv::dnn::DNN_TARGET_CPU},
     {"opencl", cv::dnn::DNN_TARGET_OPENCL},
     {"opencl_fp16", cv::dnn::DNN_TARGET_OPENCL_FP16},
     {"cuda", cv::dnn::DNN_TARGET_CUDA},
     {"cuda_fp16", cv::dnn::DNN_TARGET_CUDA_FP16},
     {"vulkan", cv::dnn::DNN_TARGET_VULKAN}}};

template <typename Table>
auto Find(const Table& table, const std::string& what, const std::string& name) {
  std::string known;
  for (const auto& [known_name, value] : table) {
    if (known_name == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(known_name);
  }
  throw InputError("detector: " + what + ": expected one of " + known + ", found '" + name + "'");
}

// "opencv with cpu, cuda with cuda".
std::string Available() {
  std::string available;
  for (const auto& [backend_name, backend] : kBackends) {
    const std::vector<cv::dnn::Target> targets = cv::dnn::getAvailableTargets(backend);
    for (const auto& [target_name, target] : kTargets) {
      if (std::find(targets.begin(), targets.end(), target) == targets.end()) continue;
      available += (available.empty() ? "" : ", ") + std::string(backend_name) + " with " +
                   std::string(target_name);
    }
  }
  return available;
}

}  // namespace

void SelectBackend(cv::dnn::Net& net, const std::string& backend, const std::string& target) {
  const cv::dnn::Backend backend_id = Find(kBackends, "backend", backend);
  const cv::dnn::Target target_id = Find(kTargets, "target", target);
  const std::vector<cv::dnn::Target> targets = cv::dnn::getAvailableTargets(backend_id);
  if (std::find(targets.begin(), targets.end(), target_id) == targets.end()) {
    throw InputError("detector: backend " + backend + " with target " + target +
                     ": this machine's OpenCV has only " + Available());
  }
  net.setPreferableBackend(backend_id);
  net.setPreferableTarget(target_id);
}

}  // namespace semslam
