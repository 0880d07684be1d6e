// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/map/map_archive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "semslam/features/frame_archive.h"
#include "semslam/geometry/rigid3_archive.h"

namespace semslam {
namespace {

constexpr int kMaxLevels = 32;

// What a slot of a keyframe or landmark holds.
enum class SlotKind : std::uint8_t { kNothing, kErased, kKept, kFirst };

SlotKind ReadKind(BinaryReader* reader) {
  const auto kind = reader->Read<std::uint8_t>();
  if (kind > static_cast<std::uint8_t>(SlotKind::kFirst)) {
    reader->Fail("expected a kind of slot, 0 to 3, found " + std::to_string(kind));
  }
  return static_cast<SlotKind>(kind);
}

float ReadFloat(BinaryReader* reader) {
  const auto value = reader->Read<float>();
  if (!std::isfinite(value)) reader->Fail("expected a finite number in a landmark");
  return value;
}

int ReadCounter(BinaryReader* reader) {
  const auto count = reader->Read<std::int32_t>();
  if (count < 0) reader->Fail("expected a number of sightings, found " + std::to_string(count));
  return count;
}

}  // namespace

void MapArchive::Write(const Map& map, BinaryWriter* writer) {
  writer->Write(map.scale_space_.scale_factor);
  writer->Write<std::int32_t>(map.scale_space_.num_levels);
  writer->Write<std::uint64_t>(map.keyframes_.size());
  for (const KeyframeSlot& slot : map.keyframes_) WriteKeyframeSlot(slot, writer);
  writer->Write<std::uint64_t>(map.landmarks_.size());
  for (const Map::LandmarkSlot& slot : map.landmarks_) {
    writer->Write(slot.landmark ? SlotKind::kKept : SlotKind::kNothing);
    if (slot.landmark) WriteLandmark(*slot.landmark, writer);
  }
}

Map MapArchive::Read(BinaryReader* reader,
                     const PinholeCamera::Bounds& camera_bounds,
                     const Vocabulary& vocabulary) {
  ScaleSpace scale_space;
  scale_space.scale_factor = reader->Read<float>();
  scale_space.num_levels = reader->Read<std::int32_t>();
  if (!(scale_space.scale_factor > 1 && scale_space.scale_factor <= 2) ||
      scale_space.num_levels < 1 || scale_space.num_levels > kMaxLevels) {
    reader->Fail("expected an image pyramid, found " + std::to_string(scale_space.num_levels) +
                 " levels of factor " + std::to_string(scale_space.scale_factor));
  }
  Map map(scale_space);
  const std::size_t num_keyframes = reader->ReadCount(1);
  for (std::size_t i = 0; i < num_keyframes; ++i) {
    ReadKeyframeSlot(reader, camera_bounds, vocabulary, &map);
  }
  const std::size_t num_landmarks = reader->ReadCount(1);
  for (std::size_t i = 0; i < num_landmarks; ++i) {
    const SlotKind kind = ReadKind(reader);
    if (kind == SlotKind::kKept) {
      ReadLandmark(reader, &map);
    } else if (kind == SlotKind::kNothing) {
      map.landmarks_.emplace_back();
    } else {
      reader->Fail("expected a landmark or none");
    }
  }
  ++map.version_;
  return map;
}

void MapArchive::WriteKeyframeSlot(const KeyframeSlot& slot, BinaryWriter* writer) {
  if (!slot.keyframe) {
    writer->Write(slot.parent ? SlotKind::kErased : SlotKind::kNothing);
    if (!slot.parent) return;
    writer->Write(slot.parent->value);
    WriteRigid3(slot.T_parent_camera, writer);
    return;
  }
  const Keyframe& keyframe = *slot.keyframe;
  writer->Write(keyframe.parent ? SlotKind::kKept : SlotKind::kFirst);
  if (keyframe.parent) writer->Write(keyframe.parent->value);
  WriteRigid3(keyframe.T_world_camera, writer);
  writer->Write<std::uint8_t>(keyframe.words ? 1 : 0);
  writer->Write<std::uint8_t>(keyframe.starts_piece ? 1 : 0);
  const auto older_end =
      std::lower_bound(keyframe.loop_partners.begin(), keyframe.loop_partners.end(), keyframe.id);
  writer->Write<std::uint64_t>(older_end - keyframe.loop_partners.begin());
  for (auto it = keyframe.loop_partners.begin(); it != older_end; ++it) writer->Write(it->value);
  WriteFrame(*keyframe.frame, writer);
}

// Parents, and the ends of loops that are written, are older: the map holds them already.
KeyframeId MapArchive::ReadOlder(BinaryReader* reader, const Map& map, bool must_be_kept) {
  const KeyframeId parent{reader->ReadIndex(map.keyframes_.size(), "older keyframe")};
  const KeyframeSlot& slot = map.keyframes_[parent.value];
  if (!slot.keyframe && (must_be_kept || !slot.parent)) {
    reader->Fail("keyframe " + std::to_string(parent.value) +
                 " is a parent or the end of a loop, but is not there");
  }
  return parent;
}

void MapArchive::ReadKeyframeSlot(BinaryReader* reader,
                                  const PinholeCamera::Bounds& camera_bounds,
                                  const Vocabulary& vocabulary,
                                  Map* map) {
  const SlotKind kind = ReadKind(reader);
  if (kind == SlotKind::kNothing || kind == SlotKind::kErased) {
    KeyframeSlot slot;
    if (kind == SlotKind::kErased) {
      slot.parent = ReadOlder(reader, *map, false);
      slot.T_parent_camera = ReadRigid3(reader, "pose of an erased keyframe");
    }
    map->keyframes_.push_back(std::move(slot));
    return;
  }
  std::optional<KeyframeId> parent;
  if (kind == SlotKind::kKept) parent = ReadOlder(reader, *map, true);
  const Rigid3 T_world_camera = ReadRigid3(reader, "pose of a keyframe");
  const bool has_words = reader->Read<std::uint8_t>() != 0;
  const bool starts_piece = reader->Read<std::uint8_t>() != 0;
  std::vector<KeyframeId> loop_partners(reader->ReadCount(sizeof(std::uint32_t)));
  for (KeyframeId& partner : loop_partners) partner = ReadOlder(reader, *map, true);
  std::shared_ptr<const Frame> frame =
      ReadFrame(reader, camera_bounds, map->scale_space_.num_levels);
  BagOfWords words;
  if (has_words) words = vocabulary.Transform(frame->descriptors);
  const KeyframeId id = map->AddKeyframe(std::move(frame), T_world_camera);
  if (parent) {
    Keyframe& keyframe = map->MutableKeyframe(id);
    keyframe.parent = parent;
    keyframe.starts_piece = starts_piece;
    map->MoveToPiece(keyframe, map->keyframe(*parent).piece);
  }
  for (const KeyframeId partner : loop_partners) {
    if (map->keyframe(partner).piece != map->keyframe(id).piece) {
      reader->Fail("a loop ties two pieces of the map that were not joined");
    }
    map->TieByLoop(partner, id);
  }
  if (has_words) map->SetWords(id, std::make_shared<const BagOfWords>(std::move(words)));
}

void MapArchive::WriteLandmark(const Landmark& landmark, BinaryWriter* writer) {
  const LandmarkAppearance& appearance = landmark.appearance;
  WriteVector(appearance.p_world, writer);
  for (int i = 0; i < 3; ++i) writer->Write(appearance.view_direction[i]);
  writer->Write(appearance.min_distance);
  writer->Write(appearance.max_distance);
  writer->Write(appearance.descriptor);
  writer->Write(landmark.reference_keyframe.value);
  writer->Write(landmark.first_keyframe.value);
  writer->Write<std::int32_t>(landmark.num_visible);
  writer->Write<std::int32_t>(landmark.num_found);
  writer->Write<std::uint64_t>(landmark.observations.size());
  for (const Observation& observation : landmark.observations) {
    writer->Write(observation.keyframe.value);
    writer->Write(static_cast<std::uint32_t>(observation.feature));
  }
}

void MapArchive::ReadLandmark(BinaryReader* reader, Map* map) {
  auto landmark = std::make_unique<Landmark>();
  landmark->id = LandmarkId{static_cast<std::uint32_t>(map->landmarks_.size())};
  LandmarkAppearance& appearance = landmark->appearance;
  appearance.p_world = ReadVector(reader, "place of a landmark");
  for (int i = 0; i < 3; ++i) appearance.view_direction[i] = ReadFloat(reader);
  appearance.min_distance = ReadFloat(reader);
  appearance.max_distance = ReadFloat(reader);
  appearance.descriptor = reader->Read<Descriptor>();
  const std::size_t num_slots = map->keyframes_.size();
  landmark->reference_keyframe = KeyframeId{reader->ReadIndex(num_slots, "keyframe")};
  landmark->first_keyframe = KeyframeId{reader->ReadIndex(num_slots, "keyframe")};
  landmark->num_visible = ReadCounter(reader);
  landmark->num_found = ReadCounter(reader);
  ReadObservations(reader, map, landmark.get());
  map->landmarks_.push_back({std::move(landmark), std::nullopt});
  ++map->num_landmarks_;
}

void MapArchive::ReadObservations(BinaryReader* reader, Map* map, Landmark* landmark) {
  const std::size_t count = reader->ReadCount(2 * sizeof(std::uint32_t));
  bool has_reference = false;
  for (std::size_t i = 0; i < count; ++i) {
    const KeyframeId id{reader->ReadIndex(map->keyframes_.size(), "keyframe")};
    const Keyframe* keyframe = map->FindKeyframe(id);
    if (keyframe == nullptr) reader->Fail("a landmark is seen by a keyframe that is not there");
    const auto feature =
        static_cast<int>(reader->ReadIndex(keyframe->landmarks.size(), "feature of a keyframe"));
    if (keyframe->landmarks[feature]) reader->Fail("two landmarks are seen as one feature");
    if (i > 0 && !(landmark->observations.back().keyframe < id)) {
      reader->Fail("expected the observations of a landmark in the order of keyframes");
    }
    if (i > 0 && map->keyframe(landmark->observations.back().keyframe).piece != keyframe->piece) {
      reader->Fail("a landmark is seen from two pieces of the map");
    }
    map->Link(*landmark, {id, feature});
    has_reference |= id == landmark->reference_keyframe;
  }
  if (!has_reference) reader->Fail("a landmark is not seen by its own reference keyframe");
}

}  // namespace semslam
