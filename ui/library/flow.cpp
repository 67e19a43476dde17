// SPDX-License-Identifier: Apache-2.0
#include "ui/library/flow.h"

#include <algorithm>

namespace ps {

Flow::~Flow() { qDeleteAll(m_items); }

void Flow::addItem(QLayoutItem* item) {
  m_items << item;
  invalidate();
}

QLayoutItem* Flow::takeAt(int index) { return index >= 0 && index < m_items.size() ? m_items.takeAt(index) : nullptr; }

QSize Flow::minimumSize() const {
  QSize least;
  for (const QLayoutItem* item : m_items) least = least.expandedTo(item->minimumSize());
  return least;
}

void Flow::setGeometry(const QRect& rect) {
  QLayout::setGeometry(rect);
  arrange(rect, true);
}

int Flow::arrange(const QRect& rect, bool moves) const {
  int x = rect.left(), y = rect.top(), height = 0;
  for (QLayoutItem* item : m_items) {
    const QSize size = item->sizeHint();
    if (x > rect.left() && x + size.width() > rect.left() + rect.width()) {
      x = rect.left();
      y += height + spacing();
      height = 0;
    }
    if (moves) item->setGeometry({QPoint(x, y), size});
    x += size.width() + spacing();
    height = std::max(height, size.height());
  }
  return y + height - rect.top();
}

}  // namespace ps
