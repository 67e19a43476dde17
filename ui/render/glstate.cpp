// SPDX-License-Identifier: Apache-2.0
#include "ui/render/glstate.h"

namespace ps::render {
namespace {

GLint integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLint integer(GLenum name, GLuint index) {
  GLint value = 0;
  glGetIntegeri_v(name, index, &value);
  return value;
}

void enable(GLenum capability, GLboolean on) { on ? glEnable(capability) : glDisable(capability); }

void bindRange(GLenum target, GLuint index, GLint buffer, GLint64 start, GLint64 size) {
  if (size > 0)
    glBindBufferRange(target, index, static_cast<GLuint>(buffer), static_cast<GLintptr>(start),
                      static_cast<GLsizeiptr>(size));
  else
    glBindBufferBase(target, index, static_cast<GLuint>(buffer));
}

}  // namespace

GlState::GlState()
    : m_drawFramebuffer(integer(GL_DRAW_FRAMEBUFFER_BINDING)),
      m_readFramebuffer(integer(GL_READ_FRAMEBUFFER_BINDING)),
      m_program(integer(GL_CURRENT_PROGRAM)),
      m_vertexArray(integer(GL_VERTEX_ARRAY_BINDING)),
      m_activeTexture(integer(GL_ACTIVE_TEXTURE)),
      m_arrayBuffer(integer(GL_ARRAY_BUFFER_BINDING)),
      m_uniformBuffer(integer(GL_UNIFORM_BUFFER_BINDING)),
      m_textureBuffer(integer(GL_TEXTURE_BUFFER_BINDING)),
      m_packBuffer(integer(GL_PIXEL_PACK_BUFFER_BINDING)),
      m_unpackBuffer(integer(GL_PIXEL_UNPACK_BUFFER_BINDING)),
      m_unpackAlignment(integer(GL_UNPACK_ALIGNMENT)),
      m_unpackRowLength(integer(GL_UNPACK_ROW_LENGTH)),
      m_depthFunction(integer(GL_DEPTH_FUNC)),
      m_cullFace(integer(GL_CULL_FACE_MODE)),
      m_frontFace(integer(GL_FRONT_FACE)) {
  glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 0, &m_uniformBuffer0);
  glGetInteger64i_v(GL_UNIFORM_BUFFER_START, 0, &m_uniformStart0);
  glGetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, 0, &m_uniformSize0);
  glGetIntegerv(GL_VIEWPORT, m_viewport.data());
  glGetIntegerv(GL_SCISSOR_BOX, m_scissor.data());
  const GLenum blend[] = {GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                          GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};
  for (size_t i = 0; i < m_blend.size(); ++i) m_blend[i] = integer(blend[i]);
  const GLenum stencil[2][7] = {
      {GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_WRITEMASK, GL_STENCIL_FAIL,
       GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_PASS_DEPTH_PASS},
      {GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK, GL_STENCIL_BACK_WRITEMASK,
       GL_STENCIL_BACK_FAIL, GL_STENCIL_BACK_PASS_DEPTH_FAIL, GL_STENCIL_BACK_PASS_DEPTH_PASS}};
  for (size_t face = 0; face < 2; ++face)
    for (size_t i = 0; i < 7; ++i) m_stencil[face][i] = integer(stencil[face][i]);
  // Core profiles write one value, compatibility profiles two.
  m_polygonMode = {GL_FILL, GL_FILL};
  glGetIntegerv(GL_POLYGON_MODE, m_polygonMode.data());
  glGetFloatv(GL_COLOR_CLEAR_VALUE, m_clearColour.data());
  glGetFloatv(GL_DEPTH_RANGE, m_depthRange.data());
  glGetFloatv(GL_DEPTH_CLEAR_VALUE, &m_clearDepth);
  glGetBooleanv(GL_DEPTH_WRITEMASK, &m_depthMask);
  glGetBooleanv(GL_COLOR_WRITEMASK, m_colourMask.data());
  const GLenum capabilities[] = {GL_BLEND,
                                 GL_DEPTH_TEST,
                                 GL_SCISSOR_TEST,
                                 GL_CULL_FACE,
                                 GL_STENCIL_TEST,
                                 GL_MULTISAMPLE,
                                 GL_FRAMEBUFFER_SRGB,
                                 GL_DITHER,
                                 GL_POLYGON_OFFSET_FILL,
                                 GL_SAMPLE_ALPHA_TO_COVERAGE,
                                 GL_RASTERIZER_DISCARD};
  for (size_t i = 0; i < m_capabilities.size(); ++i)
    m_capabilities[i] = {capabilities[i], glIsEnabled(capabilities[i])};
  for (int unit = 0; unit < kUnits; ++unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    m_unitStates[static_cast<size_t>(unit)] = {integer(GL_TEXTURE_BINDING_2D), integer(GL_TEXTURE_BINDING_BUFFER),
                                               integer(GL_SAMPLER_BINDING)};
    glBindSampler(static_cast<GLuint>(unit), 0);
  }
  for (const Capability& capability : m_capabilities) glDisable(capability.name);
  readComputing();
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthRange(0, 1);
  glStencilMask(0xFF);
  glBlendEquation(GL_FUNC_ADD);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

