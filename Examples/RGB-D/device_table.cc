// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "device_table.h"

#include <cstdio>
#include <vector>

#include "semslam/base/error.h"
#include "semslam/live/device_list.h"

#include "printable.h"

namespace {

void PrintModes(const char* stream, const std::vector<semslam::OpenNi2Mode>& modes) {
  std::printf("  %s:\n", stream);
  if (modes.empty()) std::printf("    none\n");
  for (const semslam::OpenNi2Mode& mode : modes) {
    std::printf("    %4dx%-4d  %3d/s  %s\n", mode.width, mode.height, mode.fps,
                mode.format.c_str());
  }
}

}  // namespace

void PrintDevices() {
  const std::vector<semslam::OpenNi2Device> devices = semslam::ListOpenNi2Devices();
  if (devices.empty()) throw semslam::InputError(semslam::kNoCameraFound);
  for (const semslam::OpenNi2Device& device : devices) {
    std::printf("%s  %s %s\n", Printable(device.uri).c_str(), Printable(device.vendor).c_str(),
                Printable(device.name).c_str());
    if (!device.problem.empty()) {
      std::printf("  cannot be opened: %s\n", Printable(device.problem).c_str());
      continue;
    }
    std::printf("  registers depth to colour: %s\n", device.can_register ? "yes" : "no");
    PrintModes("colour", device.color_modes);
    PrintModes("depth", device.depth_modes);
  }
}
