// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace semslam {

inline constexpr std::uint64_t kChecksumStart = 0xcbf29ce484222325;

// FNV-1a (Fowler, Noll, Vo) on 64-bit words instead of bytes; a last, incomplete word is filled up
// with zeros. Each step can be undone, so that a change to any one word changes the sum. Tells
// damage, not malice.
std::uint64_t AddToChecksum(std::uint64_t sum, std::span<const std::byte> bytes);

}  // namespace semslam
