// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include <array>

namespace ps::render {

/// Remembers the OpenGL state that a frame changes and puts it back: whoever shares the context (a QPainter overlay, a
/// second renderer) finds what it left. Texture units and uniform buffers beyond those that passes use are untouched.
class GlState {
 public:
  static constexpr int kUnits = 8;
  static constexpr int kImages = 3, kStorages = 8;  ///< of programs that compute
  GlState();
  ~GlState();
  GlState(const GlState&) = delete;
  GlState& operator=(const GlState&) = delete;

  GLuint drawFramebuffer() const { return static_cast<GLuint>(m_drawFramebuffer); }

 private:
  struct Capability {
    GLenum name;
    GLboolean on;
  };
  struct Image {
    GLint name, level, layer, access, format;
    GLboolean layered;
  };
  struct Storage {
    GLint buffer;
    GLint64 start, size;
  };
  void readComputing();
  void restoreComputing() const;

  struct Unit {
    GLint texture, buffer, sampler;
  };
  GLint m_drawFramebuffer, m_readFramebuffer, m_program, m_vertexArray, m_activeTexture, m_arrayBuffer, m_uniformBuffer;
  GLint m_uniformBuffer0, m_textureBuffer, m_packBuffer, m_unpackBuffer, m_unpackAlignment, m_unpackRowLength;
  GLint64 m_uniformStart0 = 0, m_uniformSize0 = 0;
  std::array<GLint, 4> m_viewport, m_scissor;
  std::array<GLint, 6> m_blend;  // source rgb, destination rgb, source alpha, destination alpha, equations
  std::array<std::array<GLint, 7>, 2> m_stencil;  // by face: function, reference, masks, operations
  GLint m_depthFunction, m_cullFace, m_frontFace;
  std::array<GLint, 2> m_polygonMode;
  std::array<GLfloat, 4> m_clearColour;
  std::array<GLfloat, 2> m_depthRange;
  GLfloat m_clearDepth;
  GLboolean m_depthMask;
  std::array<GLboolean, 4> m_colourMask;
  std::array<Capability, 11> m_capabilities;
  std::array<Unit, kUnits> m_unitStates;
  std::array<Image, kImages> m_images;
  std::array<Storage, kStorages> m_storages;
  GLint m_storageBuffer;
};

}  // namespace ps::render
