// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/viewer/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include "semslam/base/check.h"
#include "semslam/base/error.h"
#include "semslam/viewer/orbit_camera.h"

#include "viewer/gl_objects.h"
#include "viewer/shaders.h"

namespace semslam {
namespace {

constexpr float kEyeDomeStrength = 11.0F;
constexpr float kMinPointSize = 1.4F;   // Pixels of the picture that people see.
constexpr float kMaxPointSize = 60.0F;  // The same.
constexpr float kMaxGap = 3.0F;         // Pixels of that picture, to either side.
// Discs of neighbours on a grid of this spacing cover all between them: its diagonal,
// and a bit, for they are not quite on a grid.
constexpr double kDiameterPerSpacing = 1.6;

struct PointVertex {
  Eigen::Vector3f position;
  std::array<std::int8_t, 4> normal{};  // Of 127; zero: none.
};
static_assert(sizeof(PointVertex) == 16);

struct ColorVertex {
  Rgb color;
  std::uint8_t unused = 0;
};
static_assert(sizeof(ColorVertex) == 4);

struct LineVertex {
  Eigen::Vector3f a;
  Eigen::Vector3f b;
  std::array<float, 3> color{};
  std::array<float, 3> look{};
};
static_assert(sizeof(LineVertex) == 48);

struct Chunk {
  GlBuffer points;
  GlBuffer colors;
  GlVertexArray array;
  std::size_t num_points = 0;
  std::size_t stride = 0;  // Of the vertex array; 0: not made yet.
  Eigen::AlignedBox3f bounds;
  Rigid3 T_world_chunk;
};

void CheckVersion() {
  const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
  if (version == nullptr) throw InputError("no OpenGL 3.3: there is no context");
  GLint major = 0;
  GLint minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (major > 3 || (major == 3 && minor >= 3)) return;
  throw InputError("expected OpenGL 3.3, found " + std::string(version));
}

std::array<std::int8_t, 4> PackNormal(const Eigen::Vector3f& normal) {
  const auto pack = [](float value) {
    return static_cast<std::int8_t>(std::lround(127.0F * std::clamp(value, -1.0F, 1.0F)));
  };
  if (!normal.allFinite()) return {};
  return {pack(normal.x()), pack(normal.y()), pack(normal.z()), 0};
}

template <typename T>
void Upload(GLenum target, const GlBuffer& buffer, const std::vector<T>& values, GLenum usage) {
  glBindBuffer(target, buffer.id());
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), usage);
}

// OpenGL takes places in buffers as pointers. NOLINTNEXTLINE(performance-no-int-to-ptr)
const void* Offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

// Lets the vertex array take every stride-th point.
void ArrangePoints(Chunk& chunk, std::size_t stride) {
  if (chunk.stride == stride) return;
  chunk.stride = stride;
  glBindVertexArray(chunk.array.id());
  glBindBuffer(GL_ARRAY_BUFFER, chunk.points.id());
  const auto point_step = static_cast<GLsizei>(stride * sizeof(PointVertex));
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, point_step, Offset(0));
  glVertexAttribPointer(1, 3, GL_BYTE, GL_TRUE, point_step, Offset(offsetof(PointVertex, normal)));
  glBindBuffer(GL_ARRAY_BUFFER, chunk.colors.id());
  glVertexAttribPointer(2, 3, GL_UNSIGNED_BYTE, GL_TRUE,
                        static_cast<GLsizei>(stride * sizeof(ColorVertex)), Offset(0));
  for (const GLuint attribute : {0U, 1U, 2U}) glEnableVertexAttribArray(attribute);
}

Eigen::Vector3f ToUnit(Rgb color) { return Eigen::Vector3f(color.r, color.g, color.b) / 255.0F; }

struct PointProgram {
  explicit PointProgram(const char* fragment_shader)
      : program(kPointVertexShader, fragment_shader) {}
  GlProgram program;
  int clip_from_chunk = program.Location("clip_from_chunk");
  int eye = program.Location("eye");
  int size_at_one_metre = program.Location("size_at_one_metre");
  int min_size = program.Location("min_size");
  int max_size = program.Location("max_size");
  int shading = program.Location("shading");
};

}  // namespace

class Renderer::State {
 public:
  State() { ArrangeLines(); }

  ChunkId Add(Chunk chunk) {
    const ChunkId id = next_chunk_++;
    chunks_.emplace(id, std::move(chunk));
    return id;
  }
  void Remove(ChunkId id) { SEMSLAM_CHECK(chunks_.erase(id) == 1) << "chunk " << id; }

