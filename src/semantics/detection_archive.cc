// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/semantics/detection_archive.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace semslam {
namespace {

// Class, score, box, number of class scores.
constexpr std::size_t kMinBytesOfDetection =
    sizeof(std::int32_t) + 5 * sizeof(float) + sizeof(std::uint64_t);

Detection ReadDetection(BinaryReader* reader, std::size_t num_classes) {
  const auto is_score = [](float score) { return score >= 0 && score <= 1; };
  Detection detection;
  detection.class_id = static_cast<int>(reader->ReadIndex(num_classes, "class of a detection"));
  detection.score = reader->Read<float>();
  for (float* side :
       {&detection.box.min_x, &detection.box.min_y, &detection.box.max_x, &detection.box.max_y}) {
    *side = reader->Read<float>();
    if (!std::isfinite(*side)) reader->Fail("expected a finite box of a detection");
  }
  detection.class_scores = reader->ReadAll<float>();
  if (detection.class_scores.size() != num_classes) {
    reader->Fail("expected " + std::to_string(num_classes) + " scores of a detection, found " +
                 std::to_string(detection.class_scores.size()));
  }
  if (!is_score(detection.score) ||
      !std::all_of(detection.class_scores.begin(), detection.class_scores.end(), is_score)) {
    reader->Fail("expected scores of a detection from 0 to 1");
  }
  return detection;
}

}  // namespace

void WriteClassTable(const ClassTable& classes, BinaryWriter* writer) {
  writer->Write<std::uint64_t>(classes.size());
  for (int id = 0; id < static_cast<int>(classes.size()); ++id) {
    writer->WriteText(classes.name(id));
    writer->Write<std::uint8_t>(classes.is_of_interest(id) ? 1 : 0);
  }
}

ClassTable ReadClassTable(BinaryReader* reader) {
  const std::size_t count = reader->ReadCount(sizeof(std::uint64_t) + 1);
  std::vector<std::string> names;
  std::vector<std::string> of_interest;
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(reader->ReadText());
    if (reader->Read<std::uint8_t>() != 0) of_interest.push_back(names.back());
  }
  if (names.empty()) return {};
  if (of_interest.empty()) reader->Fail("expected a class of interest");
  return ClassTable(names).WithInterest(of_interest);
}

void WriteDetections(const std::vector<Detection>& detections, BinaryWriter* writer) {
  writer->Write<std::uint64_t>(detections.size());
  for (const Detection& detection : detections) {
    writer->Write(static_cast<std::uint32_t>(detection.class_id));
    writer->Write(detection.score);
    for (const float side :
         {detection.box.min_x, detection.box.min_y, detection.box.max_x, detection.box.max_y}) {
      writer->Write(side);
    }
    writer->WriteAll(std::span(detection.class_scores));
  }
}

std::vector<Detection> ReadDetections(BinaryReader* reader, std::size_t num_classes) {
  std::vector<Detection> detections(reader->ReadCount(kMinBytesOfDetection));
  for (Detection& detection : detections) detection = ReadDetection(reader, num_classes);
  return detections;
}

}  // namespace semslam
