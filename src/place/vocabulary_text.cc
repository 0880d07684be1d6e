// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>

#include "semslam/base/error.h"

#include "place/vocabulary_file.h"

namespace semslam {
namespace {

using Node = Vocabulary::Node;

constexpr int kDescriptorBytes = 32;

// Walks over the numbers of a text, line by line.
class Scanner {
 public:
  Scanner(std::span<const std::byte> file, const std::filesystem::path& path)
      : next_(reinterpret_cast<const char*>(file.data())), end_(next_ + file.size()), path_(path) {}

  bool is_at_end() const { return next_ == end_; }
  int line() const { return line_; }

  [[noreturn]] void Fail(const std::string& what) const { FailAt(line_, what); }
  [[noreturn]] void FailAt(int line, const std::string& what) const {
    throw InputError(path_.string() + ":" + std::to_string(line) + ": " + what);
  }

  // A whole number 0 ... max.
  std::uint32_t ReadNumber(std::uint32_t max, const char* meaning) {
    SkipBlanks();
    const char* const start = next_;
    std::uint64_t value = 0;
    for (; next_ != end_ && *next_ >= '0' && *next_ <= '9' && value <= max; ++next_) {
      value = value * 10 + static_cast<std::uint64_t>(*next_ - '0');
    }
    if (next_ == start || value > max || !IsAtBlank()) {
      next_ = start;
      Fail(std::string(meaning) + ": expected a whole number up to " + std::to_string(max) +
           ", found " + Quote());
    }
    return static_cast<std::uint32_t>(value);
  }

  float ReadWeight() {
    SkipBlanks();
    const char* const start = next_;
    double value = 0;
    const auto [stop, error] = std::from_chars(next_, end_, value);
    if (error == std::errc()) next_ = stop;
    if (error != std::errc() || !IsAtBlank() || !std::isfinite(static_cast<float>(value)) ||
        value < 0) {
      next_ = start;
      Fail("weight: expected a number >= 0, found " + Quote());
    }
    return static_cast<float>(value);
  }

  void EndLine() {
    SkipBlanks();
    if (is_at_end()) Fail("cut short: expected the line to end with a line break");
    if (*next_ != '\n') Fail("expected the end of the line, found " + Quote());
    ++next_;
    ++line_;
  }

 private:
  static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  bool IsAtBlank() const { return next_ == end_ || IsBlank(*next_) || *next_ == '\n'; }
  void SkipBlanks() {
    while (next_ != end_ && IsBlank(*next_)) ++next_;
  }
  // The next word, shortened and made printable.
  std::string Quote() const {
    if (is_at_end()) return "the end of the file";
    if (*next_ == '\n') return "the end of the line";
    constexpr std::ptrdiff_t kMaxLength = 20;
    const char* const stop = std::find_if(next_, next_ + std::min(kMaxLength, end_ - next_),
                                          [](char c) { return IsBlank(c) || c == '\n'; });
    std::string text(next_, stop);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return '\'' + text + '\'';
  }