  Chunk& Find(ChunkId id) {
    const auto chunk = chunks_.find(id);
    SEMSLAM_CHECK(chunk != chunks_.end()) << "chunk " << id;
    return chunk->second;
  }
  std::size_t num_points() const {
    std::size_t count = 0;
    for (const auto& [id, chunk] : chunks_) count += chunk.num_points;
    return count;
  }

  void Draw(const ViewCamera& camera,
            const DrawList& list,
            const Options& options,
            unsigned framebuffer) {
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glViewport(0, 0, camera.width, camera.height);
    FindDepthRange(camera);
    target_.Resize(camera.width, camera.height);
    DrawPoints(camera, options);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glDisable(GL_DEPTH_TEST);
    Compose(options);
    DrawLines(camera, list, options);
    glBindVertexArray(0);
  }

 private:
  // Near enough and far enough for all points, and for the lines about them.
  void FindDepthRange(const ViewCamera& camera) {
    constexpr float kMinRatio = 200.0F;  // Lines may be nearer than points.
    constexpr float kMaxRatio = 1e4F;    // More would leave too few steps of depth.
    float nearest = 1e9F;
    float farthest = 1.0F;
    for (const auto& [id, chunk] : chunks_) {
      const Eigen::Vector3f center =
          (chunk.T_world_chunk * chunk.bounds.center().cast<double>()).cast<float>();
      const float radius = 0.5F * chunk.bounds.diagonal().norm();
      const float distance = (center - camera.p_world).norm();
      nearest = std::min(nearest, distance - radius);
      farthest = std::max(farthest, distance + radius);
    }
    far_ = 2.0F * farthest;
    near_ = std::clamp(0.25F * nearest, far_ / kMaxRatio, far_ / kMinRatio);
  }

  void DrawPoints(const ViewCamera& camera, const Options& options) {
    glBindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer());
    glClearColor(0, 0, 0, 0);
    glClearDepth(1);
    glDepthMask(GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glEnable(GL_PROGRAM_POINT_SIZE);
    const PointProgram& program = options.round_points ? discs_ : squares_;
    program.program.Use();
    const std::size_t stride = Stride(options.max_points);
    const double diameter =
        kDiameterPerSpacing * options.point_size * std::sqrt(static_cast<double>(stride));
    glUniform1f(program.size_at_one_metre, static_cast<float>(diameter) * camera.focal_length);
    glUniform1f(program.min_size, kMinPointSize * options.pixel_scale);
    glUniform1f(program.max_size, kMaxPointSize * options.pixel_scale);
    glUniform1f(program.shading, options.shade_by_normals ? 1.0F : 0.0F);
    const Eigen::Matrix4f clip_from_world = ClipFromWorld(camera, near_, far_);
    for (auto& [id, chunk] : chunks_) {
      const Eigen::Matrix4f clip_from_chunk =
          clip_from_world * chunk.T_world_chunk.ToMatrix().cast<float>();
      const Eigen::Vector3f eye =
          (chunk.T_world_chunk.Inverse() * camera.p_world.cast<double>()).cast<float>();
      glUniformMatrix4fv(program.clip_from_chunk, 1, GL_FALSE, clip_from_chunk.data());
      glUniform3fv(program.eye, 1, eye.data());
      ArrangePoints(chunk, stride);
      glBindVertexArray(chunk.array.id());
      glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(chunk.num_points / stride));
    }
  }

  std::size_t Stride(std::size_t max_points) const {
    const std::size_t count = num_points();
    const std::size_t limit = std::max<std::size_t>(1, max_points);
    return std::max<std::size_t>(1, count / limit + (count % limit != 0 ? 1 : 0));
  }

  void Compose(const Options& options) {
    compose_.Use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, target_.color());
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, target_.depth());
    glUniform1i(compose_.Location("colors"), 0);
    glUniform1i(compose_.Location("depths"), 1);
    glUniform2f(compose_.Location("near_far"), near_, far_);
    glUniform1f(compose_.Location("strength"), options.eye_dome ? kEyeDomeStrength : 0.0F);
    glUniform1i(compose_.Location("radius"),
                std::max(1, static_cast<int>(std::lround(options.pixel_scale))));
    glUniform1i(
        compose_.Location("max_gap"),
        options.fill_gaps ? static_cast<int>(std::lround(kMaxGap * options.pixel_scale)) : 0);
    glUniform3fv(compose_.Location("top"), 1, ToUnit(options.background_top).data());
    glUniform3fv(compose_.Location("bottom"), 1, ToUnit(options.background_bottom).data());
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  void DrawLines(const ViewCamera& camera, const DrawList& list, const Options& options) {
    if (list.lines().empty()) return;
    std::vector<LineVertex> vertices;
    vertices.reserve(list.lines().size());
    for (const DrawList::Line& line : list.lines()) {
      const Eigen::Vector3f color = ToUnit(line.style.color);
      vertices.push_back({line.a,
                          line.b,
                          {color.x(), color.y(), color.z()},
                          {line.style.alpha, line.style.width, line.style.hidden_share}});
    }
    Upload(GL_ARRAY_BUFFER, line_vertices_, vertices, GL_STREAM_DRAW);
    lines_.Use();
    const Eigen::Matrix4f clip_from_world = ClipFromWorld(camera, near_, far_);
    glUniformMatrix4fv(lines_.Location("clip_from_world"), 1, GL_FALSE, clip_from_world.data());
    glUniform2f(lines_.Location("size"), static_cast<float>(camera.width),
                static_cast<float>(camera.height));
    glUniform1f(lines_.Location("near"), near_);
    glUniform1f(lines_.Location("pixel_scale"), options.pixel_scale);
    glUniform1i(lines_.Location("depths"), 1);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(line_array_.id());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(vertices.size()));
    glDisable(GL_BLEND);
  }

  void ArrangeLines() {
    glBindVertexArray(line_array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, line_vertices_.id());
    const std::array<std::size_t, 4> offsets = {offsetof(LineVertex, a), offsetof(LineVertex, b),
                                                offsetof(LineVertex, color),
                                                offsetof(LineVertex, look)};
    for (GLuint i = 0; i < offsets.size(); ++i) {
      glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(LineVertex), Offset(offsets[i]));
      glVertexAttribDivisor(i, 1);
      glEnableVertexAttribArray(i);
    }
    glBindVertexArray(0);
  }

  std::map<ChunkId, Chunk> chunks_;
  ChunkId next_chunk_ = 1;
  PointProgram squares_{kSquareFragmentShader};
  PointProgram discs_{kDiscFragmentShader};
  GlProgram compose_{kScreenVertexShader, kComposeFragmentShader};
  GlProgram lines_{kLineVertexShader, kLineFragmentShader};
  GlVertexArray no_vertices_;
  GlVertexArray line_array_;
  GlBuffer line_vertices_;
  GlTarget target_{true};
  float near_ = 0.01F;  // Of the picture in hand, metres.
  float far_ = 100.0F;
};

