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

std::vector<api::Cell> StrokeMaker::add(std::span<const api::StrokeSample> raw) {
  std::vector<api::StrokeSample> dense;
  for (const api::StrokeSample& sample : raw) {
    const std::vector<api::StrokeSample> more = m_resampler.add(sample);
    dense.insert(dense.end(), more.begin(), more.end());
  }
  return feed(std::move(dense));
}

std::vector<api::Cell> StrokeMaker::lift() {
  std::vector<api::Cell> cells = feed(m_resampler.finish());
  m_fed.reset();
  return cells;
}

std::vector<api::Cell> StrokeMaker::feed(std::vector<api::StrokeSample> samples) {
  if (samples.empty()) return {};
  if (m_fed) samples.insert(samples.begin(), *m_fed);
  m_fed = samples.back();
  StrokeEdits edits = ask(samples);
  const bool fills = m_kind == api::EditKind::Fill, draws = fills || m_kind == api::EditKind::Add;
  if (fills) edits.filled = floodedFrom(edits.filled);
  std::vector<api::Cell> fresh;
  for (const api::Cell& cell : edits.of(m_kind).cells()) {
    // What runs full has been kept within.
    const bool isOutside = draws && !fills && !isInScene(m_scene.environment, m_setup.grid, cell);
    if (isOutside) m_leavesScene = true;
    if (!m_cells.contains(cell) && !isOutside) fresh.push_back(cell);
  }
  m_cells.add(fresh);
  return fresh;
}

StrokeEdits StrokeMaker::ask(std::span<const api::StrokeSample> samples) {
  struct Asking {
    explicit Asking(std::atomic<bool>& flag) : asks(flag) { asks = true; }
    ~Asking() { asks = false; }
    std::atomic<bool>& asks;
  };
  const Asking asking(m_asks);
  const CalleeScope callee(m_id.c_str());
  return applyBrush(m_brush, m_setup, m_kind, samples);
}

CellSet StrokeMaker::floodedFrom(const CellSet& seeds) {
  const ProgressScope filling(&m_filling);
  const Environment& environment = m_scene.environment;
  return flooded(m_setup.grid, seeds, m_cells, environment.gravity, [&](const SketchGrid& grid, const CellSet& cells) {
    std::vector<api::Cell> free;
    std::copy_if(cells.cells().begin(), cells.cells().end(), std::back_inserter(free), [&](const api::Cell& cell) {
      return isInScene(environment, grid, cell) && m_scene.isFree(grid.centreOf(cell));
    });
    return CellSet(free);
  });
}

}  // namespace ps