  const char* next_;
  const char* end_;
  const std::filesystem::path& path_;
  int line_ = 1;
};

// The lines of a file; line i + 2 is node i + 1.
struct Lines {
  std::vector<std::uint32_t> parents;
  std::vector<bool> is_leaf;
  std::vector<float> weights;
  std::vector<Descriptor> descriptors;
};

Descriptor ReadDescriptor(Scanner& scanner) {
  Descriptor descriptor;
  for (int byte = 0; byte < kDescriptorBytes; ++byte) {
    const std::uint64_t value = scanner.ReadNumber(255, "descriptor");
    descriptor.bits[byte / 8] |= value << (8 * (byte % 8));
  }
  return descriptor;
}

Lines ReadLines(Scanner& scanner, std::size_t file_size) {
  // Shortest line: "0 1", 32 times " 0", " 0" and the line break.
  constexpr std::size_t kTypicalLine = 120;
  Lines lines;
  lines.parents.reserve(file_size / kTypicalLine);
  lines.is_leaf.reserve(file_size / kTypicalLine);
  lines.weights.reserve(file_size / kTypicalLine);
  lines.descriptors.reserve(file_size / kTypicalLine);
  while (!scanner.is_at_end()) {
    const auto num_before = static_cast<std::uint32_t>(lines.parents.size());
    const std::uint32_t parent = scanner.ReadNumber(num_before, "parent (an earlier line)");
    if (parent > 0 && lines.is_leaf[parent - 1]) {
      scanner.Fail("parent: expected an inner node, found leaf " + std::to_string(parent));
    }
    lines.parents.push_back(parent);
    lines.is_leaf.push_back(scanner.ReadNumber(1, "leaf flag") == 1);
    lines.descriptors.push_back(ReadDescriptor(scanner));
    lines.weights.push_back(scanner.ReadWeight());
    scanner.EndLine();
  }
  return lines;
}

// The children of each node in the order of the file: those of node p are
// ids[begin[p]] ... ids[begin[p + 1] - 1].
struct Children {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> ids;
};

Children ListChildren(const std::vector<std::uint32_t>& parents) {
  const std::size_t num_nodes = parents.size() + 1;
  Children children{std::vector<std::uint32_t>(num_nodes + 1, 0),
                    std::vector<std::uint32_t>(parents.size())};
  for (const std::uint32_t parent : parents) ++children.begin[parent + 1];
  std::partial_sum(children.begin.begin(), children.begin.end(), children.begin.begin());
  std::vector<std::uint32_t> next(children.begin.begin(), children.begin.end() - 1);
  for (std::size_t i = 0; i < parents.size(); ++i) {
    children.ids[next[parents[i]]++] = static_cast<std::uint32_t>(i + 1);
  }
  return children;
}

// Renumbers breadth first.
void LayOut(const Lines& lines, const Scanner& scanner, ParsedVocabulary& result) {
  const Children children = ListChildren(lines.parents);
  const std::size_t num_nodes = lines.parents.size() + 1;
  std::vector<std::uint32_t> order{0};  // Number in the file of each node.
  order.reserve(num_nodes);
  result.nodes.reserve(num_nodes);
  result.descriptors.reserve(num_nodes);
  std::uint32_t num_words = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t id = order[i];
    const std::uint32_t first = children.begin[id];
    const std::uint32_t num_children = children.begin[id + 1] - first;
    const bool is_leaf = id > 0 && lines.is_leaf[id - 1];
    if (!is_leaf && num_children == 0) {
      scanner.FailAt(static_cast<int>(id) + 1,
                     id == 0 ? "expected a node on each further line, found none"
                             : "cut short: an inner node without children");
    }
    result.nodes.push_back({is_leaf ? num_words++ : static_cast<std::uint32_t>(order.size()),
                            num_children, is_leaf ? lines.weights[id - 1] : 0.0F});
    result.descriptors.push_back(id == 0 ? Descriptor{} : lines.descriptors[id - 1]);
    order.insert(order.end(), children.ids.begin() + first,
                 children.ids.begin() + first + num_children);
  }
}

}  // namespace

ParsedVocabulary ParseText(std::span<const std::byte> file, const std::filesystem::path& path) {
  Scanner scanner(file, path);
  ParsedVocabulary result;
  result.branching = static_cast<int>(scanner.ReadNumber(kMaxBranching, "branching"));
  result.depth = static_cast<int>(scanner.ReadNumber(kMaxDepth, "depth"));
  scanner.ReadNumber(0, "scoring (only 0 = L1 is supported)");
  scanner.ReadNumber(0, "weighting (only 0 = tf-idf is supported)");
  scanner.EndLine();
  LayOut(ReadLines(scanner, file.size()), scanner, result);
  return result;
}

std::string FormatText(const VocabularyArrays& tree) {
  std::string text = std::to_string(tree.branching) + ' ' + std::to_string(tree.depth) + " 0 0\n";
  std::vector<std::size_t> parents(tree.nodes.size(), 0);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& node = tree.nodes[i];
    const bool is_leaf = node.num_children == 0;
    for (std::uint32_t c = 0; c < node.num_children; ++c) parents[node.first_child + c] = i;
    if (i == 0) continue;  // The root has no line.
    text += std::to_string(parents[i]) + (is_leaf ? " 1" : " 0");
    for (int byte = 0; byte < kDescriptorBytes; ++byte) {
      text += ' ';
      text += std::to_string((tree.descriptors[i].bits[byte / 8] >> (8 * (byte % 8))) & 0xff);
    }
    std::array<char, 32> weight{};
    const auto end = std::to_chars(weight.data(), weight.data() + weight.size(), node.weight).ptr;
    text += ' ';
    text.append(weight.data(), end);
    text += '\n';
  }
  return text;
}

}  // namespace semslam
