// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_stage.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace semslam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Limits kPlace = {-kMaxSceneSize, kMaxSceneSize};
constexpr int kMaxRepeats = 500;
constexpr int kMaxCopies = 100;  // Of one choice of a scatter.
constexpr int kMaxTries = 60;    // To find a place for a copy.
constexpr std::size_t kMaxSteps = 20000;
constexpr std::size_t kMaxInstances = 3000;
constexpr std::size_t kMaxTriangles = 3000000;

double ReadOr(
    MapReader& reader, const char* key, SceneDice& dice, const Limits& limits, double otherwise) {
  const SceneNode* node = reader.Find(key);
  return node == nullptr ? otherwise : ReadNumber(*node, dice, limits);
}

const SceneNode& ListOf(const SceneNode& node) {
  if (node.kind != SceneNode::Kind::kList || node.items.empty())
    node.FailExpected("a list of objects");
  return node;
}

}  // namespace

void SceneStage::Add(const SceneNode& given, SceneDice& dice) {
  const SceneNode& entry = Chosen(given, dice);
  if (entry.kind != SceneNode::Kind::kMap) entry.FailExpected("a map of keys and values");
  const SceneNode* repeat = entry.Find("repeat");
  const int count = repeat == nullptr ? 1 : ReadCount(*repeat, dice, {0, kMaxRepeats});
  const std::map<std::string, double> numbers = dice.numbers;
  for (int i = 0; i < count; ++i) {
    if (repeat != nullptr) dice.numbers["i"] = i;
    AddOnce(entry, dice);
  }
  dice.numbers = numbers;
}

void SceneStage::AddOnce(const SceneNode& entry, SceneDice& dice) {
  CountStep(entry);
  MapReader reader(entry);
  reader.Find("repeat");
  const double chance = ReadOr(reader, "chance", dice, {0, 1}, 1);
  if (dice.random.Uniform() >= chance) return;
  if (reader.Find("group") != nullptr) {
    AddGroup(reader, dice);
  } else if (reader.Find("scatter") != nullptr) {
    Scatter(reader, dice);
  } else if (reader.Find("row") != nullptr) {
    AddRow(reader, dice);
  } else {
    AddObject(reader, dice);
  }
}

void SceneStage::AddGroup(MapReader& reader, SceneDice& dice) {
  const SceneNode& list = ListOf(reader.Get("group"));
  reader.Finish();
  for (const SceneNode& entry : list.items) Add(entry, dice);
}

void SceneStage::AddObject(MapReader& reader, SceneDice& dice) {
  const std::string name = ReadNewName(reader, dice);
  const std::optional<Surface> surface = ReadSurface(reader, dice);
  const SceneNode* from = reader.Find("from");
  const SceneNode* at_node = reader.Find("at");
  std::vector<double> at = {0, 0};
  if (at_node != nullptr) at = ReadNumbers(*at_node, dice, 2, 3, kPlace);
  const Candidate candidate = {workshop_.Make(reader, dice), ReadAngles(reader, dice)};
  Rigid3 T_world_from;
  if (from != nullptr) {
    if (surface) from->Fail("expected one of on, hang, from, found two");
    const std::string host = ReadWord(*from, dice);
    if (!layout_.Has(host)) from->FailExpected("the name of an object above");
    T_world_from = layout_.PoseOf(host);
  }
  reader.Finish();
  const Vector2d place(at[0], at[1]);
  Rigid3 T_world_object;
  if (surface) {
    layout_.Occupy(*surface, SceneLayout::FootprintOf(candidate, *surface, place));
    T_world_object = SceneLayout::PoseOn(candidate, *surface, place, at.size() > 2 ? at[2] : 0);
  } else if (at.size() > 2) {
    T_world_object =
        T_world_from * Rigid3{candidate.angles.Rotation(), Vector3d(at[0], at[1], at[2])};
  } else {  // Stands on the floor.
    Surface floor;
    floor.T_world_surface = T_world_from;
    T_world_object = SceneLayout::PoseOn(candidate, floor, place, 0);
  }
  Place(reader.node(), name, candidate.object, T_world_object);
}

void SceneStage::Scatter(MapReader& reader, SceneDice& dice) {
  const SceneNode& choices = ListOf(reader.Get("scatter"));
  const std::optional<Surface> surface = ReadSurface(reader, dice);
  if (!surface) reader.Get("on");
  const double gap = ReadOr(reader, "gap", dice, {0, 10}, 0.01);
  const double margin = ReadOr(reader, "margin", dice, {0, 10}, 0.01);
  reader.Finish();
  for (const SceneNode& given : choices.items) {
    const SceneNode& choice = Chosen(given, dice);
    MapReader choice_reader(choice);
    const SceneNode* count_node = choice_reader.Find("count");
    const int count = count_node == nullptr ? 1 : ReadCount(*count_node, dice, {0, kMaxCopies});
    const double chance = ReadOr(choice_reader, "chance", dice, {0, 1}, 1);
    for (int i = 0; i < count; ++i) {
      if (dice.random.Uniform() >= chance) continue;
      if (!ScatterOne(choice, *surface, gap, margin, dice)) break;
    }
  }
}

