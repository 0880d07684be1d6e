// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/json_fields.h"

#include <cmath>

#include "semslam/base/error.h"

#include "io/text_file.h"

namespace semslam {

JsonField JsonField::FromFile(const std::filesystem::path& path) {
  const std::string text = ReadWholeFile(path);
  try {
    return {path.string(), "", nlohmann::json::parse(text)};
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(path.string() + ": expected JSON, found an error at byte " +
                     std::to_string(error.byte));
  }
}

JsonField JsonField::operator[](const std::string& name) const {
  if (!value_.is_object()) Fail("an object");
  const std::string full_name = name_.empty() ? name : name_ + '.' + name;
  const auto found = value_.find(name);
  if (found == value_.end()) throw InputError(file_ + ": " + full_name + ": missing");
  return {file_, full_name, *found};
}

std::vector<JsonField> JsonField::Items() const {
  if (!value_.is_array()) Fail("an array");
  std::vector<JsonField> items;
  items.reserve(value_.size());
  for (std::size_t i = 0; i < value_.size(); ++i) {
    items.push_back(JsonField(file_, name_ + '[' + std::to_string(i) + ']', value_[i]));
  }
  return items;
}

std::string JsonField::String() const {
  if (!value_.is_string()) Fail("a text");
  return value_.get<std::string>();
}

std::uint64_t JsonField::Unsigned(std::uint64_t max) const {
  if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > max) {
    Fail("a whole number from 0 to " + std::to_string(max));
  }
  return value_.get<std::uint64_t>();
}

double JsonField::Number() const {
  if (!value_.is_number() || !std::isfinite(value_.get<double>())) Fail("a number");
  return value_.get<double>();
}

Eigen::VectorXd JsonField::Vector(int size) const {
  if (!value_.is_array() || value_.size() != static_cast<std::size_t>(size)) {
    Fail(std::to_string(size) + " numbers");
  }
  Eigen::VectorXd vector(size);
  const std::vector<JsonField> items = Items();
  for (int i = 0; i < size; ++i) vector[i] = items[static_cast<std::size_t>(i)].Number();
  return vector;
}

Eigen::Quaterniond JsonField::UnitQuaternion() const {
  const Eigen::Vector4d xyzw = Vector(4);
  constexpr double kTolerance = 1e-3;
  if (std::abs(xyzw.norm() - 1.0) > kTolerance) Fail("a quaternion of length 1");
  return Eigen::Quaterniond(xyzw).normalized();
}

void JsonField::Fail(const std::string& expected) const {
  throw InputError(file_ + ": " + (name_.empty() ? "" : name_ + ": ") + "expected " + expected +
                   ", found " +
                   Quoted(value_.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)));
}

}  // namespace semslam
