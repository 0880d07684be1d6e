// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace semslam {

// A value in a JSON file that knows where it stands, so that what is missing or of the wrong kind
// is an InputError like `a/objects.json: objects[2].center: expected 3 numbers, found "x"`.
class JsonField {
 public:
  // Reads and parses the file. Throws InputError.
  static JsonField FromFile(const std::filesystem::path& path);

  // A member of an object, which must be there.
  JsonField operator[](const std::string& name) const;
  // The members of an array.
  std::vector<JsonField> Items() const;

  std::string String() const;
  std::uint64_t Unsigned(std::uint64_t max) const;
  double Number() const;
  // A finite number for each entry.
  Eigen::VectorXd Vector(int size) const;
  Eigen::Quaterniond UnitQuaternion() const;  // From x, y, z, w of about unit length.

  [[noreturn]] void Fail(const std::string& expected) const;

 private:
  JsonField(std::string file, std::string name, nlohmann::json value)
      : file_(std::move(file)), name_(std::move(name)), value_(std::move(value)) {}

  std::string file_;
  std::string name_;  // Names and numbers from the root on; empty at the root.
  nlohmann::json value_;
};

}  // namespace semslam
