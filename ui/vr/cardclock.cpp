// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/cardclock.h"

#include <epoxy/gl.h>

namespace ps::vr {
namespace {
constexpr double kNanosecond = 1e-9;  // s
}  // namespace

CardClock::CardClock() { glGenQueries(static_cast<GLsizei>(m_queries.size()), m_queries.data()); }
CardClock::~CardClock() { glDeleteQueries(static_cast<GLsizei>(m_queries.size()), m_queries.data()); }

void CardClock::begin() {
  // One that has not been answered by now is given up.
  if (m_begun == m_read + m_queries.size()) ++m_read;
  glBeginQuery(GL_TIME_ELAPSED, m_queries[m_begun % m_queries.size()]);
}

void CardClock::end() {
  glEndQuery(GL_TIME_ELAPSED);
  ++m_begun;
  for (; m_read < m_begun; ++m_read) {
    const GLuint query = m_queries[m_read % m_queries.size()];
    GLint there = 0;
    glGetQueryObjectiv(query, GL_QUERY_RESULT_AVAILABLE, &there);
    if (!there) return;
    GLuint64 passed = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &passed);
    m_took = kNanosecond * static_cast<double>(passed);
  }
}

}  // namespace ps::vr
