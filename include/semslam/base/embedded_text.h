// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace semslam {

// A file of the source tree, as it was when the library was built (cmake/SemslamEmbed.cmake).
struct EmbeddedText {
  const char* name;
  const char* text;
};

}  // namespace semslam
