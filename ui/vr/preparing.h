// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/headsetlink.h"

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace ps::vr {

/// Has pictures of matter prepared on a thread of its own, one at a time: with a hundred thousand particles that takes
/// as long as a headset's frame, which then goes on with the matter as it was.
class Preparing {
 public:
  struct Order {
    std::shared_ptr<const HeadsetView> view;
    SnapshotPtr before;  ///< nullptr: nothing moves from there
    double share = 1;    ///< of the way from there to the view's matter
  };
  Preparing();
  ~Preparing();  ///< waits until what is begun is done
  Preparing(const Preparing&) = delete;
  Preparing& operator=(const Preparing&) = delete;

  /// Nothing is begun, and what was done has been handed over.
  bool idle() const;
  void begin(Order order);  ///< when idle
  /// Hands what is done to a renderer, whose context is current; whether there was something. Throws what it threw.
  bool handTo(Renderer& renderer);
  void wait();  ///< until what is begun is done

 private:
  void run();

  mutable std::mutex m_mutex;
  std::condition_variable m_changed;
  std::optional<Order> m_order;
  bool m_done = false, m_ends = false;
  std::exception_ptr m_failure;
  Preparation m_preparation;  ///< the thread's while there is an order that is not done
  std::thread m_thread;
};

}  // namespace ps::vr
