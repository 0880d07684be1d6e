// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <opencv2/dnn.hpp>

namespace semslam {

// Has the network computed by a backend on a target; names as in NetworkOptions. Throws InputError
// for names that are not known, and where this OpenCV cannot do it (it would fall back in silence).
void SelectBackend(cv::dnn::Net& net, const std::string& backend, const std::string& target);

}  // namespace semslam
