// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

// Owners of OpenGL objects. Textures, buffers and programs are shared among contexts of a group; framebuffers and
// vertex arrays are not, so those live for one frame only and a renderer may be used and destroyed in any context of
// its group.
namespace ps::render {

class Program {
 public:
  using Files = std::vector<const char*>;
  /// Names of embedded files, which follow frame.glsl, and hidden.glsl where they compute, in this order. Throws Error
  /// with the compiler's words.
  Program(const Files& vertex, const Files& fragment);
  explicit Program(const Files& compute);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { glUseProgram(m_program); }
  /// -1 where the shader does not use it, which glUniform ignores.
  GLint at(const char* uniform) const;
  /// Binds a texture to a unit and the sampler `uniform` to it; the program must be in use.
  void texture(const char* uniform, int unit, GLuint name, GLenum target = GL_TEXTURE_2D) const;

 private:
  void link(const std::string& what);

  GLuint m_program = 0;
  mutable std::map<std::string, GLint, std::less<>> m_uniforms;
};

class Texture {
 public:
  Texture(GLint internalFormat, GLint filter, GLint wrap = GL_CLAMP_TO_EDGE);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  /// New storage when the size differs. Contents are undefined then.
  void resize(int width, int height);
  void upload(int width, int height, GLenum format, GLenum type, const void* data);
  /// For programs that compute, as the image of that number.
  void bindImage(GLuint unit, GLenum access = GL_WRITE_ONLY) const;
  GLuint name() const { return m_name; }
  bool hasStencil() const { return m_internalFormat == GL_DEPTH24_STENCIL8; }
  int width() const { return m_width; }
  int height() const { return m_height; }

 private:
  GLuint m_name = 0;
  GLint m_internalFormat;
  int m_width = 0, m_height = 0;
};

/// Lets shaders read a buffer's floats, four to a texel.
class BufferTexture {
 public:
  BufferTexture();
  ~BufferTexture();
  BufferTexture(const BufferTexture&) = delete;
  BufferTexture& operator=(const BufferTexture&) = delete;
  /// Binds it to a texture unit with `buffer` as its storage.
  void bind(int unit, GLuint buffer) const;

 private:
  GLuint m_name = 0;
};

class Buffer {
 public:
  Buffer();
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  /// Replaces the contents; what the GPU still reads of the old ones stays.
  void upload(GLenum target, const void* data, size_t bytes);
  /// Room for so many bytes or more, undefined; bound to `target` afterwards. Never less than before: new storage for
  /// every list in turn would cost more than it saves.
  void reserve(GLenum target, size_t bytes);
  GLuint name() const { return m_name; }

 private:
  GLuint m_name = 0;
  size_t m_bytes = 0;
};

/// Somebody's texture as one of RGBA8 that programs may write, bit by bit: itself, or a view of it where it is sRGB.
class WritableView {
 public:
  explicit WritableView(GLuint texture);  ///< two-dimensional; or 0
  ~WritableView();
  WritableView(const WritableView&) = delete;
  WritableView& operator=(const WritableView&) = delete;
  GLuint name() const { return m_view ? m_view : m_own; }  ///< 0 where there is no such view

 private:
  GLuint m_own = 0, m_view = 0;
};

/// Binds a framebuffer over textures for as long as it lives, with a viewport of their size.
class Target {
 public:
  Target(std::initializer_list<const Texture*> colours, const Texture* depth);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  GLuint name() const { return m_name; }

 private:
  GLuint m_name = 0;
};

/// Makes what one context has the graphics card do wait for what another had it do before.
class Fence {
 public:
  Fence() = default;
  ~Fence();
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;
  void set();         ///< after everything up to now
  void wait() const;  ///< the card does, not the processor

 private:
  GLsync m_sync = nullptr;
};

class VertexArray {
 public:
  VertexArray();
  ~VertexArray();
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  void bind() const { glBindVertexArray(m_name); }

 private:
  GLuint m_name = 0;
};

inline constexpr float kFar = 1e6f;  ///< distance where there is nothing, m; frame.glsl knows the same

/// Of the framebuffer that is bound.
void clearColour(GLint buffer, float r, float g, float b, float a);
void clearDepth();
/// Pixels x, y, width, height of a picture of the same size and format: a copy of memory where a processor draws.
void copyPicture(const Texture& from, const Texture& to, const std::array<int, 4>& box);
/// Pixels along a side of a picture that has one for each `scale` of `pixels`.
inline int reduced(int pixels, int scale) { return (pixels + scale - 1) / scale; }

}  // namespace ps::render
