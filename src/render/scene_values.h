// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "semslam/base/random.h"

#include "render/scene_node.h"

namespace semslam {

// What the values of a scene file are drawn with: a generator, and the numbers that have names.
struct SceneDice {
  explicit SceneDice(std::uint64_t seed) : random(seed) {}

  Random random;
  std::map<std::string, double> numbers;  // "$name" in the file.
};

struct Limits {
  double low;
  double high;
};

// {choose: [a, b, ...]} stands for one of the list, drawn; everything else for itself.
const SceneNode& Chosen(const SceneNode& node, SceneDice& dice);

// A number: 0.3, a formula such as $i * 0.4 - 1 (+ - * / and brackets; sin and cos of degrees), or
// a range [low, high] from which it is drawn. Fails outside the limits.
double ReadNumber(const SceneNode& node, SceneDice& dice, const Limits& limits);
int ReadCount(const SceneNode& node, SceneDice& dice, const Limits& limits);
bool ReadSwitch(const SceneNode& node, SceneDice& dice);
// A word; "$name" in it is replaced by that number, rounded.
std::string ReadWord(const SceneNode& node, SceneDice& dice);
// A list of so many numbers, each as above.
std::vector<double> ReadNumbers(const SceneNode& node,
                                SceneDice& dice,
                                std::size_t min_size,
                                std::size_t max_size,
                                const Limits& limits);
Eigen::Vector3d ReadVector(const SceneNode& node, SceneDice& dice, const Limits& limits);
// '#rrggbb', [red, green, blue] from 0 to 1, or {hue, saturation, brightness} with the hue in
// degrees. Result: BGR, 0 to 1.
Eigen::Vector3f ReadColor(const SceneNode& node, SceneDice& dice);

}  // namespace semslam