GlState::~GlState() {
  for (int unit = 0; unit < kUnits; ++unit) {
    const Unit& state = m_unitStates[static_cast<size_t>(unit)];
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(state.texture));
    glBindTexture(GL_TEXTURE_BUFFER, static_cast<GLuint>(state.buffer));
    glBindSampler(static_cast<GLuint>(unit), static_cast<GLuint>(state.sampler));
  }
  glActiveTexture(static_cast<GLenum>(m_activeTexture));
  for (const Capability& capability : m_capabilities) enable(capability.name, capability.on);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(m_drawFramebuffer));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(m_readFramebuffer));
  glUseProgram(static_cast<GLuint>(m_program));
  glBindVertexArray(static_cast<GLuint>(m_vertexArray));
  glBindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(m_arrayBuffer));
  glBindBuffer(GL_TEXTURE_BUFFER, static_cast<GLuint>(m_textureBuffer));
  bindRange(GL_UNIFORM_BUFFER, 0, m_uniformBuffer0, m_uniformStart0, m_uniformSize0);
  restoreComputing();
  glBindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(m_uniformBuffer));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(m_packBuffer));
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(m_unpackBuffer));
  glPixelStorei(GL_UNPACK_ALIGNMENT, m_unpackAlignment);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, m_unpackRowLength);
  glViewport(m_viewport[0], m_viewport[1], m_viewport[2], m_viewport[3]);
  glScissor(m_scissor[0], m_scissor[1], m_scissor[2], m_scissor[3]);
  glBlendFuncSeparate(static_cast<GLenum>(m_blend[0]), static_cast<GLenum>(m_blend[1]), static_cast<GLenum>(m_blend[2]),
                      static_cast<GLenum>(m_blend[3]));
  glBlendEquationSeparate(static_cast<GLenum>(m_blend[4]), static_cast<GLenum>(m_blend[5]));
  for (size_t face = 0; face < 2; ++face) {
    const auto& s = m_stencil[face];
    const GLenum side = face ? GL_BACK : GL_FRONT;
    glStencilFuncSeparate(side, static_cast<GLenum>(s[0]), s[1], static_cast<GLuint>(s[2]));
    glStencilMaskSeparate(side, static_cast<GLuint>(s[3]));
    glStencilOpSeparate(side, static_cast<GLenum>(s[4]), static_cast<GLenum>(s[5]), static_cast<GLenum>(s[6]));
  }
  glDepthFunc(static_cast<GLenum>(m_depthFunction));
  glDepthMask(m_depthMask);
  glDepthRange(static_cast<GLdouble>(m_depthRange[0]), static_cast<GLdouble>(m_depthRange[1]));
  glCullFace(static_cast<GLenum>(m_cullFace));
  glFrontFace(static_cast<GLenum>(m_frontFace));
  glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(m_polygonMode[0]));
  glClearColor(m_clearColour[0], m_clearColour[1], m_clearColour[2], m_clearColour[3]);
  glClearDepth(static_cast<GLdouble>(m_clearDepth));
  glColorMask(m_colourMask[0], m_colourMask[1], m_colourMask[2], m_colourMask[3]);
}

void GlState::readComputing() {
  m_storageBuffer = integer(GL_SHADER_STORAGE_BUFFER_BINDING);
  for (GLuint i = 0; i < kImages; ++i) {
    Image& image = m_images[i];
    image = {integer(GL_IMAGE_BINDING_NAME, i),   integer(GL_IMAGE_BINDING_LEVEL, i),
             integer(GL_IMAGE_BINDING_LAYER, i),  integer(GL_IMAGE_BINDING_ACCESS, i),
             integer(GL_IMAGE_BINDING_FORMAT, i), GL_FALSE};
    glGetBooleani_v(GL_IMAGE_BINDING_LAYERED, i, &image.layered);
  }
  for (GLuint i = 0; i < kStorages; ++i) {
    m_storages[i] = {integer(GL_SHADER_STORAGE_BUFFER_BINDING, i), 0, 0};
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, i, &m_storages[i].start);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, i, &m_storages[i].size);
  }
}

void GlState::restoreComputing() const {
  for (GLuint i = 0; i < kImages; ++i) {
    const Image& image = m_images[i];
    glBindImageTexture(i, static_cast<GLuint>(image.name), image.level, image.layered, image.layer,
                       static_cast<GLenum>(image.access), static_cast<GLenum>(image.format));
  }
  for (GLuint i = 0; i < kStorages; ++i) {
    const Storage& storage = m_storages[i];
    bindRange(GL_SHADER_STORAGE_BUFFER, i, storage.buffer, storage.start, storage.size);
  }
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(m_storageBuffer));
}

}  // namespace ps::render
