// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_objects.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "semslam/render/hash.h"

#include "render/object_catalog.h"
#include "render/scene_shapes.h"

namespace semslam {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kMaxParts = 4000;  // Of one object.
constexpr int kMaxRepeats = 500;
constexpr Limits kPlace = {-kMaxSceneSize, kMaxSceneSize};

const CatalogEntry* FindInCatalog(const std::string& name) {
  const auto catalog = ObjectCatalog();
  const auto found = std::find_if(catalog.begin(), catalog.end(),
                                  [&](const CatalogEntry& entry) { return name == entry.name; });
  return found == catalog.end() ? nullptr : &*found;
}

// Without `size` it is drawn.
Vector3f ReadSizeOf(const CatalogEntry& entry, const SceneNode* node, SceneDice& dice) {
  Vector3f size = Vector3f::Zero();
  const auto limits = [&](std::size_t k) -> Limits {
    return {entry.low[k] / kSizeFreedom, entry.high[k] * kSizeFreedom};
  };
  const auto count = static_cast<std::size_t>(entry.num_sizes);
  if (node == nullptr) {
    for (std::size_t k = 0; k < count; ++k) {
      size[static_cast<Eigen::Index>(k)] =
          static_cast<float>(dice.random.Uniform(entry.low[k], entry.high[k]));
    }
  } else if (count == 0) {
    node->Fail("expected none, as a " + std::string(entry.name) + " has always the same size");
  } else if (count == 1) {
    size.x() = static_cast<float>(ReadNumber(*node, dice, limits(0)));
  } else {
    const SceneNode& list = Chosen(*node, dice);
    if (list.kind != SceneNode::Kind::kList || list.items.size() != count)
      list.FailExpected("a list of " + std::to_string(count) + " sizes");
    for (std::size_t k = 0; k < count; ++k) {
      size[static_cast<Eigen::Index>(k)] =
          static_cast<float>(ReadNumber(list.items[k], dice, limits(k)));
    }
  }
  return size;
}

Object MakeReady(const CatalogEntry& entry, MapReader& reader, SceneDice& dice) {
  const Vector3f size = ReadSizeOf(entry, reader.Find("size"), dice);
  std::uint64_t seed = dice.random();
  if (const SceneNode* node = reader.Find("look"))
    seed = MixBits(static_cast<std::uint64_t>(ReadCount(*node, dice, {0, 1e9})));
  return entry.make(size, seed);
}

}  // namespace

void ObjectWorkshop::Define(const SceneNode& models) {
  if (models.kind != SceneNode::Kind::kMap) models.FailExpected("a map of models");
  for (std::size_t i = 0; i < models.items.size(); ++i) {
    const std::string& name = models.keys[i];
    if (FindInCatalog(name) != nullptr)
      models.items[i].Fail("expected a new name, found that of a ready-made object");
    models_.emplace(name, &models.items[i]);
  }
}

Object ObjectWorkshop::Make(MapReader& reader, SceneDice& dice) const {
  Object object;
  const SceneNode* parts = reader.Find("parts");
  if (reader.Find("object") != nullptr) {
    object = MakeNamed(reader, dice);
  } else if (parts != nullptr) {
    object = MakeOfParts(*parts, dice);
  } else if (reader.Find("shape") != nullptr) {
    object.parts.push_back(
        {ReadShape(reader, dice), materials_.Read(reader.Get("material"), dice)});
  } else {
    reader.node().Fail("expected one of object, shape, parts, group, scatter, row, found none");
  }
  if (const SceneNode* node = reader.Find("class")) object.class_name = ReadWord(*node, dice);
  if (object.class_name.empty()) reader.Get("class");
  return object;
}

Object ObjectWorkshop::MakeNamed(MapReader& reader, SceneDice& dice) const {
  const SceneNode& node = Chosen(reader.Get("object"), dice);
  const std::string name = ReadWord(node, dice);
  Object object;
  if (const CatalogEntry* entry = FindInCatalog(name)) {
    object = MakeReady(*entry, reader, dice);
  } else if (const auto model = models_.find(name); model != models_.end()) {
    MapReader model_reader(*model->second);
    object.class_name = ReadWord(model_reader.Get("class"), dice);
    object.parts = MakeOfParts(model_reader.Get("parts"), dice).parts;
    model_reader.Finish();
  } else {
    std::vector<std::string> names;
    for (const CatalogEntry& known : ObjectCatalog()) names.emplace_back(known.name);
    for (const auto& [known, unused] : models_) names.push_back(known);
    const std::string nearest = NearestName(name, names);
    node.Fail("unknown object '" + name + "', " +
              (nearest.empty() ? "expected one of " + JoinNames(names)
                               : "did you mean '" + nearest + "'?"));
  }
  if (const SceneNode* material = reader.Find("material"))
    object.parts.front().material = materials_.Read(*material, dice);
  return object;
}

Object ObjectWorkshop::MakeOfParts(const SceneNode& parts, SceneDice& dice) const {
  if (parts.kind != SceneNode::Kind::kList || parts.items.empty())
    parts.FailExpected("a list of parts");
  Object object;
  for (const SceneNode& part : parts.items) {
    const SceneNode* repeat = part.Find("repeat");
    if (repeat == nullptr) {
      AddPart(part, dice, &object);
      continue;
    }
    const std::map<std::string, double> numbers = dice.numbers;
    const int count = ReadCount(*repeat, dice, {0, kMaxRepeats});
    for (int i = 0; i < count; ++i) {
      dice.numbers["i"] = i;
      AddPart(part, dice, &object);
    }
    dice.numbers = numbers;
  }
  if (object.parts.empty()) parts.Fail("expected a part, found none");
  return object;
}

void ObjectWorkshop::AddPart(const SceneNode& given, SceneDice& dice, Object* object) const {
  const SceneNode& part = Chosen(given, dice);
  MapReader reader(part);
  reader.Find("repeat");
  Object made;
  if (reader.Find("object") != nullptr) {
    const SceneNode& name = reader.Get("object");
    if (FindInCatalog(ReadWord(name, dice)) == nullptr)
      name.FailExpected("a ready-made object (a model cannot be part of another)");
    made = MakeNamed(reader, dice);
  } else {
    made.parts.push_back({ReadShape(reader, dice), materials_.Read(reader.Get("material"), dice)});
  }
  Rigid3 T_object_part;
  if (const SceneNode* at = reader.Find("at"))
    T_object_part.translation = ReadVector(*at, dice, kPlace);
  T_object_part.rotation = ReadAngles(reader, dice).Rotation();
  reader.Finish();
  for (ObjectPart& piece : made.parts) {
    if (object->parts.size() >= kMaxParts)
      part.Fail("expected at most " + std::to_string(kMaxParts) + " parts, found more");
    object->parts.push_back({Transformed(std::move(piece.mesh), T_object_part), piece.material});
  }
}

}  // namespace semslam
