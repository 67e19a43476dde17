// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/depthpass.h"

#include "core/math/vector.h"
#include "ui/render/furniture.h"
#include "ui/render/globjects.h"
#include "ui/render/glstate.h"
#include "ui/render/uniforms.h"

#include <epoxy/gl.h>

#include <vector>

namespace ps::vr {
namespace {

void set(const render::Program& program, const char* name, const Matrix4& matrix) {
  const Eigen::Matrix4f values = matrix.cast<float>();
  glUniformMatrix4fv(program.at(name), 1, GL_FALSE, values.data());
}

}  // namespace

struct DepthPass::Objects {
  render::Program balls{{"depthball.vert"}, {"depthball.frag"}}, faces{{"depthface.vert"}, {"depthface.frag"}};
  std::array<render::Buffer, kParts> buffers;
};

DepthPass::DepthPass() : m_objects(std::make_unique<Objects>()) {
  const render::GlState state;
  glGenVertexArrays(kParts, m_arrays.data());
  for (size_t part = 0; part < kParts; ++part) {
    const bool balls = part == kMatter, mesh = part == kFurniture || part == kProps;
    glBindVertexArray(m_arrays[part]);
    glBindBuffer(GL_ARRAY_BUFFER, m_objects->buffers[part].name());
    glEnableVertexAttribArray(0);
    const size_t stride = balls ? sizeof(api::Float4) : mesh ? sizeof(MeshVertex) : 3 * sizeof(float);
    glVertexAttribPointer(0, balls ? 4 : 3, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride), nullptr);
    if (balls) glVertexAttribDivisor(0, 1);
  }
}

DepthPass::~DepthPass() { glDeleteVertexArrays(kParts, m_arrays.data()); }

void DepthPass::upload(Part part, const void* data, size_t bytes, int count) {
  m_objects->buffers[part].upload(GL_ARRAY_BUFFER, data, bytes);
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
  const auto& [balls, faces, buffers] = *m_objects;
  for (const render::Program* program : {&balls, &faces}) {
    program->use();
    set(*program, "seen", eye.view);
    set(*program, "window", eye.projection);
  }
  for (const size_t part : {kFurniture, kProps, kPanels}) {
    if (part == kPanels) glEnable(GL_CULL_FACE);  // they have one side
    glBindVertexArray(m_arrays[part]);
    glDrawArrays(GL_TRIANGLES, 0, m_counts[part]);
    if (part != kProps) continue;
    balls.use();
    glBindVertexArray(m_arrays[kMatter]);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, m_counts[kMatter]);
    faces.use();
  }
}

}  // namespace ps::vr
