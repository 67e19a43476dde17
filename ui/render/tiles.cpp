// SPDX-License-Identifier: Apache-2.0
#include "ui/render/tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps::render {

void TileSet::reset(int width, int height) {
  m_width = width;
  m_height = height;
  m_columns = (width + kTile - 1) / kTile;
  m_rows = (height + kTile - 1) / kTile;
  m_marks.assign(static_cast<size_t>(m_columns * m_rows), 0);
}

void TileSet::mark(float x, float y, float reach) {
  if (!(x + reach >= 0 && y + reach >= 0 && x - reach <= static_cast<float>(m_width) &&
        y - reach <= static_cast<float>(m_height)))
    return;
  const auto tile = [](float pixel, int count) {
    return static_cast<int>(std::clamp(pixel / kTile, 0.f, static_cast<float>(count - 1)));
  };
  const int left = tile(x - reach, m_columns), right = tile(x + reach, m_columns);
  for (int row = tile(y - reach, m_rows); row <= tile(y + reach, m_rows); ++row)
    std::fill_n(m_marks.begin() + row * m_columns + left, right - left + 1, 1);
}

void TileSet::markLine(float x0, float y0, float x1, float y1, float reach) {
  const float length = std::hypot(x1 - x0, y1 - y0);
  const int steps = static_cast<int>(std::clamp(length / (0.75f * kTile), 0.f, 4096.f)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(steps);
    mark(x0 + (x1 - x0) * t, y0 + (y1 - y0) * t, reach);
  }
}

void TileSet::markAll() { std::fill(m_marks.begin(), m_marks.end(), 1); }

bool TileSet::full() const { return std::find(m_marks.begin(), m_marks.end(), 0) == m_marks.end(); }

void TileSet::remove(const TileSet& other) {
  for (size_t i = 0; i < m_marks.size(); ++i)
    m_marks[i] = static_cast<char>(m_marks[i] & ~other.m_marks[i]);  // 0 or 1, without a branch
}

void TileSet::pack(std::vector<uint32_t>& out) const {
  out.assign(1 + (m_marks.size() + 31) / 32, 0);
  out[0] = static_cast<uint32_t>(m_columns);
  for (size_t i = 0; i < m_marks.size(); ++i)
    if (m_marks[i]) out[1 + i / 32] |= 1u << (i % 32);
}

void TileSet::triangles(std::vector<Corner>& out) const {
  out.clear();
  const auto u = [&](int x) { return static_cast<float>(x * kTile) / static_cast<float>(m_width); };
  const auto v = [&](int y) { return 1 - static_cast<float>(y * kTile) / static_cast<float>(m_height); };
  for (int y = 0; y < m_rows; ++y)
    for (int x = 0; x < m_columns; ++x) {
      if (!marked(x, y)) continue;
      int end = x;
      while (end < m_columns && marked(end, y)) ++end;
      for (const auto& [a, b] : {std::pair{x, y}, {x, y + 1}, {end, y}, {end, y}, {x, y + 1}, {end, y + 1}})
        out.push_back({u(a), v(b)});
      x = end;
    }
}

}  // namespace ps::render
