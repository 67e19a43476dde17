// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/strokemaker.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace ps {

/// Makes one stroke on a thread of its own, so that the window does not wait for its brush, and one that does not come
/// back does not take the window along.
class StrokeThread {
 public:
  /// `ready` is called on that thread whenever something has come that take() would give.
  StrokeThread(std::unique_ptr<StrokeMaker> maker, std::function<void()> ready);
  ~StrokeThread();
  StrokeThread(const StrokeThread&) = delete;
  StrokeThread& operator=(const StrokeThread&) = delete;

  void add(const api::StrokeSample& raw);
  void lift();
  /// Cells that have come since, none of them twice. Throws what the maker has thrown, once all before it has been
  /// taken; from then on nothing comes.
  std::vector<api::Cell> take();
  /// All that was asked for has come, now or before so many milliseconds have passed.
  bool isIdle(std::chrono::milliseconds patience = std::chrono::milliseconds(0));
  /// Until all that was asked for has come. False: the brush does not come back, and is left.
  bool wait();
  /// Nothing more is drawn. Waits for the brush, unless it was left: what it gives then is dropped. False: it does not
  /// come back.
  bool drop();
  void leave() { m_left = true; }
  bool asksBrush() const;    ///< it is the brush that works now
  bool leavesScene() const;  ///< see StrokeMaker
  size_t places() const;     ///< of those that were added: how many have been drawn
  double filled() const;     ///< see StrokeMaker

 private:
  struct Shared;
  void ask(const std::optional<api::StrokeSample>& place);
  std::shared_ptr<Shared> m_shared;
  bool m_left = false;
};

}  // namespace ps
