// SPDX-License-Identifier: Apache-2.0
#include "ui/render/bins.h"

#include <algorithm>

namespace ps::render {
namespace {

// The shaders (sort.comp) know the same.
constexpr int kGroup = 256;

GLuint groups(int count, int size) { return static_cast<GLuint>((count + size - 1) / size); }

/// Everything that reads what programs wrote: the next program, a texture's look-up, drawing over it.
void waitForStores() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace

void computePixels(int width, int height, int block) {
  glDispatchCompute(groups(width, block), groups(height, block), 1);
  waitForStores();
}

void Bins::sort(const std::vector<Order>& orders) {
  for (const Order& order : orders) order.bins.makeRoom(order);
  for (int turn = 0; turn < 3; ++turn) {
    for (const Order& order : orders)
      if (order.things > 0) order.bins.go(order, turn);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

/// Empty squares, too, but for a list of nothing, where nobody looks into any.
void Bins::makeRoom(const Order& order) {
  const auto& [width, height, smallest] = order.field;
  const size_t vectors = order.vectors;
  m_field = order.field;
  m_vectors = vectors;
  m_sizes = 0;
  m_squareCount = 0;
  for (int side = 1 << smallest; order.things > 0 && (m_sizes == 0 || side / 2 < std::max(width, height));
       side *= 2, ++m_sizes)
    m_squareCount += size_t{groups(width, side)} * groups(height, side);
  const size_t count = std::max<size_t>(order.things, 1);
  m_things.reserve(GL_SHADER_STORAGE_BUFFER, count * vectors * 16);
  m_places.reserve(GL_SHADER_STORAGE_BUFFER, count * 8);
  m_list.reserve(GL_SHADER_STORAGE_BUFFER, count * 16);
  m_sorted.reserve(GL_SHADER_STORAGE_BUFFER, count * 4 * vectors * 16);
  m_squares.reserve(GL_SHADER_STORAGE_BUFFER, (m_squareCount + 1) * 8);
  if (order.things == 0) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);  // programs may still fill it
  glClearBufferSubData(GL_SHADER_STORAGE_BUFFER, GL_R32UI, 0, static_cast<GLsizeiptr>((m_squareCount + 1) * 8),
                       GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
}

void Bins::go(const Order& order, int turn) const {
  const Program& program = order.sort;
  program.use();
  order.tell();
  tell(program);
  const auto all = static_cast<int>(turn == 1 ? m_squareCount : order.things);
  glUniform1i(program.at("turn"), turn);
  glUniform1i(program.at("count"), all);
  glDispatchCompute(groups(all, kGroup), 1, 1);
}

void Bins::run(const Program& program, int block) const {
  tell(program);
  computePixels(m_field.width, m_field.height, block);
}

void Bins::tell(const Program& program) const {
  GLuint binding = 0;
  for (const Buffer* buffer : {&m_things, &m_places, &m_squares, &m_list})
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding++, buffer->name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, m_sorted.name());
  glUniform1i(program.at("vectors"), static_cast<GLint>(m_vectors));
  glUniform2i(program.at("field"), m_field.width, m_field.height);
  glUniform1i(program.at("squareSizes"), m_sizes);
  glUniform1i(program.at("smallest"), m_field.smallest);
}

}  // namespace ps::render
