// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace semslam {

// Programs of the renderer, in OpenGL's shading language 3.30.
extern const char* const kPointVertexShader;
extern const char* const kSquareFragmentShader;
extern const char* const kDiscFragmentShader;
extern const char* const kScreenVertexShader;
extern const char* const kComposeFragmentShader;
extern const char* const kLineVertexShader;
extern const char* const kLineFragmentShader;

}  // namespace semslam
