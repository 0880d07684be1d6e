// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "render/object_catalog.h"

#include <array>

#include "semslam/render/objects.h"

namespace semslam {
namespace {

using Eigen::Vector3f;

using Seed = std::uint64_t;
using Size = Vector3f;

// One line each: name, how many sizes, the smallest and largest usual one, how to make it.
const std::array kCatalog = {
    // On a desk.
    CatalogEntry{"mug", 0, {}, {}, [](const Size&, Seed seed) { return MakeMug(seed); }},
    CatalogEntry{"keyboard", 0, {}, {}, [](const Size&, Seed seed) { return MakeKeyboard(seed); }},
    CatalogEntry{"mouse", 0, {}, {}, [](const Size&, Seed seed) { return MakeMouse(seed); }},
    CatalogEntry{"monitor",
                 2,
                 {0.40F, 0.25F, 0},
                 {0.56F, 0.33F, 0},
                 [](const Size& s, Seed seed) { return MakeMonitor(s.x(), s.y(), seed); }},
    CatalogEntry{"bear",
                 1,
                 {0.2F, 0, 0},
                 {0.34F, 0, 0},
                 [](const Size& s, Seed seed) { return MakeTeddyBear(s.x(), seed); }},
    CatalogEntry{"book", 3, {0.19F, 0.13F, 0.016F}, {0.27F, 0.19F, 0.045F}, MakeBook},
    CatalogEntry{"box", 3, {0.12F, 0.1F, 0.07F}, {0.3F, 0.24F, 0.2F}, MakeCardboardBox},
    CatalogEntry{
        "telephone", 0, {}, {}, [](const Size&, Seed seed) { return MakeTelephone(seed); }},
    CatalogEntry{
        "pen_holder", 0, {}, {}, [](const Size&, Seed seed) { return MakePenHolder(seed); }},
    CatalogEntry{"paper", 0, {}, {}, [](const Size&, Seed seed) { return MakePaper(seed); }},
    // The room.
    CatalogEntry{"desk", 3, {1.3F, 0.7F, 0.72F}, {1.8F, 0.9F, 0.76F}, MakeDesk},
    CatalogEntry{"poster",
                 2,
                 {0.3F, 0.4F, 0},
                 {0.6F, 0.8F, 0},
                 [](const Size& s, Seed seed) { return MakePoster(s.x(), s.y(), seed); }},
    CatalogEntry{"board",
                 2,
                 {0.6F, 0.2F, 0},
                 {1.0F, 0.3F, 0},
                 [](const Size& s, Seed seed) { return MakeShelf(s.x(), s.y(), seed); }},
    CatalogEntry{"floor",
                 2,
                 {3, 3, 0},
                 {6, 6, 0},
                 [](const Size& s, Seed seed) { return MakeFloor(s.x(), s.y(), seed); }},
    CatalogEntry{"wall",
                 2,
                 {2, 2, 0},
                 {6, 3, 0},
                 [](const Size& s, Seed seed) { return MakeWall(s.x(), s.y(), seed); }},
    CatalogEntry{"ceiling",
                 2,
                 {3, 3, 0},
                 {6, 6, 0},
                 [](const Size& s, Seed seed) { return MakeCeiling(s.x(), s.y(), seed); }},
};

}  // namespace

std::span<const CatalogEntry> ObjectCatalog() { return kCatalog; }

}  // namespace semslam
