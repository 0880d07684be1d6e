// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "semslam/base/binary_stream.h"
#include "semslam/camera/pinhole_camera.h"
#include "semslam/map/map.h"
#include "semslam/place/vocabulary.h"

namespace semslam {

// The sparse map as bytes. Ids, poses and everything else come back as they were, to the bit; only
// who a merged landmark became is forgotten. Visual words are not written: the vocabulary that
// reads may be another one.
class MapArchive {
 public:
  static void Write(const Map& map, BinaryWriter* writer);

  // Throws InputError if the bytes are no map, also if their cross-references do not fit.
  static Map Read(BinaryReader* reader,
                  const PinholeCamera::Bounds& camera_bounds,
                  const Vocabulary& vocabulary);

 private:
  using KeyframeSlot = Map::KeyframeSlot;

  static void WriteKeyframeSlot(const KeyframeSlot& slot, BinaryWriter* writer);
  static void ReadKeyframeSlot(BinaryReader* reader,
                               const PinholeCamera::Bounds& camera_bounds,
                               const Vocabulary& vocabulary,
                               Map* map);
  static KeyframeId ReadOlder(BinaryReader* reader, const Map& map, bool must_be_kept);
  static void WriteLandmark(const Landmark& landmark, BinaryWriter* writer);
  static void ReadLandmark(BinaryReader* reader, Map* map);
  static void ReadObservations(BinaryReader* reader, Map* map, Landmark* landmark);
};

}  // namespace semslam
