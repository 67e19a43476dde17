// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/mirror.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ps::vr {

struct Mirror::Slot {
  uint32_t texture = 0;
  int x = 0, y = 0;        ///< where what is shown of it begins, pixels
  PictureSize size{0, 0};  ///< of that
  PictureSize held{0, 0};  ///< of the texture
  GLsync written = nullptr, read = nullptr;
  uint64_t number = 0;  ///< 0: nothing yet
};

struct Mirror::Slots {
  std::array<Slot, 3> all;
};

namespace {

/// Without waiting. What was never begun is done.
bool isDone(GLsync sync) {
  if (!sync) return true;
  const GLenum state = glClientWaitSync(sync, 0, 0);
  return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

void mark(GLsync& sync) {
  if (sync) glDeleteSync(sync);
  sync = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();  // or nobody else ever sees it
}

/// Makes a picture's storage, and leaves what is bound as it is.
void store(uint32_t& texture, const PictureSize& size) {
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  if (texture) glDeleteTextures(1, &texture);
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, size.width, size.height);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
}

/// x and y from and to, of the middle part of a picture that has the proportions of another one.
std::array<int, 4> cut(const PictureSize& from, const PictureSize& to) {
  const double scale = std::min(double(from.width) / to.width, double(from.height) / to.height);
  const int width = std::max(1, static_cast<int>(std::lround(scale * to.width)));
  const int height = std::max(1, static_cast<int>(std::lround(scale * to.height)));
  const int x = (from.width - width) / 2, y = (from.height - height) / 2;
  return {x, y, x + width, y + height};
}

}  // namespace

Mirror::Mirror() : m_slots(std::make_unique<Slots>()) {}
Mirror::~Mirror() = default;

/// Neither the newest one, which the window may take next, nor one that it still reads.
Mirror::Slot* Mirror::freeSlot() {
  for (Slot& slot : m_slots->all)
    if ((slot.number == 0 || slot.number != m_number) && isDone(slot.read)) return &slot;
  return nullptr;
}

Mirror::Slot* Mirror::newestDone() {
  Slot* newest = nullptr;
  for (Slot& slot : m_slots->all)
    if (slot.number > 0 && (!newest || slot.number > newest->number) && isDone(slot.written)) newest = &slot;
  return newest;
}

void Mirror::offer(uint32_t texture, const PictureSize& size) {
  if (!m_wanted) return;
  const std::unique_lock lock(m_mutex, std::try_to_lock);
  if (!lock || m_closed) return;
  Slot* slot = freeSlot();
  if (!slot) return;
  if (slot->held.width < size.width || slot->held.height < size.height) {
    store(slot->texture, size);
    slot->held = size;
  }
  const auto [left, low, right, high] =
      m_window.width > 0 ? cut(size, m_window) : std::array{0, 0, size.width, size.height};
  slot->x = left;
  slot->y = low;
  slot->size = {right - left, high - low};
  // A pixel around it, too, which the window looks at where it smooths. Bit by bit: nothing is decoded or encoded.
  const int x = std::max(left - 1, 0), y = std::max(low - 1, 0);
  glCopyImageSubData(texture, GL_TEXTURE_2D, 0, x, y, 0, slot->texture, GL_TEXTURE_2D, 0, x, y, 0,
                     std::min(right + 1, size.width) - x, std::min(high + 1, size.height) - y, 1);
  slot->number = ++m_number;
  mark(slot->written);
  m_wanted = false;
}

bool Mirror::draw(uint32_t framebuffer, const PictureSize& size, bool again) {
  const std::unique_lock lock(m_mutex, std::try_to_lock);
  if (!lock || m_closed) return false;
  m_window = size;
  Slot* slot = newestDone();
  if (!slot || (slot->number <= m_drawn && !again)) return false;
  GLint reads = 0, draws = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &reads);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draws);
  GLuint from = 0;
  glGenFramebuffers(1, &from);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, slot->texture, 0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  const auto [left, low, right, high] = cut(slot->size, size);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(slot->x + left, slot->y + low, slot->x + right, slot->y + high, 0, 0, size.width, size.height,
                    GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(reads));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draws));
  glDeleteFramebuffers(1, &from);
  mark(slot->read);
  m_drawn = slot->number;
  return true;
}

void Mirror::close() {
  const std::lock_guard lock(m_mutex);
  m_closed = true;
  for (Slot& slot : m_slots->all) {
    for (GLsync sync : {slot.written, slot.read})
      if (sync) glDeleteSync(sync);
    if (slot.texture) glDeleteTextures(1, &slot.texture);
    slot = {};
  }
}

}  // namespace ps::vr
