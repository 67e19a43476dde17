// SPDX-License-Identifier: Apache-2.0
#include "ui/render/passclock.h"

#include <algorithm>

namespace ps::render {

PassClock::PassClock(std::vector<PassTime>* into) : m_into(into) { mark(""); }

PassClock::~PassClock() {
  GLuint64 before = 0;
  for (const auto& [pass, query] : m_marks) {
    GLuint64 now = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &now);
    glDeleteQueries(1, &query);
    if (*pass) {
      const auto is = [name = pass](const PassTime& time) { return time.pass == name; };
      const auto found = std::find_if(m_into->begin(), m_into->end(), is);
      PassTime& time = found == m_into->end() ? m_into->emplace_back(PassTime{pass, 0}) : *found;
      time.milliseconds += static_cast<double>(now - before) * 1e-6;
    }
    before = now;
  }
}

void PassClock::mark(const char* pass) {
  if (!m_into) return;
  GLuint query = 0;
  glGenQueries(1, &query);
  glQueryCounter(query, GL_TIMESTAMP);
  m_marks.emplace_back(pass, query);
}

}  // namespace ps::render
