// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/onnx_input.h"

#include <cstdint>
#include <fstream>
#include <functional>
#include <vector>

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl.h>

namespace semslam {
namespace {

using google::protobuf::io::CodedInputStream;

// Numbers of fields in onnx.proto, from the model down to the length of a dimension.
constexpr std::uint32_t kGraphOfModel = 7;
constexpr std::uint32_t kInputOfGraph = 11;
constexpr std::uint32_t kTypeOfInput = 2;
constexpr std::uint32_t kTensorOfType = 1;
constexpr std::uint32_t kShapeOfTensor = 2;
constexpr std::uint32_t kDimensionOfShape = 1;
constexpr std::uint32_t kValueOfDimension = 1;

// How a field is written: the lower three bits of its tag.
constexpr std::uint32_t kVarint = 0;
constexpr std::uint32_t kEightBytes = 1;
constexpr std::uint32_t kWithLength = 2;
constexpr std::uint32_t kFourBytes = 5;

std::uint32_t NumberOf(std::uint32_t tag) { return tag >> 3; }
std::uint32_t KindOf(std::uint32_t tag) { return tag & 7; }

bool SkipField(CodedInputStream& in, std::uint32_t tag) {
  std::uint64_t value = 0;
  std::uint32_t length = 0;
  switch (KindOf(tag)) {
    case kVarint:
      return in.ReadVarint64(&value);
    case kEightBytes:
      return in.Skip(8);
    case kWithLength:
      return in.ReadVarint32(&length) && in.Skip(static_cast<int>(length));
    case kFourBytes:
      return in.Skip(4);
    default:
      return false;
  }
}

// Calls `visit` for every message in the field of this number; it may read as far as the message
// goes, and the rest is passed over.
void ForEachMessage(CodedInputStream& in, std::uint32_t field, const std::function<void()>& visit) {
  while (const std::uint32_t tag = in.ReadTag()) {
    if (NumberOf(tag) != field || KindOf(tag) != kWithLength) {
      if (!SkipField(in, tag)) return;
      continue;
    }
    std::uint32_t length = 0;
    if (!in.ReadVarint32(&length)) return;
    const CodedInputStream::Limit limit = in.PushLimit(static_cast<int>(length));
    visit();
    if (!in.Skip(in.BytesUntilLimit())) return;
    in.PopLimit(limit);
  }
}

// 0: any length.
std::uint64_t ReadDimension(CodedInputStream& in) {
  std::uint64_t value = 0;
  while (const std::uint32_t tag = in.ReadTag()) {
    const bool is_value = NumberOf(tag) == kValueOfDimension && KindOf(tag) == kVarint;
    if (is_value ? !in.ReadVarint64(&value) : !SkipField(in, tag)) break;
  }
  return value;
}

std::vector<std::uint64_t> ReadShapeOfInput(CodedInputStream& in) {
  std::vector<std::uint64_t> shape;
  ForEachMessage(in, kTypeOfInput, [&] {
    ForEachMessage(in, kTensorOfType, [&] {
      ForEachMessage(in, kShapeOfTensor, [&] {
        ForEachMessage(in, kDimensionOfShape, [&] { shape.push_back(ReadDimension(in)); });
      });
    });
  });
  return shape;
}

}  // namespace

std::optional<cv::Size> ReadOnnxInputSize(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  google::protobuf::io::IstreamInputStream stream(&file);
  CodedInputStream in(&stream);
  std::optional<cv::Size> size;
  ForEachMessage(in, kGraphOfModel, [&] {
    ForEachMessage(in, kInputOfGraph, [&] {
      // Old files list the weights as inputs too; images come as images x 3 x height x width.
      const std::vector<std::uint64_t> shape = ReadShapeOfInput(in);
      constexpr std::uint64_t kMaxLength = 1 << 14;
      const auto is_length = [](std::uint64_t n) { return n > 0 && n <= kMaxLength; };
      if (size || shape.size() != 4 || shape[1] != 3) return;
      if (!is_length(shape[2]) || !is_length(shape[3])) return;
      size = cv::Size(static_cast<int>(shape[3]), static_cast<int>(shape[2]));
    });
  });
  return size;
}

}  // namespace semslam
