// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/live/device_list.h"

#include <OpenNI.h>

#include "live/openni_context.h"
#include "live/video_modes.h"

namespace semslam {
namespace {

std::vector<OpenNi2Mode> ModesOf(openni::Device& device, openni::SensorType sensor) {
  return device.hasSensor(sensor) ? ToModes(*device.getSensorInfo(sensor))
                                  : std::vector<OpenNi2Mode>();
}

OpenNi2Device Ask(const openni::DeviceInfo& info) {
  OpenNi2Device device;
  device.uri = info.getUri();
  device.vendor = info.getVendor();
  device.name = info.getName();
  openni::Device opened;
  if (opened.open(info.getUri()) != openni::STATUS_OK) {
    device.problem = OpenNiReason();
    return device;
  }
  device.color_modes = ModesOf(opened, openni::SENSOR_COLOR);
  device.depth_modes = ModesOf(opened, openni::SENSOR_DEPTH);
  device.can_register =
      opened.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  return device;
}

}  // namespace

std::vector<OpenNi2Device> ListOpenNi2Devices() {
  const OpenNiContext context;
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<OpenNi2Device> devices;
  for (int i = 0; i < infos.getSize(); ++i) devices.push_back(Ask(infos[i]));
  return devices;
}

}  // namespace semslam
