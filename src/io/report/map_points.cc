// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/report/map_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "semslam/io/segment_color.h"

#include "io/cloud_columns.h"

namespace semslam {
namespace {

using Vector3f = Eigen::Vector3f;

struct Bounds {
  Vector3f low = Vector3f::Zero();
  float size = 0;  // Of the longest edge.
};

std::vector<std::uint32_t> FinitePoints(std::span<const Vector3f> positions) {
  std::vector<std::uint32_t> points;
  points.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (positions[i].allFinite()) points.push_back(static_cast<std::uint32_t>(i));
  }
  return points;
}

Bounds FindBounds(std::span<const Vector3f> positions, const std::vector<std::uint32_t>& points) {
  if (points.empty()) return {};
  Vector3f low = positions[points[0]];
  Vector3f high = low;
  for (const std::uint32_t i : points) {
    low = low.cwiseMin(positions[i]);
    high = high.cwiseMax(positions[i]);
  }
  return {low, (high - low).maxCoeff()};
}

// Mixes all bits (the finaliser of splitmix64).
std::uint64_t Mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// The first point of each cell.
std::vector<std::uint32_t> OneOfEachCell(std::span<const Vector3f> positions,
                                         const std::vector<std::uint32_t>& points,
                                         const Bounds& bounds,
                                         float cell) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  keyed.reserve(points.size());
  for (const std::uint32_t i : points) {
    const Vector3f place = (positions[i] - bounds.low) / cell;
    const auto coordinate = [&](int axis) { return static_cast<std::uint64_t>(place[axis]); };
    keyed.emplace_back(coordinate(0) << 42 | coordinate(1) << 21 | coordinate(2), i);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> kept;
  for (std::size_t k = 0; k < keyed.size(); ++k) {
    if (k == 0 || keyed[k].first != keyed[k - 1].first) kept.push_back(keyed[k].second);
  }
  return kept;
}

// Points lie on surfaces: twice the width of a cell leaves about a quarter of them.
std::vector<std::uint32_t> Thin(std::span<const Vector3f> positions,
                                std::vector<std::uint32_t> points,
                                const Bounds& bounds,
                                std::size_t max_points,
                                double* spacing) {
  constexpr float kMaxCells = 1 << 20;  // Along an axis.
  if (max_points == 0) return {};
  while (points.size() > max_points) {
    const double excess = static_cast<double>(points.size()) / static_cast<double>(max_points);
    *spacing *= std::max(1.03, std::sqrt(excess));
    const float cell = std::max(static_cast<float>(*spacing), bounds.size / kMaxCells);
    points = OneOfEachCell(positions, points, bounds, cell);
    // Points that all lie in one place cannot be told apart by cells.
    if (!(bounds.size > 0)) points.resize(std::min(points.size(), max_points));
  }
  return points;
}

std::uint16_t Pack565(Rgb c) {
  return static_cast<std::uint16_t>((c.r >> 3) << 11 | (c.g >> 2) << 5 | c.b >> 3);
}

std::array<std::int8_t, 2> PackNormal(const Vector3f& normal) {
  const float sum = normal.cwiseAbs().sum();
  if (!(sum > 0.5F) || !std::isfinite(sum)) return {0, 127};  // None: any will do.
  Eigen::Vector2f folded = normal.head<2>() / sum;
  if (normal.z() < 0) {
    const Eigen::Vector2f flipped = Eigen::Vector2f::Ones() - folded.cwiseAbs().reverse();
    folded = {std::copysign(flipped.x(), folded.x()), std::copysign(flipped.y(), folded.y())};
  }
  const auto to_byte = [](float x) { return static_cast<std::int8_t>(std::lround(127.0F * x)); };
  return {to_byte(folded.x()), to_byte(folded.y())};
}

// Places from 1 in a list of ids, as far as the type can tell them.
template <typename Number, typename Records, typename IdOf>
std::map<std::uint32_t, Number> Places(const Records& records, IdOf id_of) {
  std::map<std::uint32_t, Number> places;
  for (std::size_t i = 0; i < records.size() && i + 1 <= std::numeric_limits<Number>::max(); ++i)
    places.emplace(id_of(records[i]), static_cast<Number>(i + 1));
  places[0] = 0;
  return places;
}

class Packer {
 public:
  Packer(const LabelledMapView& map, const Bounds& bounds, double step)
      : cloud_(map.cloud),
        low_(bounds.low),
        steps_per_metre_(step > 0 ? static_cast<float>(1.0 / step) : 0.0F),
        classes_(Places<std::uint8_t>(map.classes, [](const auto& c) { return c.label; })),
        objects_(Places<std::uint16_t>(map.objects, [](const auto& o) { return o.id; })) {}

  void Append(std::uint32_t i, std::string* bytes) const {
    for (int axis = 0; axis < 3; ++axis) {
      const float steps = (cloud_.positions[i][axis] - low_[axis]) * steps_per_metre_;
      Append16(static_cast<std::uint16_t>(std::lround(std::clamp(steps, 0.0F, 65535.0F))), bytes);
    }
    Append16(Pack565(SegmentColor(cloud_.segments.empty() ? 0 : cloud_.segments[i])), bytes);
    const Rgb color = cloud_.colors.empty() ? Rgb{200, 200, 200} : cloud_.colors[i];
    for (const std::uint8_t channel : {color.r, color.g, color.b})
      bytes->push_back(static_cast<char>(channel));
    bytes->push_back(
        static_cast<char>(PlaceOf(classes_, cloud_.labels.empty() ? 0 : cloud_.labels[i])));
    for (const std::int8_t part :
         PackNormal(cloud_.normals.empty() ? Vector3f::Zero() : Vector3f(cloud_.normals[i])))
      bytes->push_back(static_cast<char>(part));
    Append16(PlaceOf(objects_, cloud_.objects.empty() ? 0 : cloud_.objects[i]), bytes);
  }

 private:
  static void Append16(std::uint16_t value, std::string* bytes) {
    bytes->push_back(static_cast<char>(value & 255));
    bytes->push_back(static_cast<char>(value >> 8));
  }

  template <typename Number>
  static Number PlaceOf(const std::map<std::uint32_t, Number>& places, std::uint32_t id) {
    const auto place = places.find(id);
    return place == places.end() ? Number{0} : place->second;
  }

  const CloudView& cloud_;
  const Vector3f low_;
  const float steps_per_metre_;
  const std::map<std::uint32_t, std::uint8_t> classes_;
  const std::map<std::uint32_t, std::uint16_t> objects_;
};

}  // namespace

PackedPoints PackPoints(const LabelledMapView& map, std::size_t max_points) {
  CheckLengths(map.cloud);
  const std::span<const Vector3f> positions = map.cloud.positions;
  PackedPoints packed;
  packed.spacing = map.point_size;
  std::vector<std::uint32_t> points = FinitePoints(positions);
  const Bounds bounds = FindBounds(positions, points);
  points = Thin(positions, std::move(points), bounds, max_points, &packed.spacing);
  std::sort(points.begin(), points.end(),
            [](std::uint32_t a, std::uint32_t b) { return Mix(a + 1) < Mix(b + 1); });
  packed.low = bounds.low.cast<double>();
  packed.step = bounds.size / 65535.0;
  packed.num_points = points.size();
  packed.bytes.reserve(points.size() * PackedPoints::kBytesPerPoint);
  const Packer packer(map, bounds, packed.step);
  for (const std::uint32_t i : points) packer.Append(i, &packed.bytes);
  return packed;
}

}  // namespace semslam
