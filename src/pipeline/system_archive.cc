// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// System's map files.
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/geometry/rigid3_archive.h"
#include "semslam/map/map_archive.h"
#include "semslam/pipeline/system.h"

#include "pipeline/map_file.h"

namespace semslam {
namespace {

struct NamedNumber {
  const char* name;
  double value;
};

// What must be the same in the run that saves and in the run that loads.
std::array<NamedNumber, 14> Fingerprint(const PinholeCamera& camera,
                                        double bf,
                                        const ScaleSpace& scale_space) {
  const PinholeCamera::Parameters& p = camera.parameters();
  return {{{"Camera.width", static_cast<double>(p.width)},
           {"Camera.height", static_cast<double>(p.height)},
           {"Camera.fx", p.fx},
           {"Camera.fy", p.fy},
           {"Camera.cx", p.cx},
           {"Camera.cy", p.cy},
           {"Camera.k1", p.k1},
           {"Camera.k2", p.k2},
           {"Camera.p1", p.p1},
           {"Camera.p2", p.p2},
           {"Camera.k3", p.k3},
           {"Camera.bf", bf},
           {"ORBextractor.scaleFactor", scale_space.scale_factor},
           {"ORBextractor.nLevels", static_cast<double>(scale_space.num_levels)}}};
}

void CheckFingerprint(const std::array<NamedNumber, 14>& settings, BinaryReader* reader) {
  for (const NamedNumber& expected : settings) {
    const double found = reader->ReadNumber(expected.name);
    if (found == expected.value) continue;
    reader->Fail(std::string(expected.name) + " of the map is " + std::to_string(found) +
                 ", of the settings " + std::to_string(expected.value) + ": expected the same");
  }
}

}  // namespace

void System::SaveMap(const std::filesystem::path& path) const {
  SEMSLAM_CHECK(is_shut_down_) << "a map is saved after Shutdown";
  BinaryWriter writer;
  writer.WriteText(settings_text_);
  map_.Read([&](const Map& map) {
    for (const NamedNumber& number : Fingerprint(camera_, stereo_.bf, map.scale_space()))
      writer.Write(number.value);
    MapArchive::Write(map, &writer);
  });
  WriteTrajectory(&writer);
  point_cloud_mapping_.Write(&writer);
  WriteMapFile(path, writer.bytes());
}

void System::LoadMap(const std::filesystem::path& path) {
  SEMSLAM_CHECK(!last_time_) << "a map is loaded before the first frame";
  const OpenMapFile file(path);
  BinaryReader reader(file.content(), path.string());
  reader.ReadText();  // The settings that made it, for those who have no others.
  const ScaleSpace scale_space = map_.Read([](const Map& map) { return map.scale_space(); });
  CheckFingerprint(Fingerprint(camera_, stereo_.bf, scale_space), &reader);
  Map loaded = MapArchive::Read(&reader, camera_.ideal_bounds(), *vocabulary_);
  map_.Write([&](Map& map) { map = std::move(loaded); });
  ReadTrajectory(&reader);
  if (!point_cloud_mapping_.Restore(&reader)) {
    Log(LogLevel::kWarning,
        path.string() + ": its labels are dropped, for its classes are not the detector's");
  }
  if (!reader.is_at_end()) reader.Fail("expected the end of the map");
  tracking_.StartInLoadedMap();
}

Settings System::ReadMapSettings(const std::filesystem::path& path) {
  const OpenMapFile file(path);
  BinaryReader reader(file.content(), path.string());
  std::string text = reader.ReadText();
  if (text.empty()) throw InputError(path.string() + ": was made without a settings file");
  return ParseSettings(path, std::move(text));
}

void System::WriteTrajectory(BinaryWriter* writer) const {
  trajectory_.Read([&](const std::vector<TrajectoryEntry>& entries) {
    writer->Write<std::uint64_t>(entries.size());
    for (const TrajectoryEntry& entry : entries) {
      writer->Write(entry.time);
      writer->Write(entry.reference.value);
      WriteRigid3(entry.T_reference_camera, writer);
    }
  });
}

void System::ReadTrajectory(BinaryReader* reader) {
  constexpr std::size_t kBytesPerEntry = sizeof(TimeNs) + sizeof(std::uint32_t);
  std::vector<TrajectoryEntry> entries(reader->ReadCount(kBytesPerEntry));
  for (TrajectoryEntry& entry : entries) {
    entry.time = reader->Read<TimeNs>();
    entry.reference = KeyframeId{reader->Read<std::uint32_t>()};
    entry.T_reference_camera = ReadRigid3(reader, "pose of a frame");
  }
  trajectory_.Write([&](std::vector<TrajectoryEntry>& loaded) { loaded = std::move(entries); });
  trajectory_is_loaded_ = true;
}

}  // namespace semslam
