// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/strokemaker.h"

#include "core/base/callee.h"
#include "core/sketch/flooding.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ps {

StrokeMaker::StrokeMaker(std::string id, const api::BrushPlugin& brush, StrokeSetup setup, bool erases,
                         StrokeScene scene)
    : m_id(std::move(id)),
      m_brush(brush),
      m_setup(std::move(setup)),
      m_scene(std::move(scene)),
      m_kind(kindOf(brush, erases)),
      m_resampler(m_setup.grid.spacing) {
  m_filling.expect(1);
  m_filling.begin("Filling", 1, kMostFlooded);
}

std::span<const api::Cell> StrokeMaker::add(std::span<const api::StrokeSample> raw) {
  m_dense.clear();
  if (m_fed) m_dense.push_back(*m_fed);
  for (const api::StrokeSample& sample : raw) m_resampler.add(sample, m_dense);
  return feed();
}

std::span<const api::Cell> StrokeMaker::lift() {
  m_dense.clear();
  if (m_fed) m_dense.push_back(*m_fed);
  for (const api::StrokeSample& sample : m_resampler.finish()) m_dense.push_back(sample);
  feed();
  m_fed.reset();
  return m_fresh;
}

std::span<const api::Cell> StrokeMaker::feed() {
  m_fresh.clear();
  if (m_dense.size() == (m_fed ? 1 : 0)) return {};
  m_fed = m_dense.back();
  StrokeEdits& edits = ask();
  const bool fills = m_kind == api::EditKind::Fill, draws = fills || m_kind == api::EditKind::Add;
  if (fills) edits.filled = floodedFrom(edits.filled);
  for (const api::Cell& cell : edits.of(m_kind).cells()) {
    // What runs full has been kept within.
    const bool isOutside = draws && !fills && !isInScene(m_scene.environment, m_setup.grid, cell);
    if (isOutside) m_leavesScene = true;
    if (!m_cells.contains(cell) && !isOutside) m_fresh.push_back(cell);
  }
  m_cells.addOrdered(m_fresh);
  return m_fresh;
}

StrokeEdits& StrokeMaker::ask() {
  struct Asking {
    explicit Asking(std::atomic<bool>& flag) : asks(flag) { asks = true; }
    ~Asking() { asks = false; }
    std::atomic<bool>& asks;
  };
  const Asking asking(m_asks);
  const CalleeScope callee(m_id.c_str());
  return m_run.apply(m_brush, m_setup, m_kind, m_dense);
}

CellSet StrokeMaker::floodedFrom(const CellSet& seeds) {
  const ProgressScope filling(&m_filling);
  const Environment& environment = m_scene.environment;
  const FreeOf freeOf = [&](const SketchGrid& grid, const CellSet& cells) {
    std::vector<api::Cell> free;
    std::copy_if(cells.cells().begin(), cells.cells().end(), std::back_inserter(free), [&](const api::Cell& cell) {
      return isInScene(environment, grid, cell) && m_scene.isFree(grid.centreOf(cell));
    });
    return CellSet(free);
  };
  const BarrierOf barrierOf = [&](const SketchGrid& grid, const api::Cell& cell) {
    return barrierIn(environment, grid, cell);
  };
  return flooded(m_setup.grid, seeds, m_cells, environment.gravity, freeOf, kMostFlooded, barrierOf);
}

}  // namespace ps