bool SceneStage::ScatterOne(
    const SceneNode& choice, const Surface& surface, double gap, double margin, SceneDice& dice) {
  CountStep(choice);
  Candidate candidate;
  {
    MapReader reader(choice);
    candidate.object = workshop_.Make(reader, dice);
    for (const char* key : {"count", "chance", "x", "y", "yaw", "pitch", "roll"}) reader.Find(key);
    reader.Finish();
  }
  for (int i = 0; i < kMaxTries; ++i) {
    MapReader reader(choice);
    const auto draw = [&](const char* key, double low, double high) {
      const SceneNode* node = reader.Find(key);
      return node == nullptr ? dice.random.Uniform(low, high) : ReadNumber(*node, dice, kPlace);
    };
    const double x = draw("x", surface.low.x(), surface.high.x());
    const double y = draw("y", surface.low.y(), surface.high.y());
    candidate.angles = ReadAngles(reader, dice);
    const Footprint footprint = SceneLayout::FootprintOf(candidate, surface, {x, y});
    if (!layout_.IsFree(footprint, surface, gap, margin)) continue;
    layout_.Occupy(surface, footprint);
    Place(choice, "", candidate.object, SceneLayout::PoseOn(candidate, surface, {x, y}, 0));
    return true;
  }
  return false;
}

void SceneStage::AddRow(MapReader& reader, SceneDice& dice) {
  const SceneNode& choices = ListOf(reader.Get("row"));
  const std::optional<Surface> surface = ReadSurface(reader, dice);
  if (!surface) reader.Get("on");
  double x = ReadOr(reader, "start", dice, kPlace, surface->low.x());
  const double end = ReadOr(reader, "end", dice, kPlace, surface->high.x());
  const double front = ReadOr(reader, "front", dice, kPlace, surface->low.y());
  const SceneNode* gap = reader.Find("gap");
  reader.Finish();
  for (int i = 0; i < kMaxRepeats; ++i) {
    const SceneNode& choice = Chosen(
        choices.items[dice.random.Index(static_cast<std::uint32_t>(choices.items.size()))], dice);
    CountStep(choice);
    MapReader choice_reader(choice);
    const Candidate candidate = {workshop_.Make(choice_reader, dice),
                                 ReadAngles(choice_reader, dice)};
    choice_reader.Finish();
    Footprint footprint = SceneLayout::FootprintOf(candidate, *surface, Vector2d::Zero());
    const Vector2d extent = footprint.Extent();
    if (x + 2 * extent.x() > end) return;
    const Vector2d at = Vector2d(x, front) + extent - footprint.center;
    footprint.center += at;
    layout_.Occupy(*surface, footprint);
    Place(choice, "", candidate.object, SceneLayout::PoseOn(candidate, *surface, at, 0));
    x += 2 * extent.x() + (gap == nullptr ? 0.001 : ReadNumber(*gap, dice, {0, 10}));
  }
}

std::optional<Surface> SceneStage::ReadSurface(MapReader& reader, SceneDice& dice) const {
  const SceneNode* on = reader.Find("on");
  const SceneNode* hang = reader.Find("hang");
  if (on != nullptr && hang != nullptr) hang->Fail("expected one of on, hang, from, found two");
  const SceneNode* node = on != nullptr ? on : hang;
  if (node == nullptr) return std::nullopt;
  const std::string host = ReadWord(*node, dice);
  std::optional<Surface> surface = on != nullptr ? layout_.FindTop(host) : layout_.FindFront(host);
  if (surface) return surface;
  const std::string name = host.substr(0, host.find('/'));
  if (on != nullptr && layout_.Has(name)) {
    node->Fail("expected a place of '" + name + "', from /1 to /" +
               std::to_string(layout_.NumPlaces(name)) + ", found '" + host + "'");
  }
  const std::string nearest = NearestName(host, layout_.Names());
  node->Fail("expected the name of an object above" +
             (nearest.empty() ? "" : " ('" + nearest + "'?)") + ", found '" + host + "'");
}

std::string SceneStage::ReadNewName(MapReader& reader, SceneDice& dice) const {
  const SceneNode* node = reader.Find("name");
  if (node == nullptr) return "";
  std::string name = ReadWord(*node, dice);
  if (name.find('/') != std::string::npos) node->FailExpected("a name without '/'");
  if (layout_.Has(name)) node->Fail("expected a new name, found '" + name + "' again");
  return name;
}

void SceneStage::Place(const SceneNode& entry,
                       const std::string& name,
                       const Object& object,
                       const Rigid3& T_world_object) {
  for (const ObjectPart& part : object.parts) num_triangles_ += part.mesh.triangles.size();
  if (num_triangles_ > kMaxTriangles)
    entry.Fail("expected at most " + std::to_string(kMaxTriangles) + " triangles, found more");
  if (scene_.instances().size() >= kMaxInstances)
    entry.Fail("expected at most " + std::to_string(kMaxInstances) + " objects, found more");
  layout_.Place(name, object, T_world_object);
}

void SceneStage::CountStep(const SceneNode& entry) {
  if (++num_steps_ > kMaxSteps)
    entry.Fail("expected at most " + std::to_string(kMaxSteps) + " steps in all, found more");
}

}  // namespace semslam
