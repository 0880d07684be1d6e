// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>

#include "semslam/base/error.h"

#include "semantics/darknet_config.h"

namespace semslam {
namespace {

using Section = DarknetConfig::Section;

constexpr int kMaxChannels = 1 << 16;
constexpr int kMaxLayers = 4096;

// What a layer gives.
struct Volume {
  int channels = 0;
  int width = 0;
  int height = 0;
};

// Walks through the layers in order.
class ShapeWalker {
 public:
  ShapeWalker(const DarknetConfig& config, std::size_t num_classes)
      : config_(config), num_classes_(static_cast<int>(num_classes)) {
    const Section& net = config.sections().front();
    current_ = {config.Integer(net, "channels", 3), config.input_width(), config.input_height()};
    constexpr int kMaxInput = 4096;
    const bool fits = current_.width > 0 && current_.height > 0 && current_.width <= kMaxInput &&
                      current_.height <= kMaxInput && current_.width % 32 == 0 &&
                      current_.height % 32 == 0;
    Require(fits, net,
            "expected width and height as multiples of 32 up to 4096, found " +
                std::to_string(current_.width) + "x" + std::to_string(current_.height));
    Require(current_.channels == 3, net, "expected channels=3");
    Require(config.sections().size() <= kMaxLayers, net, "expected at most 4096 layers");
  }

  DarknetShape Walk() {
    const auto& sections = config_.sections();
    for (std::size_t i = 1; i < sections.size(); ++i) {
      Step(sections[i]);
      outputs_.push_back(current_);
    }
    if (shape_.heads.empty()) {
      throw InputError(config_.name() + ": expected at least one [yolo] layer, found none");
    }
    return shape_;
  }

 private:
  void Require(bool holds, const Section& section, const std::string& what) const {
    if (!holds) throw InputError(config_.Where(section) + what);
  }

  int Positive(const Section& section, const std::string& key, int fallback, int limit) const {
    const int value = config_.Integer(section, key, fallback);
    Require(value > 0 && value <= limit, section,
            key + ": expected a number in 1 .. " + std::to_string(limit) + ", found " +
                std::to_string(value));
    return value;
  }

  void Step(const Section& section) {
    if (section.type == "convolutional") return Convolve(section);
    if (section.type == "maxpool") return Pool(section);
    if (section.type == "upsample") return Upsample(section);
    if (section.type == "route") return Route(section);
    if (section.type == "shortcut") return Add(section);
    if (section.type == "yolo") return Head(section);
    Require(section.type == "dropout", section,
            "expected one of convolutional, maxpool, upsample, route, shortcut, dropout, yolo");
  }

  void Convolve(const Section& section) {
    const int filters = Positive(section, "filters", 1, kMaxChannels);
    const int size = Positive(section, "size", 1, 64);
    const int stride = Positive(section, "stride", 1, 64);
    const int groups = Positive(section, "groups", 1, kMaxChannels);
    const bool pads = config_.Integer(section, "pad", 0) != 0;
    const int padding = pads ? size / 2 : config_.Integer(section, "padding", 0);
    const bool is_normalised = config_.Integer(section, "batch_normalize", 0) != 0;
    Require(current_.channels % groups == 0 && filters % groups == 0, section,
            "groups do not divide the channels");
    const std::uint64_t kernels = std::uint64_t(filters) *
                                  std::uint64_t(current_.channels / groups) * std::uint64_t(size) *
                                  std::uint64_t(size);
    shape_.num_weights += kernels + std::uint64_t(filters) * (is_normalised ? 4U : 1U);
    current_ = {filters, (current_.width + 2 * padding - size) / stride + 1,
                (current_.height + 2 * padding - size) / stride + 1};
    Require(current_.width > 0 && current_.height > 0, section, "nothing is left of the image");
  }

  void Pool(const Section& section) {
    const int stride = Positive(section, "stride", 1, 64);
    const int size = Positive(section, "size", stride, 64);
    const int padding = config_.Integer(section, "padding", size - 1);
    current_.width = (current_.width + padding - size) / stride + 1;
    current_.height = (current_.height + padding - size) / stride + 1;
    Require(current_.width > 0 && current_.height > 0, section, "nothing is left of the image");
  }

