// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_materials.h"

#include <cstdint>
#include <iterator>

#include "semslam/render/patterns.h"

#include "render/object_parts.h"

namespace semslam {
namespace {

using Eigen::Vector3f;

// What a pattern is drawn from.
struct PatternStyle {
  Vector3f color;
  Vector3f second;
  float contrast;
  std::uint64_t seed;
};

cv::Mat DrawPlaster(const PatternStyle& style) {
  return DrawNoise({512, 512}, {style.color, style.contrast, 24, 4, 0.95F}, style.seed);
}
cv::Mat DrawClouds(const PatternStyle& style) {
  return DrawNoise({512, 512}, {style.color, style.contrast, 8, 6, 0.6F}, style.seed);
}

struct Pattern {
  const char* name;
  float scale;     // Metres that one picture covers.
  float contrast;  // Where it counts.
  cv::Mat (*draw)(const PatternStyle&);
};

constexpr Pattern kPatterns[] = {
    {"noise", 0.5F, 0.3F, DrawClouds},
    {"plaster", 1.0F, 0.07F, DrawPlaster},
    {"wood", 1.2F, 0,
     [](const PatternStyle& s) {
       return DrawWood({1024, 512}, s.color, s.seed);
     }},
    {"carpet", 0.8F, 0,
     [](const PatternStyle& s) {
       return DrawCarpet({512, 512}, s.color, s.seed);
     }},
    {"fur", 0.16F, 0,
     [](const PatternStyle& s) {
       return DrawFur({256, 256}, s.color, s.seed);
     }},
    {"cardboard", 0.4F, 0,
     [](const PatternStyle& s) {
       return DrawCardboard({384, 320}, s.seed);
     }},
    {"page", 0.3F, 0,
     [](const PatternStyle& s) {
       return DrawPage({724, 724}, s.seed);
     }},
    {"poster", 0.8F, 0,
     [](const PatternStyle& s) {
       return DrawPoster({720, 720}, s.seed);
     }},
    {"screen", 0.5F, 0,
     [](const PatternStyle& s) {
       return DrawScreen({768, 768}, s.seed);
     }},
    {"motif", 0.3F, 0,
     [](const PatternStyle& s) {
       return DrawMotif({512, 512}, s.color, s.seed);
     }},
    {"bricks", 1.0F, 0.25F,
     [](const PatternStyle& s) {
       return DrawBricks({512, 512}, s.color, s.second, s.contrast, s.seed);
     }},
    {"tiles", 1.2F, 0.12F,
     [](const PatternStyle& s) {
       return DrawTiles({512, 512}, s.color, s.second, s.contrast, s.seed);
     }},
    {"fabric", 0.25F, 0.25F,
     [](const PatternStyle& s) {
       return DrawFabric({256, 256}, s.color, s.second, s.contrast, s.seed);
     }},
    {"rug", 1.6F, 0,
     [](const PatternStyle& s) {
       return DrawRug({640, 640}, s.color, s.second, s.seed);
     }},
};

const Pattern& PatternOf(const SceneNode& node, SceneDice& dice) {
  const std::string name = ReadWord(node, dice);
  std::vector<std::string> names;
  for (const Pattern& pattern : kPatterns) {
    if (name == pattern.name) return pattern;
    names.emplace_back(pattern.name);
  }
  node.Fail("expected one of plain, " + JoinNames(names) + ", found '" + name + "'");
}

// The keys that every material has, plain or not.
void ReadShine(MapReader& reader, SceneDice& dice, Material* material) {
  const auto read = [&](const char* key, const Limits& limits, float* value) {
    if (const SceneNode* node = reader.Find(key))
      *value = static_cast<float>(ReadNumber(*node, dice, limits));
  };
  read("specular", {0, 2}, &material->specular);
  read("shininess", {1, 1000}, &material->shininess);
  read("emission", {0, 20}, &material->emission);
}

Material ReadMap(const SceneNode& node, SceneDice& dice) {
  MapReader reader(node);
  const SceneNode* pattern_node = reader.Find("pattern");
  const SceneNode* color_node = reader.Find("color");
  const SceneNode* second_node = reader.Find("second");
  const SceneNode* scale_node = reader.Find("scale");
  const SceneNode* contrast_node = reader.Find("contrast");
  const Vector3f color =
      color_node != nullptr ? ReadColor(*color_node, dice) : Vector3f::Constant(0.7F);
  const Vector3f second = second_node != nullptr ? ReadColor(*second_node, dice) : 0.6F * color;
  Material material;
  material.tint = color;
  const bool is_plain = pattern_node == nullptr || Chosen(*pattern_node, dice).text == "plain";
  if (!is_plain) {
    const Pattern& pattern = PatternOf(*pattern_node, dice);
    PatternStyle style = {color, second, pattern.contrast, dice.random()};
    float scale = pattern.scale;
    if (scale_node != nullptr)
      scale = static_cast<float>(ReadNumber(*scale_node, dice, {0.005, 50}));
    if (contrast_node != nullptr)
      style.contrast = static_cast<float>(ReadNumber(*contrast_node, dice, {0, 1}));
    material = Printed([=, draw = pattern.draw] { return draw(style); }, scale, scale);
  }
  ReadShine(reader, dice, &material);
  reader.Finish();
  return material;
}

}  // namespace

void MaterialShelf::Define(const SceneNode& materials, SceneDice& dice) {
  if (materials.kind != SceneNode::Kind::kMap) materials.FailExpected("a map of materials");
  for (std::size_t i = 0; i < materials.items.size(); ++i)
    materials_.insert_or_assign(materials.keys[i], Read(materials.items[i], dice));
}

Material MaterialShelf::Read(const SceneNode& given, SceneDice& dice) const {
  const SceneNode& node = Chosen(given, dice);
  if (node.kind == SceneNode::Kind::kMap) return ReadMap(node, dice);
  if (node.kind != SceneNode::Kind::kText) node.FailExpected("a material's name, or a map");
  if (!node.text.empty() && node.text[0] == '#') return Plastic(ReadColor(node, dice), 0.1F);
  const std::string name = ReadWord(node, dice);
  const auto found = materials_.find(name);
  if (found != materials_.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [known, material] : materials_) names.push_back(known);
  node.Fail("expected a material's name" + (names.empty() ? "" : " (" + JoinNames(names) + ")") +
            ", found '" + name + "'");
}

}  // namespace semslam
