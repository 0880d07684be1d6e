// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace semslam {

// A network that OpenCV runs, and what is taken from its output.
struct NetworkOptions {
  std::filesystem::path config;   // Darknet's .cfg, or an .onnx file,
  std::filesystem::path weights;  // and Darknet's .weights; ONNX has none.
  // Pixels, a multiple of 32; 0: as the cfg or the .onnx file says, 640 if that leaves it open.
  int input_size = 0;
  // Images that wait are looked at together, up to so many. A graphics card is quicker that way; on
  // two cores it gains nothing.
  int batch_size = 1;
  bool letterbox = true;          // The image keeps its proportions and gets a grey border; else it
                                  // is stretched to fill the input.
  float score_threshold = 0.25F;  // Detections with a lower best score are left out.
  float nms_threshold = 0.45F;    // Overlap above which the weaker of one class is dropped.
  // Class scores below this are cut to 0; the rest form the detection's class distribution.
  float min_class_score = 0.02F;
  // What computes: backend opencv, openvino, cuda or vulkan; target cpu, opencl, opencl_fp16, cuda,
  // cuda_fp16 or vulkan. Which of these there are depends on how OpenCV was built (Debian: opencv
  // with cpu, and with opencl where there is a device).
  std::string backend = "opencv";
  std::string target = "cpu";
  void Validate() const;  // Throws InputError.
};

}  // namespace semslam
