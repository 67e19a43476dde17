// SPDX-License-Identifier: Apache-2.0
#include "ui/welcome/cardgrid.h"

#include <QtGui/QKeyEvent>

#include <algorithm>

namespace ps {
namespace {
constexpr int kLeast = 200, kGap = 14;
}  // namespace

CardGrid::CardGrid(QWidget* parent) : QWidget(parent) {
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

void CardGrid::setSamples(const std::vector<Sample>& samples) {
  qDeleteAll(m_cards);
  m_cards.clear();
  for (const Sample& sample : samples) {
    auto* card = new Card(sample, this);
    card->installEventFilter(this);
    connect(card, &QAbstractButton::clicked, this, [this, path = sample.path] { Q_EMIT chosen(path); });
    m_cards.push_back(card);
  }
  setTag({});
}

void CardGrid::setTag(const QString& tag) {
  for (Card* card : m_cards) card->setVisible(tag.isEmpty() || card->sample().tags.contains(tag));
  updateGeometry();
  place();
}

std::vector<Card*> CardGrid::cards() const {
  std::vector<Card*> shown;
  std::copy_if(m_cards.begin(), m_cards.end(), std::back_inserter(shown), [](Card* card) { return !card->isHidden(); });
  return shown;
}

int CardGrid::columnsIn(int width) const { return std::max(1, (width + kGap) / (kLeast + kGap)); }
int CardGrid::cardWidth(int width) const { return (width + kGap) / columnsIn(width) - kGap; }

/// Row by row, as high as the longest words of each need.
int CardGrid::arrange(int width, bool moves) const {
  const std::vector<Card*> shown = cards();
  const auto columns = static_cast<size_t>(columnsIn(width));
  const int wide = cardWidth(width);
  int top = 0;
  for (size_t first = 0; first < shown.size(); first += columns) {
    const size_t end = std::min(first + columns, shown.size());
    Card::Lines lines;
    for (size_t i = first; i < end; ++i) {
      const Card::Lines wanted = shown[i]->wanted(wide);
      lines = {std::max(lines.summary, wanted.summary), std::max(lines.toTry, wanted.toTry)};
    }
    const int high = Card::heightFor(wide, lines);
    for (size_t i = first; moves && i < end; ++i) {
      shown[i]->setLines(lines);
      shown[i]->setGeometry(static_cast<int>(i - first) * (wide + kGap), top, wide, high);
    }
    top += high + kGap;
  }
  return std::max(0, top - kGap);
}

int CardGrid::heightForWidth(int width) const { return arrange(width, false); }
void CardGrid::place() { arrange(width(), true); }

void CardGrid::resizeEvent(QResizeEvent*) { place(); }

bool CardGrid::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusIn) Q_EMIT focused(static_cast<QWidget*>(watched));
  if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  auto* card = static_cast<Card*>(watched);
  if (key == Qt::Key_Return || key == Qt::Key_Enter) {
    card->click();
    return true;
  }
  const int columns = columnsIn(width());
  const int step = key == Qt::Key_Right  ? 1
                   : key == Qt::Key_Left ? -1
                   : key == Qt::Key_Down ? columns
                   : key == Qt::Key_Up   ? -columns
                                         : 0;
  if (step == 0) return QWidget::eventFilter(watched, event);
  const std::vector<Card*> shown = cards();
  const auto at = static_cast<int>(std::find(shown.begin(), shown.end(), card) - shown.begin()) + step;
  if (at >= 0 && at < static_cast<int>(shown.size())) shown[static_cast<size_t>(at)]->setFocus(Qt::TabFocusReason);
  return true;
}

}  // namespace ps
