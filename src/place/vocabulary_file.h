// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "semslam/place/vocabulary.h"

namespace semslam {

// The tree of a vocabulary as arrays that someone else owns.
struct VocabularyArrays {
  int branching = 0;
  int depth = 0;
  std::span<const Vocabulary::Node> nodes;
  std::span<const Descriptor> descriptors;
};

// Limits beyond which a header is taken for nonsense.
inline constexpr int kMaxBranching = 256;
inline constexpr int kMaxDepth = 16;

// What is wrong with a tree that should be laid out as Vocabulary says; nothing if it is sound.
std::optional<std::string> FindFault(const VocabularyArrays& tree);

bool IsBinaryVocabulary(std::span<const std::byte> file);

// The arrays of a binary file, in place; checks size, version and checksum, not the tree. Throws
// InputError, with `path` as the place.
VocabularyArrays ParseBinary(std::span<const std::byte> file, const std::filesystem::path& path);
std::string FormatBinary(const VocabularyArrays& tree);

// A text file brought into the order of Vocabulary. Throws InputError with `path` and line.
struct ParsedVocabulary {
  int branching = 0;
  int depth = 0;
  std::vector<Vocabulary::Node> nodes;
  std::vector<Descriptor> descriptors;
};
ParsedVocabulary ParseText(std::span<const std::byte> file, const std::filesystem::path& path);
std::string FormatText(const VocabularyArrays& tree);

}  // namespace semslam
