// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace semslam {

// Programs of the renderer, in OpenGL's shading language 3.30.

inline constexpr const char* kPointVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;  // In the chunk's frame.
layout(location = 1) in vec3 normal;    // Zero: none.
layout(location = 2) in vec3 color;
uniform mat4 clip_from_chunk;
uniform vec3 eye;               // In the chunk's frame.
uniform float size_at_one_metre;  // Pixels.
uniform float min_size;
uniform float max_size;
uniform float shading;  // 0: none.
flat out vec3 point_color;
void main() {
  gl_Position = clip_from_chunk * vec4(position, 1.0);
  gl_PointSize = clamp(size_at_one_metre / max(gl_Position.w, 1e-6), min_size, max_size);
  // A lamp at the eye.
  float cosine = abs(dot(normal, normalize(eye - position)));
  float light = dot(normal, normal) > 0.25 ? 0.5 + 0.5 * cosine : 1.0;
  point_color = color * mix(1.0, light, shading);
}
)";

inline constexpr const char* kSquareFragmentShader = R"(#version 330 core
flat in vec3 point_color;
out vec4 pixel;
void main() { pixel = vec4(point_color, 1.0); }
)";

inline constexpr const char* kDiscFragmentShader = R"(#version 330 core
flat in vec3 point_color;
out vec4 pixel;
void main() {
  vec2 from_center = gl_PointCoord - 0.5;
  if (dot(from_center, from_center) > 0.25) discard;
  pixel = vec4(point_color, 1.0);
}
)";

// One triangle that covers the picture.
inline constexpr const char* kScreenVertexShader = R"(#version 330 core
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

inline constexpr const char* kComposeFragmentShader = R"(#version 330 core
uniform sampler2D colors;
uniform sampler2D depths;
uniform vec2 near_far;   // Metres.
uniform float strength;  // Of eye-dome shading; 0: none.
uniform int radius;      // Of its neighbourhood, pixels.
uniform int max_gap;     // So many pixels to either side of a gap that is filled; 0: none.
uniform vec3 top;        // Background.
uniform vec3 bottom;
out vec4 pixel;

float LogDepth(float depth) {
  float ndc = 2.0 * depth - 1.0;
  float sum = near_far.y + near_far.x;
  float difference = near_far.y - near_far.x;
  return log2(2.0 * near_far.x * near_far.y / (sum - ndc * difference));
}

// The first pixel with a point on a way; the start if there is none.
ivec2 FindPoint(ivec2 start, ivec2 way, ivec2 size) {
  for (int i = 1; i <= max_gap; ++i) {
    ivec2 other = start + i * way;
    if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, size))) return start;
    if (texelFetch(depths, other, 0).r < 1.0) return other;
  }
  return start;
}

// A pixel beside a gap in a surface, in which there are points of about the same depth on both
// sides along two of four axes; the place itself if that is no such gap.
ivec2 BesideGap(ivec2 place, ivec2 size) {
  const ivec2 axes[4] = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1));
  int num_axes = 0;
  for (int i = 0; i < 4; ++i) {
    ivec2 a = FindPoint(place, axes[i], size);
    if (a == place) continue;
    ivec2 b = FindPoint(place, -axes[i], size);
    if (b == place) continue;
    float step = LogDepth(texelFetch(depths, a, 0).r) - LogDepth(texelFetch(depths, b, 0).r);
    if (abs(step) < 0.07 && ++num_axes == 2) return a;
  }
  return place;
}

void main() {
  ivec2 size = textureSize(depths, 0);
  ivec2 place = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(depths, place, 0).r;
  if (depth == 1.0 && max_gap > 0) {
    place = BesideGap(place, size);
    depth = texelFetch(depths, place, 0).r;
  }
  if (depth == 1.0) {
    pixel = vec4(mix(bottom, top, gl_FragCoord.y / float(size.y)), 1.0);
    return;
  }
  vec3 color = texelFetch(colors, place, 0).rgb;
  if (strength > 0.0) {
    const float min_step = 0.006;  // Noise of depth, and points that overlap.
    const float max_step = 0.15;   // So that a far background does not turn black.
    float own = LogDepth(depth);
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        ivec2 other = clamp(place + radius * ivec2(x, y), ivec2(0), size - 1);
        float other_depth = texelFetch(depths, other, 0).r;
        sum += clamp(own - LogDepth(other_depth) - min_step, 0.0, max_step);
      }
    }
    color *= exp(-strength * sum / 8.0);
  }
  pixel = vec4(color, 1.0);
}
)";

// An instance a line, drawn as a strip of four corners.
inline constexpr const char* kLineVertexShader = R"(#version 330 core
layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 2) in vec3 color;
layout(location = 3) in vec3 look;  // Alpha, width in pixels, share of alpha where it is hidden.
uniform mat4 clip_from_world;
uniform vec2 size;  // Of the picture, pixels.
uniform float near;
uniform float pixel_scale;
flat out vec3 line_color;
flat out vec3 line_look;
noperspective out float offset;  // From the line's middle, pixels.
void main() {
  vec4 from = clip_from_world * vec4(a, 1.0);
  vec4 to = clip_from_world * vec4(b, 1.0);
  // Cut off what is behind the eye.
  if (from.w < near) from = mix(from, to, clamp((near - from.w) / (to.w - from.w), 0.0, 1.0));
  if (to.w < near) to = mix(to, from, clamp((near - to.w) / (from.w - to.w), 0.0, 1.0));
  vec2 from_pixel = from.xy / from.w * size * 0.5;
  vec2 to_pixel = to.xy / to.w * size * 0.5;
  vec2 along = to_pixel - from_pixel;
  along = dot(along, along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  float reach = 0.5 * look.y * pixel_scale + 1.0;
  bool is_end = gl_VertexID >= 2;
  vec4 place = is_end ? to : from;
  vec2 shift = side * reach * vec2(-along.y, along.x) + (is_end ? 0.5 : -0.5) * along;
  place.xy += shift / (size * 0.5) * place.w;
  gl_Position = place;
  if (from.w < near * 0.999 && to.w < near * 0.999) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  offset = side * reach;
  line_color = color;
  line_look = vec3(look.x, look.y * pixel_scale, look.z);
}
)";

inline constexpr const char* kLineFragmentShader = R"(#version 330 core
uniform sampler2D depths;  // Of the points.
flat in vec3 line_color;
flat in vec3 line_look;
noperspective in float offset;
out vec4 pixel;
void main() {
  float cover = clamp(0.5 * line_look.y + 0.5 - abs(offset), 0.0, 1.0);
  float depth = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r;
  float alpha = line_look.x * cover;
  if (gl_FragCoord.z > depth) alpha *= line_look.z;
  if (alpha <= 0.0) discard;
  pixel = vec4(line_color, alpha);
}
)";

}  // namespace semslam
