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
constexpr std::array kCatalog = {
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
    CatalogEntry{"bottle", 0, {}, {}, [](const Size&, Seed seed) { return MakeBottle(seed); }},
    CatalogEntry{"notebook", 0, {}, {}, [](const Size&, Seed seed) { return MakeNotebook(seed); }},
    CatalogEntry{"laptop", 0, {}, {}, [](const Size&, Seed seed) { return MakeLaptop(seed); }},
    CatalogEntry{"phone", 0, {}, {}, [](const Size&, Seed seed) { return MakePhone(seed); }},
    CatalogEntry{"binder", 0, {}, {}, [](const Size&, Seed seed) { return MakeBinder(seed); }},
    CatalogEntry{"lamp", 0, {}, {}, [](const Size&, Seed seed) { return MakeDeskLamp(seed); }},
    CatalogEntry{
        "power_strip", 0, {}, {}, [](const Size&, Seed seed) { return MakePowerStrip(seed); }},
    CatalogEntry{"printer", 0, {}, {}, [](const Size&, Seed seed) { return MakePrinter(seed); }},
    CatalogEntry{"plant",
                 1,
                 {0.3F, 0, 0},
                 {1.2F, 0, 0},
                 [](const Size& s, Seed seed) { return MakePlant(s.x(), seed); }},
    // Furniture.
    CatalogEntry{"desk", 3, {1.3F, 0.7F, 0.72F}, {1.8F, 0.9F, 0.76F}, MakeDesk},
    CatalogEntry{"chair", 0, {}, {}, [](const Size&, Seed seed) { return MakeChair(seed); }},
    CatalogEntry{"sofa", 3, {1.4F, 0.8F, 0.75F}, {2.2F, 0.95F, 0.9F}, MakeSofa},
    CatalogEntry{"bookshelf", 3, {0.8F, 0.28F, 1.6F}, {1.2F, 0.34F, 2.1F}, MakeBookshelf},
    CatalogEntry{"cabinet", 3, {0.4F, 0.4F, 0.6F}, {1.2F, 0.55F, 1.6F}, MakeCabinet},
    CatalogEntry{"rug",
                 2,
                 {1.2F, 0.8F, 0},
                 {2.4F, 1.7F, 0},
                 [](const Size& s, Seed seed) { return MakeRug(s.x(), s.y(), seed); }},
    CatalogEntry{"bin", 0, {}, {}, [](const Size&, Seed seed) { return MakeBin(seed); }},
    // On walls.
    CatalogEntry{"poster",
                 2,
                 {0.3F, 0.4F, 0},
                 {0.6F, 0.8F, 0},
                 [](const Size& s, Seed seed) { return MakePoster(s.x(), s.y(), seed); }},
    CatalogEntry{"picture",
                 2,
                 {0.3F, 0.3F, 0},
                 {0.6F, 0.5F, 0},
                 [](const Size& s, Seed seed) { return MakePicture(s.x(), s.y(), seed); }},
    CatalogEntry{"whiteboard",
                 2,
                 {1.0F, 0.8F, 0},
                 {1.6F, 1.1F, 0},
                 [](const Size& s, Seed seed) { return MakeWhiteboard(s.x(), s.y(), seed); }},
    CatalogEntry{"clock", 0, {}, {}, [](const Size&, Seed seed) { return MakeClock(seed); }},
    CatalogEntry{"board",
                 2,
                 {0.6F, 0.2F, 0},
                 {1.0F, 0.3F, 0},
                 [](const Size& s, Seed seed) { return MakeShelf(s.x(), s.y(), seed); }},
    CatalogEntry{"window",
                 2,
                 {1.0F, 1.1F, 0},
                 {1.6F, 1.4F, 0},
                 [](const Size& s, Seed seed) { return MakeWindow(s.x(), s.y(), seed); }},
    CatalogEntry{"door",
                 2,
                 {0.95F, 2.05F, 0},
                 {1.05F, 2.15F, 0},
                 [](const Size& s, Seed seed) { return MakeDoor(s.x(), s.y(), seed); }},
    CatalogEntry{"radiator",
                 2,
                 {0.8F, 0.55F, 0},
                 {1.4F, 0.7F, 0},
                 [](const Size& s, Seed seed) { return MakeRadiator(s.x(), s.y(), seed); }},
    // The room.
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
