// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/strokemaker.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ps {

/// Makes one stroke on a thread of its own, so that the window does not wait for its brush, and one that does not come
/// back does not take the window along.
class StrokeThread {
 public:
  /// `brush`: its id. `ready` is called on that thread whenever something has come that take() would give.
  StrokeThread(std::string brush, std::unique_ptr<StrokeMaker> maker, std::function<void()> ready);
  /// Drops what has not been taken, and waits for the brush unless it was left: what it gives then is dropped too.
  ~StrokeThread();
  StrokeThread(const StrokeThread&) = delete;
  StrokeThread& operator=(const StrokeThread&) = delete;

  void add(const api::StrokeSample& raw);
  void lift();
  /// Cells that have come since, none of them twice. Throws what the maker has thrown, once all before it has been
  /// taken; from then on nothing comes.
  std::vector<api::Cell> take();
  /// Until all that was asked for has come. False: the brush does not come back, and is left.
  bool wait();
  void leave() { m_left = true; }
  /// What has been asked for and has not come, and how much has come in all.
  std::pair<size_t, size_t> progress() const;

 private:
  struct Shared;
  void ask(std::function<std::vector<api::Cell>(StrokeMaker&)> job);
  std::shared_ptr<Shared> m_shared;
  bool m_left = false;
};

}  // namespace ps
