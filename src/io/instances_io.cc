// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/io/instances_io.h"

#include <algorithm>
#include <limits>
#include <set>

#include "io/json_fields.h"

namespace semslam {

std::vector<InstanceRecord> ReadInstances(const std::filesystem::path& path) {
  std::vector<InstanceRecord> instances;
  std::set<std::uint32_t> ids = {0};
  for (const JsonField& item : JsonField::FromFile(path)["instances"].Items()) {
    InstanceRecord record;
    record.id =
        static_cast<std::uint32_t>(item["id"].Unsigned(std::numeric_limits<std::uint16_t>::max()));
    if (!ids.insert(record.id).second) item["id"].Fail("an id above 0 of its own");
    record.class_name = item["class"].String();
    record.box.T_world_box = {item["orientation"].UnitQuaternion(), item["center"].Vector(3)};
    record.box.half_size = 0.5 * item["size"].Vector(3);
    if (record.box.half_size.minCoeff() < 0) item["size"].Fail("sizes of at least 0");
    instances.push_back(std::move(record));
  }
  std::sort(instances.begin(), instances.end(),
            [](const InstanceRecord& a, const InstanceRecord& b) { return a.id < b.id; });
  return instances;
}

}  // namespace semslam
