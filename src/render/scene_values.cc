// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/scene_values.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

namespace semslam {
namespace {

constexpr std::size_t kMaxFormula = 200;  // Letters: limits the nesting of brackets, too.

bool IsNameLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string Shown(double number) {
  std::ostringstream stream;
  stream << number;
  return stream.str();
}

// The formula's grammar, by recursive descent: sum = product {(+|-) product}, product = factor
// {(*|/) factor}, factor = [-] (number | $name | sin(sum) |
// cos(sum) | (sum)).
class Formula {
 public:
  Formula(const SceneNode& node, const SceneDice& dice) : node_(node), dice_(dice) {
    if (node.text.size() > kMaxFormula) Fail();
  }

  double Value() {
    const double value = Sum();
    if (Next() != 0) Fail();
    return value;
  }

 private:
  [[noreturn]] void Fail() const { node_.FailExpected("a number"); }

  // The next letter that is no space; 0 at the end.
  char Next() {
    while (at_ < node_.text.size() && node_.text[at_] == ' ') ++at_;
    return at_ < node_.text.size() ? node_.text[at_] : '\0';
  }

  double Sum() {
    double sum = Product();
    for (char sign = Next(); sign == '+' || sign == '-'; sign = Next()) {
      ++at_;
      sum += (sign == '+' ? 1 : -1) * Product();
    }
    return sum;
  }

  double Product() {
    double product = Factor();
    for (char sign = Next(); sign == '*' || sign == '/'; sign = Next()) {
      ++at_;
      const double factor = Factor();
      product = sign == '*' ? product * factor : product / factor;
    }
    return product;
  }

  double Factor() {
    const char first = Next();
    if (first == '-') {
      ++at_;
      return -Factor();
    }
    if (first == '$') return Named();
    if (first == 's' || first == 'c') return Wave();
    if (first != '(') return Literal();
    ++at_;
    const double sum = Sum();
    if (Next() != ')') Fail();
    ++at_;
    return sum;
  }

  // sin or cos of an angle in degrees, in brackets.
  double Wave() {
    const std::string name = node_.text.substr(at_, 3);
    if (name != "sin" && name != "cos") Fail();
    at_ += 3;
    if (Next() != '(') Fail();
    const double angle = Factor() * std::numbers::pi / 180.0;
    return name == "sin" ? std::sin(angle) : std::cos(angle);
  }

  double Named() {
    const std::size_t start = ++at_;
    while (at_ < node_.text.size() && IsNameLetter(node_.text[at_])) ++at_;
    const std::string name = node_.text.substr(start, at_ - start);
    const auto found = dice_.numbers.find(name);
    if (found == dice_.numbers.end())
      node_.Fail("expected the name of a number, found '$" + name + "'");
    return found->second;
  }

  double Literal() {
    double value = 0;
    const char* begin = node_.text.data() + at_;
    const auto [end, error] = std::from_chars(begin, node_.text.data() + node_.text.size(), value);
    if (error != std::errc() || end == begin) Fail();
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }

