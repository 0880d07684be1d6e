// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semantics/detection_json.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <nlohmann/json.hpp>

#include "semslam/base/error.h"

namespace semslam {
namespace {

using Json = nlohmann::json;

// One entry of the list.
class Entry {
 public:
  Entry(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    if (!json.is_object()) Fail("an object", json);
  }

  Detection Parse(const ClassTable& classes) const {
    Detection detection;
    detection.class_id = ParseClass(classes);
    detection.score = ParseScore();
    detection.box = ParseBox();
    detection.class_scores.assign(classes.size(), 0.0F);
    detection.class_scores[static_cast<std::size_t>(detection.class_id)] = detection.score;
    return detection;
  }

 private:
  [[noreturn]] void Fail(const std::string& expected, const Json& found) const {
    throw InputError(where_ + ": expected " + expected + ", found " +
                     found.dump(-1, ' ', false, Json::error_handler_t::replace));
  }

  // By name if it has one, else by number.
  int ParseClass(const ClassTable& classes) const {
    const auto name = json_.find("name");
    if (name != json_.end() && name->is_string()) {
      if (const auto id = classes.Find(name->get<std::string>())) return *id;
      Fail("a name of the class table", *name);
    }
    const auto number = json_.find("class");
    const bool is_id = number != json_.end() && number->is_number_integer() &&
                       number->get<std::int64_t>() >= 0 &&
                       number->get<std::int64_t>() < static_cast<std::int64_t>(classes.size());
    if (!is_id) Fail("a name, or a class from 0 to " + std::to_string(classes.size() - 1), json_);
    return number->get<int>();
  }

  float ParseScore() const {
    for (const char* key : {"confidence", "score"}) {
      const auto score = json_.find(key);
      if (score == json_.end()) continue;
      const bool is_score =
          score->is_number() && score->get<double>() >= 0 && score->get<double>() <= 1;
      if (!is_score) Fail(std::string(key) + " in [0, 1]", *score);
      return score->get<float>();
    }
    return 1;
  }

  ImageBox ParseBox() const {
    const auto box = json_.find("box");
    std::array<float, 4> sides{};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      constexpr std::array kKeys = {"x1", "y1", "x2", "y2"};
      const Json* side = nullptr;
      if (box != json_.end() && box->is_object() && box->contains(kKeys[i])) {
        side = &(*box)[kKeys[i]];
      } else if (box != json_.end() && box->is_array() && box->size() == sides.size()) {
        side = &(*box)[i];
      }
      if (side == nullptr || !side->is_number() || !std::isfinite(side->get<float>())) {
        Fail("box: {x1, y1, x2, y2} or [x1, y1, x2, y2]", json_);
      }
      sides[i] = side->get<float>();
    }
    return {sides[0], sides[1], sides[2], sides[3]};
  }

  const Json& json_;
  std::string where_;
};

}  // namespace

std::vector<Detection> ParseJsonDetections(const std::string& text,
                                           const std::string& file,
                                           const ClassTable& classes) {
  Json list;
  try {
    list = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InputError(file + ": no JSON: byte " + std::to_string(error.byte));
  }
  if (!list.is_array()) throw InputError(file + ": expected a list of detections");
  std::vector<Detection> detections;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Entry entry(list[i], file + ": [" + std::to_string(i) + "]");
    detections.push_back(entry.Parse(classes));
  }
  return detections;
}

}  // namespace semslam
