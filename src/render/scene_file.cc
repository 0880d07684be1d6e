// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/render/scene_file.h"

#include <fstream>
#include <iterator>
#include <utility>

#include "semslam/base/error.h"
#include "semslam/render/hash.h"

#include "render/scene_camera.h"
#include "render/scene_objects.h"
#include "render/scene_stage.h"

namespace semslam {
namespace {

constexpr std::size_t kMaxLamps = 3;  // What the renderer has room for.
constexpr Limits kPower = {0, 200};

// What a part of the file is drawn with: changing one part leaves the others as they were.
enum class Stream : std::uint64_t { kNumbers, kMaterials, kLight, kObjects, kCamera };

SceneDice DiceFor(std::uint64_t seed,
                  Stream stream,
                  std::uint64_t index,
                  const std::map<std::string, double>& numbers) {
  SceneDice dice(HashOf(seed, static_cast<std::uint64_t>(stream) + 1, index));
  dice.numbers = numbers;
  return dice;
}

// A formula may use the numbers before it.
std::map<std::string, double> ReadNamedNumbers(const SceneNode* node, std::uint64_t seed) {
  SceneDice dice = DiceFor(seed, Stream::kNumbers, 0, {});
  if (node == nullptr) return {};
  if (node->kind != SceneNode::Kind::kMap) node->FailExpected("a map of names and numbers");
  for (std::size_t i = 0; i < node->items.size(); ++i)
    dice.numbers[node->keys[i]] = ReadNumber(node->items[i], dice, {-1e6, 1e6});
  return dice.numbers;
}

Eigen::Vector3f ReadLight(const SceneNode& node, SceneDice& dice) {
  return ReadVector(node, dice, kPower).cast<float>().reverse();  // RGB to BGR.
}

void ReadLights(MapReader& reader, SceneDice dice, Scene* scene) {
  if (const SceneNode* node = reader.Find("ambient")) {
    MapReader ambient(*node);
    const Eigen::Vector3f above = ReadLight(ambient.Get("above"), dice);
    scene->SetAmbient(above, ReadLight(ambient.Get("below"), dice));
    ambient.Finish();
  }
  const SceneNode* lamps = reader.Find("lamps");
  if (lamps == nullptr) return;
  if (lamps->kind != SceneNode::Kind::kList || lamps->items.size() > kMaxLamps)
    lamps->FailExpected("a list of at most " + std::to_string(kMaxLamps) + " lamps");
  for (const SceneNode& item : lamps->items) {
    MapReader lamp(Chosen(item, dice));
    Light light;
    light.p_world = ReadVector(lamp.Get("at"), dice, {-kMaxSceneSize, kMaxSceneSize}).cast<float>();
    light.intensity = ReadLight(lamp.Get("power"), dice);
    if (const SceneNode* radius = lamp.Find("radius"))
      light.radius = static_cast<float>(ReadNumber(*radius, dice, {0, 5}));
    lamp.Finish();
    scene->AddLight(light);
  }
}

std::string ReadFile(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError("scene " + path.string() + ": expected a file, found none");
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw InputError("scene " + path.string() + ": cannot read it");
  return text;
}

}  // namespace

StagedScene ParseScene(const std::string& text, const std::string& file, std::uint64_t seed) {
  const SceneNode root = ParseSceneYaml(text, file);
  if (root.kind == SceneNode::Kind::kNothing) root.Fail("expected a scene, found nothing");
  MapReader reader(root);
  if (const SceneNode* about = reader.Find("about"); about && about->kind != SceneNode::Kind::kText)
    about->FailExpected("a text");
  const auto numbers = ReadNamedNumbers(reader.Find("numbers"), seed);
  const auto dice_for = [&](Stream stream, std::uint64_t index = 0) {
    return DiceFor(seed, stream, index, numbers);
  };
  ObjectWorkshop workshop;
  if (const SceneNode* materials = reader.Find("materials")) {
    SceneDice dice = dice_for(Stream::kMaterials);
    workshop.materials().Define(*materials, dice);
  }
  if (const SceneNode* models = reader.Find("models")) workshop.Define(*models);
  Scene scene;
  ReadLights(reader, dice_for(Stream::kLight), &scene);
  const SceneNode& objects = reader.Get("objects");
  if (objects.kind != SceneNode::Kind::kList || objects.items.empty())
    objects.FailExpected("a list of objects");
  SceneStage stage(workshop, &scene);
  for (std::size_t i = 0; i < objects.items.size(); ++i) {
    SceneDice dice = dice_for(Stream::kObjects, i);
    stage.Add(objects.items[i], dice);
  }
  SceneDice dice = dice_for(Stream::kCamera);
  CameraPath path = ReadCameraPath(reader.Get("camera"), stage.layout(), dice);
  reader.Finish();
  return {std::move(scene), std::move(path)};
}

StagedScene LoadScene(const std::filesystem::path& path, std::uint64_t seed, int num_threads) {
  StagedScene staged = ParseScene(ReadFile(path), path.string(), seed);
  staged.scene.Paint(num_threads);
  return staged;
}

}  // namespace semslam
