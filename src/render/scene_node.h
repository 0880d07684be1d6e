// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace semslam {

// A value in a scene file, with where it stands for messages: a text, a list or a map. Our own
// small tree, so that what is limited (size, depth, number of values) is limited in one place.
struct SceneNode {
  enum class Kind { kNothing, kText, kList, kMap };

  Kind kind = Kind::kNothing;
  int line = 0;       // From 1.
  std::string where;  // "objects[2].size"; empty for the whole file.
  std::shared_ptr<const std::string> file;
  std::string text;
  std::vector<std::string> keys;  // Of a map: keys[i] is that of items[i].
  std::vector<SceneNode> items;

  const SceneNode* Find(std::string_view key) const;
  // "'abc'", "a list of 3", "a map", "nothing".
  std::string Described() const;
  // Throws InputError: "FILE:LINE: WHERE: what".
  [[noreturn]] void Fail(const std::string& what) const;
  // "expected WHAT, found (this)".
  [[noreturn]] void FailExpected(const std::string& expected) const;
};

// Parses YAML. Throws InputError for what is none, has a key twice, or is out of all proportion.
SceneNode ParseSceneYaml(const std::string& text, const std::string& file);

// The one of the names that is most like the given one; empty if none is.
std::string NearestName(std::string_view name, const std::vector<std::string>& names);
// "a, b, c"
std::string JoinNames(const std::vector<std::string>& names);

// Reads a map key by key, and complains about keys that nobody asked for.
class MapReader {
 public:
  // Fails if the node is no map.
  explicit MapReader(const SceneNode& node);

  const SceneNode* Find(const std::string& key);
  // Fails if there is no such key.
  const SceneNode& Get(const std::string& key);
  // Fails at the first key that was never asked for.
  void Finish() const;

  const SceneNode& node() const { return *node_; }

 private:
  const SceneNode* node_;
  std::vector<std::string> known_;
};

}  // namespace semslam
