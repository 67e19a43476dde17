// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/solver/solver.h"

#include <functional>
#include <future>
#include <memory>

// The one seam by which tests reach into a scene that runs: they push particles about to make failures that no edit
// makes. Programs have const views and commands.
namespace ps::tests {

inline Engine& handsOn(const Engine& engine) { return const_cast<Engine&>(engine); }
inline Solver& solverOf(const Engine& engine) { return const_cast<Solver&>(engine.solver()); }

/// Waits until the engine has done all that was asked of it, runs `ask` on its thread, and has what it did published.
template <class T>
T onEngine(EngineThread& engine, std::function<T(Engine&)> ask) {
  auto promise = std::make_shared<std::promise<T>>();
  std::future<T> future = promise->get_future();
  engine.ask([promise, ask](const Engine& e) { promise->set_value(ask(handsOn(e))); });
  engine.apply(ForgetMatter{});
  return future.get();
}

}  // namespace ps::tests
