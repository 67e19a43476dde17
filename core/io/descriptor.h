// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <unistd.h>

namespace ps {

/// An open file, which is closed on the way out; negative: none.
class Descriptor {
 public:
  explicit Descriptor(int fd) : m_fd(fd) {}
  ~Descriptor() {
    if (m_fd >= 0) ::close(m_fd);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return m_fd; }

 private:
  int m_fd;
};

}  // namespace ps