Renderer::Renderer() {
  CheckVersion();
  state_ = std::make_unique<State>();
}

Renderer::~Renderer() = default;

Renderer::ChunkId Renderer::AddChunk(std::span<const Eigen::Vector3f> positions,
                                     std::span<const Eigen::Vector3f> normals) {
  SEMSLAM_CHECK(normals.empty() || normals.size() == positions.size());
  Chunk chunk;
  chunk.num_points = positions.size();
  std::vector<PointVertex> vertices(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    vertices[i].position = positions[i];
    if (!normals.empty()) vertices[i].normal = PackNormal(normals[i]);
    if (positions[i].allFinite()) chunk.bounds.extend(positions[i]);
  }
  if (chunk.bounds.isEmpty()) chunk.bounds.extend(Eigen::Vector3f::Zero());
  Upload(GL_ARRAY_BUFFER, chunk.points, vertices, GL_STATIC_DRAW);
  const ChunkId id = state_->Add(std::move(chunk));
  SetColors(id, std::vector<Rgb>(positions.size(), Rgb{200, 200, 200}));
  return id;
}

void Renderer::SetColors(ChunkId id, std::span<const Rgb> colors) {
  const Chunk& chunk = state_->Find(id);
  SEMSLAM_CHECK(colors.size() == chunk.num_points);
  std::vector<ColorVertex> vertices(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) vertices[i].color = colors[i];
  Upload(GL_ARRAY_BUFFER, chunk.colors, vertices, GL_DYNAMIC_DRAW);
}

void Renderer::SetPose(ChunkId id, const Rigid3& T_world_chunk) {
  state_->Find(id).T_world_chunk = T_world_chunk;
}

void Renderer::RemoveChunk(ChunkId id) { state_->Remove(id); }

std::size_t Renderer::num_points() const { return state_->num_points(); }

void Renderer::Draw(const ViewCamera& camera,
                    const DrawList& list,
                    const Options& options,
                    unsigned framebuffer) {
  state_->Draw(camera, list, options, framebuffer);
}

std::string Renderer::device() const {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name == nullptr ? "unknown" : name;
}

bool Renderer::is_software() const {
  const std::string name = device();
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos ||
         name.find("swrast") != std::string::npos;
}

}  // namespace semslam
