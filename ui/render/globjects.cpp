// SPDX-License-Identifier: Apache-2.0
#include "ui/render/globjects.h"

#include "core/base/error.h"
#include "ui/render/resource.h"

#include <array>

namespace ps::render {
namespace {

GLuint compile(GLenum stage, Program::Files files) {
  if (stage == GL_COMPUTE_SHADER) files.insert(files.begin(), "hidden.glsl");
  std::string source = "#version 430 core\n";
  source += embeddedText("frame.glsl");
  for (const char* file : files) {
    const std::string_view text = embeddedText(file);
    if (text.empty()) throw Error(std::string("shader ") + file + " is not built in");
    source += "#line 1\n";
    source += text;
  }
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint ok = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok) return shader;
  std::array<char, 2048> log{};
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteShader(shader);
  throw Error(std::string("shader ") + files.back() + " does not compile: " + log.data());
}

}  // namespace

Program::Program(const Files& vertex, const Files& fragment) {
  const GLuint first = compile(GL_VERTEX_SHADER, vertex);
  GLuint second = 0;
  try {
    second = compile(GL_FRAGMENT_SHADER, fragment);
  } catch (...) {
    glDeleteShader(first);
    throw;
  }
  m_program = glCreateProgram();
  for (const GLuint shader : {first, second}) {
    glAttachShader(m_program, shader);
    glDeleteShader(shader);
  }
  link(std::string("shaders ") + vertex.back() + " and " + fragment.back() + " do");
}

Program::Program(const Files& compute) {
  const GLuint shader = compile(GL_COMPUTE_SHADER, compute);
  m_program = glCreateProgram();
  glAttachShader(m_program, shader);
  glDeleteShader(shader);
  link(std::string("shader ") + compute.front() + " does");
}

void Program::link(const std::string& what) {
  glLinkProgram(m_program);
  GLint ok = 0;
  glGetProgramiv(m_program, GL_LINK_STATUS, &ok);
  if (ok) return;
  std::array<char, 2048> log{};
  glGetProgramInfoLog(m_program, static_cast<GLsizei>(log.size()), nullptr, log.data());
  glDeleteProgram(m_program);
  throw Error(what + " not link: " + log.data());
}

Program::~Program() { glDeleteProgram(m_program); }

GLint Program::at(const char* uniform) const {
  const auto found = m_uniforms.find(std::string_view(uniform));
  if (found != m_uniforms.end()) return found->second;
  return m_uniforms[uniform] = glGetUniformLocation(m_program, uniform);
}

void Program::texture(const char* uniform, int unit, GLuint name, GLenum target) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, name);
  glUniform1i(at(uniform), unit);
}

Texture::Texture(GLint internalFormat, GLint filter, GLint wrap) : m_internalFormat(internalFormat) {
  glGenTextures(1, &m_name);
  glBindTexture(GL_TEXTURE_2D, m_name);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter == GL_NEAREST ? GL_NEAREST : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
}

Texture::~Texture() { glDeleteTextures(1, &m_name); }

void Texture::resize(int width, int height) {
  if (width == m_width && height == m_height) return;
  if (hasStencil())
    upload(width, height, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, nullptr);
  else if (m_internalFormat == GL_DEPTH_COMPONENT24)
    upload(width, height, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  else if (m_internalFormat == GL_R32UI)
    upload(width, height, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  else
    upload(width, height, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
}

void Texture::upload(int width, int height, GLenum format, GLenum type, const void* data) {
  glBindTexture(GL_TEXTURE_2D, m_name);
  if (width == m_width && height == m_height && data)
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, format, type, data);
  else
    glTexImage2D(GL_TEXTURE_2D, 0, m_internalFormat, width, height, 0, format, type, data);
  m_width = width;
  m_height = height;
}

void Texture::bindImage(GLuint unit, GLenum access) const {
  glBindImageTexture(unit, m_name, 0, GL_FALSE, 0, access, static_cast<GLenum>(m_internalFormat));
}

BufferTexture::BufferTexture() { glGenTextures(1, &m_name); }
BufferTexture::~BufferTexture() { glDeleteTextures(1, &m_name); }

void BufferTexture::bind(int unit, GLuint buffer) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_BUFFER, m_name);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer);
}

Buffer::Buffer() { glGenBuffers(1, &m_name); }
Buffer::~Buffer() { glDeleteBuffers(1, &m_name); }

void Buffer::upload(GLenum target, const void* data, size_t bytes) {
  glBindBuffer(target, m_name);
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
  m_bytes = bytes;
}

void Buffer::reserve(GLenum target, size_t bytes) {
  glBindBuffer(target, m_name);
  if (bytes <= m_bytes) return;
  glBufferData(target, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_COPY);
  m_bytes = bytes;
}

WritableView::WritableView(GLuint texture) {
  if (!texture) return;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
  GLint format = 0, fixed = GL_FALSE;
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_IMMUTABLE_FORMAT, &fixed);
  if (format == GL_RGBA8) m_own = texture;
  if (format != GL_SRGB8_ALPHA8 || !fixed) return;  // only storage that never changes can be seen in two ways
  glGenTextures(1, &m_view);
  glTextureView(m_view, GL_TEXTURE_2D, texture, GL_RGBA8, 0, 1, 0, 1);
}

WritableView::~WritableView() {
  if (m_view) glDeleteTextures(1, &m_view);
}

Target::Target(std::initializer_list<const Texture*> colours, const Texture* depth) {
  glGenFramebuffers(1, &m_name);
  glBindFramebuffer(GL_FRAMEBUFFER, m_name);
  std::array<GLenum, 4> buffers{};
  GLsizei count = 0;
  const Texture* any = depth;
  for (const Texture* colour : colours) {
    const auto attachment = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + count);
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, colour->name(), 0);
    buffers[static_cast<size_t>(count++)] = attachment;
    any = colour;
  }
  if (depth)
    glFramebufferTexture2D(GL_FRAMEBUFFER, depth->hasStencil() ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                           GL_TEXTURE_2D, depth->name(), 0);
  if (count)
    glDrawBuffers(count, buffers.data());
  else
    glDrawBuffer(GL_NONE);
  glReadBuffer(count ? GL_COLOR_ATTACHMENT0 : GL_NONE);
  if (any) glViewport(0, 0, any->width(), any->height());
}

Target::~Target() { glDeleteFramebuffers(1, &m_name); }

Fence::~Fence() { glDeleteSync(m_sync); }

void Fence::set() {
  glDeleteSync(m_sync);
  m_sync = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();  // a fence that never leaves this context would never be passed
}

void Fence::wait() const {
  if (m_sync) glWaitSync(m_sync, 0, GL_TIMEOUT_IGNORED);
}

VertexArray::VertexArray() { glGenVertexArrays(1, &m_name); }
VertexArray::~VertexArray() { glDeleteVertexArrays(1, &m_name); }

void clearColour(GLint buffer, float r, float g, float b, float a) {
  const float value[] = {r, g, b, a};
  glClearBufferfv(GL_COLOR, buffer, value);
}
void copyPicture(const Texture& from, const Texture& to, const std::array<int, 4>& box) {
  const Target target({&to}, nullptr), source({&from}, nullptr);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.name());
  const int right = box[0] + box[2], top = box[1] + box[3];
  glBlitFramebuffer(box[0], box[1], right, top, box[0], box[1], right, top, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}
void clearDepth() {
  const float one = 1;
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_DEPTH, 0, &one);
}

}  // namespace ps::render
