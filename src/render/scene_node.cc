// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_node.h"

#include <algorithm>
#include <exception>
#include <numeric>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "semslam/base/error.h"

namespace semslam {
namespace {

constexpr std::size_t kMaxBytes = 1U << 20U;
constexpr std::size_t kMaxNodes = 50000;  // After aliases are followed: no "billion laughs".
constexpr std::size_t kMaxKeys = 2000;    // Of one map.
constexpr int kMaxDepth = 24;
constexpr std::size_t kMaxShown = 40;  // Letters of a text in a message.

// Printable on one line, and not too long.
std::string Shown(const std::string& text) {
  std::string shown;
  for (const char c : text.substr(0, kMaxShown)) {
    shown += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return text.size() > kMaxShown ? shown + "..." : shown;
}

std::string KeyOf(const YAML::Node& key) { return key.IsScalar() ? key.Scalar() : std::string(); }

class Converter {
 public:
  explicit Converter(std::string file)
      : file_(std::make_shared<const std::string>(std::move(file))) {}

  SceneNode Convert(const YAML::Node& yaml, const std::string& where, int depth, int line) {
    SceneNode node;
    node.file = file_;
    node.where = where;
    node.line = yaml.Mark().line >= 0 ? yaml.Mark().line + 1 : line;
    if (depth > kMaxDepth)
      node.Fail("expected at most " + std::to_string(kMaxDepth) + " levels, found more");
    if (++num_nodes_ > kMaxNodes)
      node.Fail("expected at most " + std::to_string(kMaxNodes) + " values, found more");
    if (yaml.IsScalar()) {
      node.kind = SceneNode::Kind::kText;
      node.text = yaml.Scalar();
    } else if (yaml.IsSequence()) {
      ConvertList(yaml, depth, &node);
    } else if (yaml.IsMap()) {
      ConvertMap(yaml, depth, &node);
    }
    return node;
  }

 private:
  void ConvertList(const YAML::Node& yaml, int depth, SceneNode* node) {
    node->kind = SceneNode::Kind::kList;
    for (const YAML::Node& item : yaml) {
      const std::string where = node->where + '[' + std::to_string(node->items.size()) + ']';
      node->items.push_back(Convert(item, where, depth + 1, node->line));
    }
  }

  void ConvertMap(const YAML::Node& yaml, int depth, SceneNode* node) {
    node->kind = SceneNode::Kind::kMap;
    for (const auto& entry : yaml) {
      const std::string key = KeyOf(entry.first);
      const int line = entry.first.Mark().line + 1;
      if (key.empty()) FailAtKey(*node, line, "expected a word as key, found something else");
      if (node->Find(key) != nullptr)
        FailAtKey(*node, line, "key '" + Shown(key) + "' is there twice");
      if (node->keys.size() >= kMaxKeys)
        FailAtKey(*node, line,
                  "expected at most " + std::to_string(kMaxKeys) + " keys, found more");
      const std::string where = node->where + (node->where.empty() ? "" : ".") + Shown(key);
      node->items.push_back(Convert(entry.second, where, depth + 1, line));
      node->keys.push_back(key);
    }
  }

  [[noreturn]] static void FailAtKey(const SceneNode& map, int line, const std::string& what) {
    SceneNode key;
    key.file = map.file;
    key.where = map.where;
    key.line = line;
    key.Fail(what);
  }

  std::shared_ptr<const std::string> file_;
  std::size_t num_nodes_ = 0;
};

// Levenshtein's distance.
std::size_t NumEdits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, row[k + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

const SceneNode* SceneNode::Find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

std::string SceneNode::Described() const {
  switch (kind) {
    case Kind::kText:
      return '\'' + Shown(text) + '\'';
    case Kind::kList:
      return "a list of " + std::to_string(items.size());
    case Kind::kMap:
      return "a map";
    case Kind::kNothing:
      break;
  }
  return "nothing";
}

void SceneNode::Fail(const std::string& what) const {
  throw InputError(*file + ':' + std::to_string(line) + ": " + (where.empty() ? "" : where + ": ") +
                   what);
}

void SceneNode::FailExpected(const std::string& expected) const {
  Fail("expected " + expected + ", found " + Described());
}

SceneNode ParseSceneYaml(const std::string& text, const std::string& file) {
  if (text.size() > kMaxBytes) {
    throw InputError(file + ":1: expected at most " + std::to_string(kMaxBytes) + " bytes, found " +
                     std::to_string(text.size()));
  }
  if (text.find('\0') != std::string::npos)
    throw InputError(file + ":1: expected YAML text, found a binary file");
  try {
    return Converter(file).Convert(YAML::Load(text), "", 0, 1);
  } catch (const YAML::Exception& error) {
    const int line = error.mark.line >= 0 ? error.mark.line + 1 : 1;
    throw InputError(file + ':' + std::to_string(line) +
                     ": expected YAML, found what is none: " + Shown(error.msg));
  }
}

std::string NearestName(std::string_view name, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(2, name.size() / 3) + 1;
  for (const std::string& candidate : names) {
    if (candidate.size() > 64 || name.size() > 64) continue;
    const std::size_t num_edits = NumEdits(name, candidate);
    if (num_edits < fewest) {
      fewest = num_edits;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string JoinNames(const std::vector<std::string>& names) {
  std::string joined;
  for (const std::string& name : names) joined += (joined.empty() ? "" : ", ") + name;
  return joined;
}

MapReader::MapReader(const SceneNode& node) : node_(&node) {
  if (node.kind != SceneNode::Kind::kMap) node.FailExpected("a map of keys and values");
}

const SceneNode* MapReader::Find(const std::string& key) {
  known_.push_back(key);
  return node_->Find(key);
}

const SceneNode& MapReader::Get(const std::string& key) {
  const SceneNode* found = Find(key);
  if (found == nullptr) node_->Fail("expected a key '" + key + "', found none");
  return *found;
}

void MapReader::Finish() const {
  for (std::size_t i = 0; i < node_->keys.size(); ++i) {
    const std::string& key = node_->keys[i];
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const std::string nearest = NearestName(key, known_);
    std::vector<std::string> known = known_;
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    node_->items[i].Fail("unknown key, " + (nearest.empty() ? "expected one of " + JoinNames(known)
                                                            : "did you mean '" + nearest + "'?"));
  }
}

}  // namespace semslam
