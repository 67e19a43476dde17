// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/depthpass.h"

#include "core/base/error.h"
#include "core/math/vector.h"
#include "ui/render/furniture.h"
#include "ui/render/glstate.h"
#include "ui/render/uniforms.h"

#include <epoxy/gl.h>

#include <string>
#include <vector>

namespace ps::vr {
namespace {

// A square across the way to each ball, a little before it and large enough for whatever the eye sees of it.
constexpr const char* kBallVertex = R"(#version 430 core
layout(location = 0) in vec4 ball;
uniform mat4 view, projection;
out vec3 place;
flat out vec4 own;
void main() {
  own = vec4((view * vec4(ball.xyz, 1)).xyz, ball.w);
  vec3 forward = normalize(own.xyz);
  vec3 right = normalize(cross(forward, abs(forward.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  vec3 up = cross(right, forward);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1;
  place = own.xyz + 1.5 * own.w * (corner.x * right + corner.y * up);
  gl_Position = projection * vec4(place, 1);
})";
constexpr const char* kBallFragment = R"(#version 430 core
in vec3 place;
flat in vec4 own;
uniform mat4 projection;
void main() {
  vec3 way = normalize(place);
  float along = dot(way, own.xyz);
  float square = own.w * own.w - dot(own.xyz, own.xyz) + along * along;
  if (square < 0) discard;
  vec4 clip = projection * vec4((along - sqrt(square)) * way, 1);
  gl_FragDepth = clip.w > 0 ? clamp(0.5 + 0.5 * clip.z / clip.w, 0, 1) : 0;
})";
constexpr const char* kFaceVertex = R"(#version 430 core
layout(location = 0) in vec3 corner;
uniform mat4 view, projection;
void main() { gl_Position = projection * (view * vec4(corner, 1)); })";
constexpr const char* kFaceFragment = "#version 430 core\nvoid main() {}";

GLuint compiled(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  return shader;
}

GLuint linked(const char* vertex, const char* fragment) {
  const GLuint program = glCreateProgram();
  for (const GLuint shader : {compiled(GL_VERTEX_SHADER, vertex), compiled(GL_FRAGMENT_SHADER, fragment)}) {
    glAttachShader(program, shader);
    glDeleteShader(shader);  // goes with the program
  }
  glLinkProgram(program);
  GLint fine = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &fine);
  if (fine) return program;
  GLsizei length = 0;
  std::string said(500, '\0');
  glGetProgramInfoLog(program, static_cast<GLsizei>(said.size()), &length, said.data());
  said.resize(static_cast<size_t>(length));
  glDeleteProgram(program);
  throw Error("The graphics driver draws no depths for the headset: " + said);
}

void set(GLuint program, const char* name, const Matrix4& matrix) {
  const Eigen::Matrix4f values = matrix.cast<float>();
  glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, values.data());
}

}  // namespace

DepthPass::DepthPass() {
  const render::GlState state;
  m_balls = linked(kBallVertex, kBallFragment);
  m_faces = linked(kFaceVertex, kFaceFragment);
  glGenBuffers(kParts, m_buffers.data());
  glGenVertexArrays(kParts, m_arrays.data());
  for (size_t part = 0; part < kParts; ++part) {
    const bool balls = part == kMatter, mesh = part == kFurniture || part == kProps;
    glBindVertexArray(m_arrays[part]);
    glBindBuffer(GL_ARRAY_BUFFER, m_buffers[part]);
    glEnableVertexAttribArray(0);
    const size_t stride = balls ? sizeof(api::Float4) : mesh ? sizeof(MeshVertex) : 3 * sizeof(float);
    glVertexAttribPointer(0, balls ? 4 : 3, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride), nullptr);
    if (balls) glVertexAttribDivisor(0, 1);
  }
}

DepthPass::~DepthPass() {
  glDeleteVertexArrays(kParts, m_arrays.data());
  glDeleteBuffers(kParts, m_buffers.data());
  for (const uint32_t program : {m_balls, m_faces}) glDeleteProgram(program);
}

void DepthPass::upload(Part part, const void* data, size_t bytes, int count) {
  glBindBuffer(GL_ARRAY_BUFFER, m_buffers[part]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  m_counts[part] = count;
}

void DepthPass::prepare(const Snapshot& matter, const RenderScene& scene, const Look& look) {
  const render::GlState state;
  std::vector<api::Float4> balls;
  balls.reserve(matter.position.size());
  for (size_t i = 0; i < matter.position.size(); ++i) {
    const api::Float4& p = matter.position[i];
    if (matter.motion[i] == api::Motion::Gas) continue;
    if (look.section && !look.section->shows(vectorOf(p))) continue;
    balls.push_back(p);
  }
  upload(kMatter, balls.data(), balls.size() * sizeof(api::Float4), static_cast<int>(balls.size()));
  const bool same = m_furnished && m_section == look.section && render::sameFurniture(*m_furnished, scene.environment);
  if (same) return;
  m_furnished = scene.environment;
  m_section = look.section;
  const render::Furniture furniture = render::buildFurniture(scene.environment, look.dark, look.section);
  upload(kFurniture, furniture.opaque.data(), furniture.opaque.size() * sizeof(MeshVertex),
         static_cast<int>(furniture.opaque.size()));
}

void DepthPass::show(const Props& props, size_t panels) {
  const render::GlState state;
  upload(kProps, props.opaque.data(), props.opaque.size() * sizeof(MeshVertex), static_cast<int>(props.opaque.size()));
  std::vector<std::array<float, 3>> corners;
  for (size_t k = 0; k < panels; ++k)
    for (const size_t corner : {0, 1, 2, 0, 2, 3}) corners.push_back(render::floats(props.panels[k].corners[corner]));
  upload(kPanels, corners.data(), corners.size() * sizeof(corners[0]), static_cast<int>(corners.size()));
}

void DepthPass::draw(const Eye& eye, const RenderTarget& target) const {
  const render::GlState state;
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glDrawBuffer(GL_NONE);
  glViewport(target.x, target.y, target.size.width, target.size.height);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  const GLfloat far = 1;
  glClearBufferfv(GL_DEPTH, 0, &far);
  for (const uint32_t program : {m_balls, m_faces}) {
    glUseProgram(program);
    set(program, "view", eye.view);
    set(program, "projection", eye.projection);
  }
  for (const size_t part : {kFurniture, kProps, kPanels}) {
    if (part == kPanels) glEnable(GL_CULL_FACE);  // they have one side
    glBindVertexArray(m_arrays[part]);
    glDrawArrays(GL_TRIANGLES, 0, m_counts[part]);
    if (part != kProps) continue;
    glUseProgram(m_balls);
    glBindVertexArray(m_arrays[kMatter]);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, m_counts[kMatter]);
    glUseProgram(m_faces);
  }
}

}  // namespace ps::vr
