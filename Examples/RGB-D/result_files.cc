// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#include "result_files.h"

#include <functional>

#include "semslam/base/error.h"
#include "semslam/io/map_files.h"

#include "map_view.h"

semslam::Trajectory ToTrajectory(const std::vector<semslam::System::TrackedPose>& poses) {
  semslam::Trajectory trajectory;
  for (const auto& pose : poses) trajectory.push_back({pose.time, pose.T_world_camera});
  return trajectory;
}

std::string WriteResults(const std::filesystem::path& folder,
                         const semslam::System& system,
                         const semslam::PointCloudMapping::Result& map) {
  const std::function<void()> writers[] = {
      [&] {
        semslam::WriteTrajectory(folder / "CameraTrajectory.txt",
                                 ToTrajectory(system.CameraTrajectory()));
      },
      [&] {
        semslam::WriteTrajectory(folder / "KeyFrameTrajectory.txt",
                                 ToTrajectory(system.KeyframeTrajectory()));
      },
      [&] { semslam::WriteMapFiles(folder, MapView(map).view()); },
  };
  std::string first_error;
  for (const auto& write : writers) {
    try {
      write();
    } catch (const semslam::InputError& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  return first_error;
}
