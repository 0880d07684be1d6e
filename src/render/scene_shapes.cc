// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_shapes.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

namespace semslam {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr double kMinSize = 0.0002;
constexpr Limits kSize = {kMinSize, kMaxSceneSize};
constexpr Limits kPlace = {-kMaxSceneSize, kMaxSceneSize};

float ReadSize(MapReader& reader, const char* key, SceneDice& dice) {
  return static_cast<float>(ReadNumber(reader.Get(key), dice, kSize));
}

int ReadSegments(MapReader& reader, SceneDice& dice, int usual) {
  const SceneNode* node = reader.Find("segments");
  return node == nullptr ? usual : ReadCount(*node, dice, {3, 128});
}

TriangleMesh ReadBox(MapReader& reader, SceneDice& dice) {
  const Vector3f size = ReadVector(reader.Get("size"), dice, kSize).cast<float>();
  const Vector3f up(0, 0, 0.5F * size.z());
  const SceneNode* round = reader.Find("round");
  if (round == nullptr) return Translated(MakeBox(size), up);
  const double largest = 0.5 * size.minCoeff();
  return Translated(
      MakeRoundedBox(size, static_cast<float>(ReadNumber(*round, dice, {1e-5, largest}))), up);
}

TriangleMesh ReadRectangle(MapReader& reader, SceneDice& dice) {
  const std::vector<double> size = ReadNumbers(reader.Get("size"), dice, 2, 2, kSize);
  return MakeRectangle(static_cast<float>(size[0]), static_cast<float>(size[1]));
}

TriangleMesh ReadCylinder(MapReader& reader, SceneDice& dice) {
  const float radius = ReadSize(reader, "radius", dice);
  const float height = ReadSize(reader, "height", dice);
  return MakeCylinder(radius, height, ReadSegments(reader, dice, 32));
}

TriangleMesh ReadCone(MapReader& reader, SceneDice& dice) {
  const float radius = ReadSize(reader, "radius", dice);
  const float height = ReadSize(reader, "height", dice);
  const SceneNode* top_node = reader.Find("top");
  const auto top =
      static_cast<float>(top_node == nullptr ? 0 : ReadNumber(*top_node, dice, {0, kMaxSceneSize}));
  const std::vector<Vector2f> profile = {{0, 0}, {radius, 0}, {top, height}, {0, height}};
  return MakeLathe(profile, ReadSegments(reader, dice, 32), false);
}

TriangleMesh ReadSphere(MapReader& reader, SceneDice& dice) {
  const float radius = ReadSize(reader, "radius", dice);
  return Translated(MakeEllipsoid(Vector3f::Constant(radius), ReadSegments(reader, dice, 32)),
                    {0, 0, radius});
}

TriangleMesh ReadEllipsoid(MapReader& reader, SceneDice& dice) {
  const Vector3f size = ReadVector(reader.Get("size"), dice, kSize).cast<float>();
  return Translated(MakeEllipsoid(0.5F * size, ReadSegments(reader, dice, 32)),
                    {0, 0, 0.5F * size.z()});
}

TriangleMesh ReadDome(MapReader& reader, SceneDice& dice) {
  const Vector3f size = ReadVector(reader.Get("size"), dice, kSize).cast<float>();
  return MakeDome({0.5F * size.x(), 0.5F * size.y(), size.z()}, ReadSegments(reader, dice, 32));
}

// A list of points, each a list of `dimension` numbers.
std::vector<Vector3f> ReadPoints(const SceneNode& node, SceneDice& dice, std::size_t dimension) {
  constexpr std::size_t kMaxPoints = 200;
  const bool is_list = node.kind == SceneNode::Kind::kList;
  if (!is_list || node.items.size() < 2 || node.items.size() > kMaxPoints)
    node.FailExpected("a list of 2 to " + std::to_string(kMaxPoints) + " points");
  std::vector<Vector3f> points;
  for (const SceneNode& item : node.items) {
    const std::vector<double> numbers = ReadNumbers(item, dice, dimension, dimension, kPlace);
    Vector3f point = Vector3f::Zero();
    for (std::size_t k = 0; k < dimension; ++k)
      point[static_cast<Eigen::Index>(k)] = static_cast<float>(numbers[k]);
    if (!points.empty() && (point - points.back()).norm() < 1e-5F)
      item.Fail("expected a point away from the one before, found the same");
    points.push_back(point);
  }
  return points;
}

TriangleMesh ReadLathe(MapReader& reader, SceneDice& dice) {
  const SceneNode& node = reader.Get("profile");
  std::vector<Vector2f> profile;
  for (const Vector3f& point : ReadPoints(node, dice, 2)) {
    if (point.x() < 0) node.Fail("expected radii >= 0, found a negative one");
    profile.emplace_back(point.head<2>());
  }
  const SceneNode* smooth = reader.Find("smooth");
  const bool is_smooth = smooth != nullptr && ReadSwitch(*smooth, dice);
  return MakeLathe(profile, ReadSegments(reader, dice, 32), is_smooth);
}

TriangleMesh ReadTube(MapReader& reader, SceneDice& dice) {
  const float radius = ReadSize(reader, "radius", dice);
  const std::vector<Vector3f> points = ReadPoints(reader.Get("points"), dice, 3);
  return MakeTube(points, radius, ReadSegments(reader, dice, 12));
}

struct Shape {
  const char* name;
  TriangleMesh (*read)(MapReader&, SceneDice&);
};
constexpr Shape kShapes[] = {
    {"box", ReadBox},   {"rectangle", ReadRectangle}, {"cylinder", ReadCylinder},
    {"cone", ReadCone}, {"sphere", ReadSphere},       {"ellipsoid", ReadEllipsoid},
    {"dome", ReadDome}, {"lathe", ReadLathe},         {"tube", ReadTube}};

}  // namespace

TriangleMesh ReadShape(MapReader& reader, SceneDice& dice) {
  const SceneNode& node = reader.Get("shape");
  const std::string name = ReadWord(node, dice);
  std::vector<std::string> names;
  for (const Shape& shape : kShapes) {
    if (name == shape.name) return shape.read(reader, dice);
    names.emplace_back(shape.name);
  }
  node.Fail("expected one of " + JoinNames(names) + ", found '" + name + "'");
}

Eigen::Quaterniond SceneAngles::Rotation() const { return ExpSO3({0, 0, yaw}) * tilt; }

SceneAngles ReadAngles(MapReader& reader, SceneDice& dice) {
  const auto read = [&](const char* key) {
    const SceneNode* node = reader.Find(key);
    return node == nullptr ? 0.0 : ReadNumber(*node, dice, {-720, 720}) * std::numbers::pi / 180.0;
  };
  SceneAngles angles;
  angles.yaw = read("yaw");
  const double pitch = read("pitch");
  const double roll = read("roll");
  angles.tilt = ExpSO3({pitch, 0, 0}) * ExpSO3({0, roll, 0});
  return angles;
}

}  // namespace semslam