  void Upsample(const Section& section) {
    const int stride = Positive(section, "stride", 2, 8);
    current_.width *= stride;
    current_.height *= stride;
  }

  // The output of the layer that a number means: counted from here if negative.
  const Volume& OutputOf(const Section& section, int number) const {
    const int index = number < 0 ? static_cast<int>(outputs_.size()) + number : number;
    Require(index >= 0 && index < static_cast<int>(outputs_.size()), section,
            "there is no layer " + std::to_string(number));
    return outputs_[static_cast<std::size_t>(index)];
  }

  void Route(const Section& section) {
    const std::vector<int> layers = config_.Integers(section, "layers");
    Require(!layers.empty(), section, "layers: missing");
    const int groups = Positive(section, "groups", 1, kMaxChannels);
    Volume joined = OutputOf(section, layers.front());
    joined.channels = 0;
    for (const int layer : layers) {
      const Volume& part = OutputOf(section, layer);
      Require(part.width == joined.width && part.height == joined.height, section,
              "joins layers of different sizes");
      Require(part.channels % groups == 0, section, "groups do not divide the channels");
      joined.channels += part.channels / groups;
    }
    Require(joined.channels <= kMaxChannels, section, "too many channels");
    current_ = joined;
  }

  void Add(const Section& section) {
    const std::vector<int> from = config_.Integers(section, "from");
    Require(!from.empty(), section, "from: missing");
    for (const int layer : from) {
      const Volume& other = OutputOf(section, layer);
      Require(other.width == current_.width && other.height == current_.height, section,
              "adds layers of different sizes");
    }
  }

  void Head(const Section& section) {
    const int classes = config_.Integer(section, "classes", 20);
    Require(classes == num_classes_, section,
            "classes=" + std::to_string(classes) + ", but there are " +
                std::to_string(num_classes_) + " class names");
    const std::vector<int> mask = config_.Integers(section, "mask");
    const int num_anchors =
        mask.empty() ? Positive(section, "num", 1, 100) : static_cast<int>(mask.size());
    const int expected = num_anchors * (5 + classes);
    Require(current_.channels == expected, section,
            "expected " + std::to_string(expected) + " filters (" + std::to_string(num_anchors) +
                " anchors x (5 + " + std::to_string(classes) + " classes)) before it, found " +
                std::to_string(current_.channels));
    shape_.heads.push_back({num_anchors * current_.width * current_.height, 5 + classes});
  }

  const DarknetConfig& config_;
  int num_classes_;
  Volume current_;
  std::vector<Volume> outputs_;
  DarknetShape shape_;
};

}  // namespace

DarknetShape AnalyseDarknet(const DarknetConfig& config, std::size_t num_classes) {
  return ShapeWalker(config, num_classes).Walk();
}

void CheckDarknetWeights(const std::filesystem::path& weights,
                         const DarknetConfig& config,
                         std::uint64_t num_weights) {
  std::error_code error;
  const std::uintmax_t found = std::filesystem::file_size(weights, error);
  std::ifstream file(weights, std::ios::binary);
  if (error || !file) throw InputError(weights.string() + ": cannot open the network's weights");
  // int32 major, minor, revision, then the number of images seen: 64 bits since version 0.2.
  std::array<std::int32_t, 3> version{};
  std::array<char, sizeof(version)> bytes{};
  if (!file.read(bytes.data(), bytes.size())) {
    throw InputError(weights.string() + ": expected Darknet weights, found " +
                     std::to_string(found) + " bytes");
  }
  std::memcpy(version.data(), bytes.data(), sizeof(version));
  const std::int64_t number = std::int64_t{version[0]} * 10 + version[1];
  const std::uint64_t header = number >= 2 ? 20 : 16;
  const std::uint64_t expected = header + num_weights * sizeof(float);
  if (found != expected) {
    throw InputError(
        weights.string() + ": expected " + std::to_string(expected) + " bytes for " +
        config.name() + ", found " + std::to_string(found) +
        (found < expected ? " (cut short, or of another network)" : " (of another network)"));
  }
}

}  // namespace semslam
