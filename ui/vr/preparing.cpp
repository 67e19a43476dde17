// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/preparing.h"

#include <utility>

namespace ps::vr {

Preparing::Preparing() : m_thread([this] { run(); }) {}

Preparing::~Preparing() {
  {
    const std::lock_guard lock(m_mutex);
    m_ends = true;
  }
  m_changed.notify_all();
  m_thread.join();
}

bool Preparing::idle() const {
  const std::lock_guard lock(m_mutex);
  return !m_order;
}

void Preparing::begin(Order order) {
  {
    const std::lock_guard lock(m_mutex);
    m_order = std::move(order);
    m_done = false;
  }
  m_changed.notify_all();
}

bool Preparing::handTo(Renderer& renderer) {
  {
    const std::lock_guard lock(m_mutex);
    if (!m_done) return false;
    m_done = false;
    m_order.reset();
    if (m_failure) std::rethrow_exception(std::exchange(m_failure, nullptr));
  }
  renderer.take(m_preparation);
  return true;
}

void Preparing::wait() {
  std::unique_lock lock(m_mutex);
  m_changed.wait(lock, [this] { return !m_order || m_done; });
}

void Preparing::run() {
  static const Snapshot kEmpty;
  std::unique_lock lock(m_mutex);
  for (;;) {
    m_changed.wait(lock, [this] { return m_ends || (m_order && !m_done); });
    if (m_ends) return;
    const Order& order = *m_order;  // stays until it is done
    lock.unlock();
    std::exception_ptr failure;
    try {
      const HeadsetView& view = *order.view;
      m_preparation.make(view.matter ? *view.matter : kEmpty, order.before.get(), order.share, view.scene, view.look);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    m_failure = failure;
    m_done = true;
    m_changed.notify_all();
  }
}

}  // namespace ps::vr
