// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include <opencv2/core/mat.hpp>

namespace semslam {

// Kinds of objects that OpenGL keeps and knows by number.
enum class GlKind { kBuffer, kVertexArray, kTexture, kFramebuffer, kProgram };

unsigned MakeGlObject(GlKind kind);
void DeleteGlObject(GlKind kind, unsigned id);

// Owns one of them. The context in which it was made must be the current one when it goes.
template <GlKind kKind>
class GlObject {
 public:
  GlObject() : id_(MakeGlObject(kKind)) {}
  ~GlObject() {
    if (id_ != 0) DeleteGlObject(kKind, id_);
  }
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  unsigned id() const { return id_; }

 private:
  unsigned id_;
};

using GlBuffer = GlObject<GlKind::kBuffer>;
using GlVertexArray = GlObject<GlKind::kVertexArray>;
using GlTexture = GlObject<GlKind::kTexture>;
using GlFramebuffer = GlObject<GlKind::kFramebuffer>;

// A vertex and a fragment shader, linked.
class GlProgram {
 public:
  // Throws InputError with the compiler's words if this OpenGL does not take them.
  GlProgram(const char* vertex_shader, const char* fragment_shader);
  void Use() const;
  // Location of a uniform variable; -1 if the program does not use it, and then setting it does
  // nothing.
  int Location(const char* name) const;

 private:
  GlObject<GlKind::kProgram> program_;
};

// Where pictures are drawn: a colour texture, and a depth texture if asked for.
class GlTarget {
 public:
  explicit GlTarget(bool has_depth) : has_depth_(has_depth) {}
  // What it held is lost if the size changes. Throws InputError if OpenGL cannot have it.
  void Resize(int width, int height);
  // What was drawn: CV_8UC3, BGR.
  cv::Mat Read() const;
  unsigned framebuffer() const { return framebuffer_.id(); }
  unsigned color() const { return color_.id(); }
  unsigned depth() const { return depth_.id(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  bool has_depth_;
  int width_ = 0;
  int height_ = 0;
  GlFramebuffer framebuffer_;
  GlTexture color_;
  GlTexture depth_;
};

}  // namespace semslam
