// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/gl_objects.h"

#include <array>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <opencv2/core.hpp>

#include "semslam/base/error.h"

namespace semslam {
namespace {

std::string OneLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.pop_back();
  for (char& c : text) c = c == '\n' ? ' ' : c;
  return text;
}

unsigned Compile(GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint is_compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &is_compiled);
  if (is_compiled == GL_TRUE) return shader;
  std::array<char, 512> text{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(text.size()), nullptr, text.data());
  glDeleteShader(shader);
  throw InputError("OpenGL does not take a shader: " + OneLine(text.data()));
}

void AllocateTexture(
    unsigned texture, GLint format, GLenum channels, GLenum type, int width, int height) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, channels, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

}  // namespace

unsigned MakeGlObject(GlKind kind) {
  GLuint id = 0;
  switch (kind) {
    case GlKind::kBuffer:
      glGenBuffers(1, &id);
      break;
    case GlKind::kVertexArray:
      glGenVertexArrays(1, &id);
      break;
    case GlKind::kTexture:
      glGenTextures(1, &id);
      break;
    case GlKind::kFramebuffer:
      glGenFramebuffers(1, &id);
      break;
    case GlKind::kProgram:
      id = glCreateProgram();
      break;
  }
  return id;
}

void DeleteGlObject(GlKind kind, unsigned id) {
  switch (kind) {
    case GlKind::kBuffer:
      return glDeleteBuffers(1, &id);
    case GlKind::kVertexArray:
      return glDeleteVertexArrays(1, &id);
    case GlKind::kTexture:
      return glDeleteTextures(1, &id);
    case GlKind::kFramebuffer:
      return glDeleteFramebuffers(1, &id);
    case GlKind::kProgram:
      return glDeleteProgram(id);
  }
}

GlProgram::GlProgram(const char* vertex_shader, const char* fragment_shader) {
  const GLuint vertex = Compile(GL_VERTEX_SHADER, vertex_shader);
  const GLuint fragment = Compile(GL_FRAGMENT_SHADER, fragment_shader);
  glAttachShader(program_.id(), vertex);
  glAttachShader(program_.id(), fragment);
  glLinkProgram(program_.id());
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint is_linked = GL_FALSE;
  glGetProgramiv(program_.id(), GL_LINK_STATUS, &is_linked);
  if (is_linked == GL_TRUE) return;
  std::array<char, 512> text{};
  glGetProgramInfoLog(program_.id(), static_cast<GLsizei>(text.size()), nullptr, text.data());
  throw InputError("OpenGL does not link shaders: " + OneLine(text.data()));
}

void GlProgram::Use() const { glUseProgram(program_.id()); }

int GlProgram::Location(const char* name) const {
  return glGetUniformLocation(program_.id(), name);
}

void GlTarget::Resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  AllocateTexture(color_.id(), GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
  if (has_depth_) {
    AllocateTexture(depth_.id(), GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width,
                    height);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw InputError("OpenGL has no picture of " + std::to_string(width) + "x" +
                     std::to_string(height) + " pixels");
  }
}

cv::Mat GlTarget::Read() const {
  cv::Mat picture(height_, width_, CV_8UC3);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_BGR, GL_UNSIGNED_BYTE, picture.data);
  cv::flip(picture, picture, 0);  // OpenGL's rows begin at the bottom.
  return picture;
}

}  // namespace semslam
