// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "script.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace semslam::testing {
namespace {

bool ReadWords(std::istream& values, std::vector<std::string>& words) {
  words.assign(std::istream_iterator<std::string>(values), {});
  return !words.empty();
}

bool ReadLine(const std::string& key, std::istream& values, Script& script) {
  if (key == "size") return static_cast<bool>(values >> script.width >> script.height);
  if (key == "fps") return static_cast<bool>(values >> script.fps);
  if (key == "clip") {
    return static_cast<bool>(values >> script.clip >> script.associations >> script.depth_factor);
  }
  if (key == "color") return ReadWords(values, script.color_formats);
  if (key == "depth") return ReadWords(values, script.depth_formats);
  if (key == "absent") return script.is_absent = true;
  if (key == "locked") return static_cast<bool>(std::getline(values >> std::ws, script.lock));
  if (key == "refuse") {
    std::string what;
    values >> what;
    return script.refused.insert(what).second;
  }
  if (key == "unplug" || key == "stall" || key == "no_color" || key == "no_depth" ||
      key == "format" || key == "gray") {
    Script::Fault fault{.kind = key};
    if (!(values >> fault.begin >> fault.end)) return false;
    fault.end += fault.begin;
    script.faults.push_back(fault);
    return true;
  }
  return false;
}

}  // namespace

bool Script::IsOn(const std::string& kind, double time) const {
  return std::any_of(faults.begin(), faults.end(), [&](const Fault& fault) {
    return fault.kind == kind && time >= fault.begin && time < fault.end;
  });
}

Script ReadScript(const std::filesystem::path& path) {
  Script script;
  std::ifstream file(path);  // OpenNI2 loads drivers in another working folder: an absolute path.
  if (!file) throw std::runtime_error(path.string() + ": no such script");
  for (std::string line; std::getline(file, line);) {
    std::istringstream values(line);
    std::string key;
    if (!(values >> key)) continue;
    if (!ReadLine(key, values, script)) throw std::runtime_error(path.string() + ": " + line);
  }
  return script;
}

}  // namespace semslam::testing