  const SceneNode& node_;
  const SceneDice& dice_;
  std::size_t at_ = 0;
};

double Checked(const SceneNode& node, double value, const Limits& limits) {
  if (value >= limits.low && value <= limits.high) return value;  // False for NaN.
  node.Fail("expected a number in [" + Shown(limits.low) + ", " + Shown(limits.high) + "], found " +
            Shown(value));
}

double ReadText(const SceneNode& node, const SceneDice& dice, const Limits& limits) {
  if (node.kind != SceneNode::Kind::kText) node.FailExpected("a number or a range [low, high]");
  return Checked(node, Formula(node, dice).Value(), limits);
}

Eigen::Vector3f ColorOfHex(const SceneNode& node) {
  unsigned value = 0;
  const char* end = node.text.data() + node.text.size();
  const bool is_hex = node.text.size() == 7 && node.text[0] == '#';
  if (!is_hex || std::from_chars(node.text.data() + 1, end, value, 16).ptr != end)
    node.FailExpected("a colour '#rrggbb'");
  return Eigen::Vector3f(static_cast<float>(value & 255U), static_cast<float>((value >> 8U) & 255U),
                         static_cast<float>(value >> 16U)) /
         255.0F;
}

Eigen::Vector3f ColorOfHue(double hue_deg, double saturation, double brightness) {
  Eigen::Vector3f bgr;
  for (int k = 0; k < 3; ++k) {  // Blue is at 240, green at 120, red at 0 degrees.
    const double distance = std::abs(std::remainder(hue_deg - 120.0 * (2 - k), 360.0)) / 60.0;
    const double pure = std::min(1.0, std::max(0.0, 2.0 - distance));
    bgr[k] = static_cast<float>(brightness * (1.0 - saturation + saturation * pure));
  }
  return bgr;
}

}  // namespace

const SceneNode& Chosen(const SceneNode& node, SceneDice& dice) {
  if (node.kind != SceneNode::Kind::kMap || node.keys.size() != 1 || node.keys[0] != "choose")
    return node;
  const SceneNode& list = node.items[0];
  if (list.kind != SceneNode::Kind::kList || list.items.empty())
    list.FailExpected("a list to choose from");
  return Chosen(list.items[dice.random.Index(static_cast<std::uint32_t>(list.items.size()))], dice);
}

double ReadNumber(const SceneNode& given, SceneDice& dice, const Limits& limits) {
  const SceneNode& node = Chosen(given, dice);
  if (node.kind != SceneNode::Kind::kList) return ReadText(node, dice, limits);
  if (node.items.size() != 2) node.FailExpected("a number or a range [low, high]");
  const double low = ReadText(node.items[0], dice, limits);
  const double high = ReadText(node.items[1], dice, limits);
  if (low > high)
    node.Fail("expected a range [low, high], found [" + Shown(low) + ", " + Shown(high) + "]");
  return dice.random.Uniform(low, high);
}

int ReadCount(const SceneNode& given, SceneDice& dice, const Limits& limits) {
  const SceneNode& node = Chosen(given, dice);
  if (node.kind == SceneNode::Kind::kList && node.items.size() == 2) {  // Both ends are drawn.
    const double low = std::ceil(ReadText(node.items[0], dice, limits));
    const double high = std::floor(ReadText(node.items[1], dice, limits));
    if (low > high) node.FailExpected("a range [low, high] of counts");
    return static_cast<int>(low) +
           static_cast<int>(dice.random.Index(static_cast<std::uint32_t>(high - low) + 1));
  }
  const double value = ReadText(node, dice, limits);
  if (value != std::floor(value)) node.FailExpected("a whole number");
  return static_cast<int>(value);
}

bool ReadSwitch(const SceneNode& given, SceneDice& dice) {
  const SceneNode& node = Chosen(given, dice);
  if (node.text != "true" && node.text != "false") node.FailExpected("true or false");
  return node.text == "true";
}

std::string ReadWord(const SceneNode& given, SceneDice& dice) {
  const SceneNode& node = Chosen(given, dice);
  if (node.kind != SceneNode::Kind::kText || node.text.empty() || node.text.size() > 64)
    node.FailExpected("a word");
  std::string word;
  for (std::size_t at = 0; at < node.text.size();) {
    if (node.text[at] != '$') {
      if (static_cast<unsigned char>(node.text[at]) < 0x20) node.FailExpected("a word on one line");
      word += node.text[at++];
      continue;
    }
    std::size_t end = at + 1;
    while (end < node.text.size() && IsNameLetter(node.text[end])) ++end;
    SceneNode name = node;
    name.text = node.text.substr(at, end - at);
    word += std::to_string(std::lround(ReadText(name, dice, {-1e6, 1e6})));
    at = end;
  }
  return word;
}

std::vector<double> ReadNumbers(const SceneNode& given,
                                SceneDice& dice,
                                std::size_t min_size,
                                std::size_t max_size,
                                const Limits& limits) {
  const SceneNode& node = Chosen(given, dice);
  const bool is_list = node.kind == SceneNode::Kind::kList;
  if (!is_list || node.items.size() < min_size || node.items.size() > max_size) {
    node.FailExpected("a list of " + std::to_string(min_size) +
                      (max_size > min_size ? " or " + std::to_string(max_size) : "") + " numbers");
  }
  std::vector<double> numbers;
  for (const SceneNode& item : node.items) numbers.push_back(ReadNumber(item, dice, limits));
  return numbers;
}

Eigen::Vector3d ReadVector(const SceneNode& node, SceneDice& dice, const Limits& limits) {
  const std::vector<double> numbers = ReadNumbers(node, dice, 3, 3, limits);
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Vector3f ReadColor(const SceneNode& given, SceneDice& dice) {
  const SceneNode& node = Chosen(given, dice);
  if (node.kind == SceneNode::Kind::kText) return ColorOfHex(node);
  if (node.kind == SceneNode::Kind::kList)
    return ReadVector(node, dice, {0, 1}).cast<float>().reverse();
  if (node.kind != SceneNode::Kind::kMap)
    node.FailExpected("a colour '#rrggbb', [red, green, blue] or {hue, saturation, brightness}");
  MapReader reader(node);
  const double hue = ReadNumber(reader.Get("hue"), dice, {-360, 720});
  const double saturation = ReadNumber(reader.Get("saturation"), dice, {0, 1});
  const double brightness = ReadNumber(reader.Get("brightness"), dice, {0, 1});
  reader.Finish();
  return ColorOfHue(hue, saturation, brightness);
}

}  // namespace semslam
