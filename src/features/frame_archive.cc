// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/features/frame_archive.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace semslam {
namespace {

constexpr std::size_t kNumFloats = 8;
constexpr std::size_t kBytesPerKeypoint = kNumFloats * sizeof(float) + sizeof(std::int16_t);

void WriteKeypoint(const Keypoint& keypoint, BinaryWriter* writer) {
  for (const float value :
       {keypoint.pixel.x(), keypoint.pixel.y(), keypoint.raw_pixel.x(), keypoint.raw_pixel.y(),
        keypoint.depth, keypoint.right_x, keypoint.angle, keypoint.response}) {
    writer->Write(value);
  }
  writer->Write(keypoint.octave);
}

Keypoint ReadKeypoint(BinaryReader* reader, int num_levels) {
  std::array<float, kNumFloats> v{};
  for (float& value : v) {
    value = reader->Read<float>();
    if (!std::isfinite(value)) reader->Fail("expected a finite number in a keypoint");
  }
  Keypoint keypoint{.pixel = {v[0], v[1]},
                    .raw_pixel = {v[2], v[3]},
                    .depth = v[4],
                    .right_x = v[4] > 0 ? v[5] : kNoRightX,
                    .angle = v[6],
                    .octave = reader->Read<std::int16_t>(),
                    .response = v[7]};
  if (keypoint.depth < 0) reader->Fail("expected the depth of a keypoint, found a negative one");
  if (keypoint.octave < 0 || keypoint.octave >= num_levels) {
    reader->Fail("expected an octave below " + std::to_string(num_levels) + ", found " +
                 std::to_string(keypoint.octave));
  }
  return keypoint;
}

}  // namespace

void WriteFrame(const Frame& frame, BinaryWriter* writer) {
  writer->Write(frame.time);
  writer->Write<std::uint64_t>(frame.keypoints.size());
  for (const Keypoint& keypoint : frame.keypoints) WriteKeypoint(keypoint, writer);
  writer->WriteAll(std::span(frame.descriptors));
}

std::shared_ptr<const Frame> ReadFrame(BinaryReader* reader,
                                       const PinholeCamera::Bounds& bounds,
                                       int num_levels) {
  auto frame = std::make_shared<Frame>();
  frame->time = reader->Read<TimeNs>();
  frame->keypoints.resize(reader->ReadCount(kBytesPerKeypoint));
  for (Keypoint& keypoint : frame->keypoints) keypoint = ReadKeypoint(reader, num_levels);
  frame->descriptors = reader->ReadAll<Descriptor>();
  if (frame->descriptors.size() != frame->keypoints.size()) {
    reader->Fail("expected " + std::to_string(frame->keypoints.size()) + " descriptors, found " +
                 std::to_string(frame->descriptors.size()));
  }
  frame->grid = FeatureGrid(frame->keypoints, bounds);
  return frame;
}

}  // namespace semslam
