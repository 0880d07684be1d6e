// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "semslam/render/scene.h"

namespace semslam {

// Things found in an office, in the frame that Object describes: they stand on z = 0, centred, and
// look along -y. Sizes in metres (width, depth, height). The seed picks colours, prints and
// proportions.

// Class "cup": hollow, with a handle on its +x side.
Object MakeMug(std::uint64_t seed);
// Class "keyboard": every key is a body of its own.
Object MakeKeyboard(std::uint64_t seed);
// Class "mouse": two buttons, a wheel, a cable.
Object MakeMouse(std::uint64_t seed);
// Class "tvmonitor": a screen that glows, on a foot.
Object MakeMonitor(float screen_width, float screen_height, std::uint64_t seed);
// Class "teddy bear": sits; head, ears, snout, arms, legs, fur.
Object MakeTeddyBear(float height, std::uint64_t seed);

// Class "book": lies on its back cover, spine towards -y.
Object MakeBook(const Eigen::Vector3f& size, std::uint64_t seed);
// Class "box": cardboard with tape and a label.
Object MakeCardboardBox(const Eigen::Vector3f& size, std::uint64_t seed);
// Class "telephone": wedge with keys, handset on top.
Object MakeTelephone(std::uint64_t seed);
// Class "pen holder": a hollow cylinder with pens.
Object MakePenHolder(std::uint64_t seed);
// Class "paper": a printed sheet.
Object MakePaper(std::uint64_t seed);

// Class "bottle": with a label and a cap.
Object MakeBottle(std::uint64_t seed);
// Class "notebook": a pad with a wire binding on its left.
Object MakeNotebook(std::uint64_t seed);
// Class "laptop": open, with keys and a screen that glows.
Object MakeLaptop(std::uint64_t seed);
// Class "cell phone": lies on its back.
Object MakePhone(std::uint64_t seed);
// Class "binder": a folder for paper, upright, spine towards -y.
Object MakeBinder(std::uint64_t seed);
// Class "lamp": with a foot and a bent arm.
Object MakeDeskLamp(std::uint64_t seed);
// Class "power strip": sockets, plugs, and cables that run to +y.
Object MakePowerStrip(std::uint64_t seed);
// Class "printer"
Object MakePrinter(std::uint64_t seed);
// Class "pottedplant"
Object MakePlant(float height, std::uint64_t seed);

// Class "desk": the top's upper face is at z = size.z.
Object MakeDesk(const Eigen::Vector3f& size, std::uint64_t seed);
// Class "chair": an office chair on castors, its back towards +y.
Object MakeChair(std::uint64_t seed);
// Class "sofa": its back towards +y; seats, arm rests, pillows.
Object MakeSofa(const Eigen::Vector3f& size, std::uint64_t seed);
// Class "shelf": a case of boards, each of which things can stand on, the lowest first.
Object MakeBookshelf(const Eigen::Vector3f& size, std::uint64_t seed);
// Class "cabinet": with doors or drawers.
Object MakeCabinet(const Eigen::Vector3f& size, std::uint64_t seed);
// Class "rug"
Object MakeRug(float width, float depth, std::uint64_t seed);
// Class "waste bin": hollow, with paper in it.
Object MakeBin(std::uint64_t seed);

// What hangs on a wall behind it, centred on its frame's origin: "poster"; "picture", framed;
// "whiteboard", written on, with pens on its ledge; "clock".
Object MakePoster(float width, float height, std::uint64_t seed);
Object MakePicture(float width, float height, std::uint64_t seed);
Object MakeWhiteboard(float width, float height, std::uint64_t seed);
Object MakeClock(std::uint64_t seed);
// Class "shelf": a board on a wall behind it; its upper face is at z = 0.
Object MakeShelf(float width, float depth, std::uint64_t seed);

// At a wall behind them, standing on z = 0: "window" (z = 0 is the top of its sill; daylight and a
// view behind it), "door", "radiator".
Object MakeWindow(float width, float height, std::uint64_t seed);
Object MakeDoor(float width, float height, std::uint64_t seed);
Object MakeRadiator(float width, float height, std::uint64_t seed);

// Class "floor": looks up, centred.
Object MakeFloor(float width, float depth, std::uint64_t seed);
// Class "wall": looks along -y, stands on z = 0.
Object MakeWall(float width, float height, std::uint64_t seed);
// Class "ceiling": looks down, its face at z = 0.
Object MakeCeiling(float width, float depth, std::uint64_t seed);

}  // namespace semslam
