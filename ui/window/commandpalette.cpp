// SPDX-License-Identifier: Apache-2.0
#include "ui/window/commandpalette.h"

#include "ui/rows/filterfield.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QApplication>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QStyledItemDelegate>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kWhere = Qt::UserRole + 1, kKeys = Qt::UserRole + 2, kIndex = Qt::UserRole + 3, kIdle = Qt::UserRole + 4;
constexpr int kWidth = 560, kRow = 28, kMostRows = 12;

class EntryDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {100, kRow}; }
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Theme& theme = Theme::current();
    const bool selected = option.state & QStyle::State_Selected;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    if (selected) paintBox(*painter, QRectF(option.rect), theme[Token::Selection], {}, 4);
    const QRectF row = QRectF(option.rect).adjusted(10, 0, -10, 0);
    const QString title = index.data().toString(), keys = index.data(kKeys).toString();
    const QFont font = Theme::font(TextRole::Normal), small = Theme::font(TextRole::Small);
    const double right = keys.isEmpty() ? 0 : textWidth(keys, small) + 12;
    const double w = std::min(textWidth(title, font) + 2, row.width() * 0.6);
    const bool idle = index.data(kIdle).toBool();
    paintText(*painter, QRectF(row.left(), row.top(), w, row.height()), Qt::AlignVCenter | Qt::AlignLeft, title, font,
              theme[idle ? Token::Disabled : Token::Text]);
    paintText(*painter, QRectF(row.left() + w + 10, row.top(), row.width() - w - 10 - right, row.height()),
              Qt::AlignVCenter | Qt::AlignLeft, index.data(kWhere).toString(), small,
              theme[selected ? Token::Text2 : Token::Muted]);
    paintText(*painter, row, Qt::AlignVCenter | Qt::AlignRight, keys, small,
              theme[idle ? Token::Disabled : Token::Text2]);
    painter->restore();
  }
};

}  // namespace

std::vector<size_t> paletteMatches(const std::vector<PaletteEntry>& entries, const QString& query) {
  const QStringList words = query.simplified().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  std::vector<std::pair<int, size_t>> found;
  for (size_t i = 0; i < entries.size(); ++i) {
    const PaletteEntry& entry = entries[i];
    const QString all = entry.title + QLatin1Char(' ') + entry.where + QLatin1Char(' ') + entry.words;
    const bool matches = std::all_of(words.begin(), words.end(),
                                     [&](const QString& word) { return all.contains(word, Qt::CaseInsensitive); });
    if (!matches) continue;
    const QString joined = words.join(QLatin1Char(' '));
    const auto inTitle = [&](const QString& before) {
      return !words.isEmpty() && (QLatin1Char(' ') + entry.title).contains(before + words.front(), Qt::CaseInsensitive);
    };
    const bool is = entry.title.compare(joined, Qt::CaseInsensitive) == 0;
    const bool begins = words.isEmpty() || entry.title.startsWith(joined, Qt::CaseInsensitive);
    const bool another = entry.words.split(QLatin1Char(' ')).contains(joined, Qt::CaseInsensitive);
    const bool asTyped = all.contains(joined, Qt::CaseInsensitive);
    // Help has many words: where they only all occur somewhere, even what would replace the scene comes before.
    const int rank = !entry.whyNot.isEmpty()        ? 8
                     : is                           ? 0
                     : begins                       ? 1
                     : entry.replaces               ? 6
                     : inTitle(QStringLiteral(" ")) ? 2
                     : another                      ? 3
                     : inTitle({})                  ? 4
                     : asTyped                      ? 5
                                                    : 7;
    found.emplace_back(rank, i);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<size_t> order;
  order.reserve(found.size());
  for (const auto& [rank, index] : found) order.push_back(index);
  return order;
}

CommandPalette::CommandPalette(QWidget* parent)
    : QWidget(parent), m_field(new QLineEdit), m_list(new QListWidget), m_nothing(new NothingFound(*m_field)) {
  setObjectName(QStringLiteral("psPalette"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->setSpacing(6);
  m_field->setPlaceholderText(QStringLiteral("Search every command and value"));
  m_field->setAccessibleName(QStringLiteral("Search every command and value"));
  m_list->setItemDelegate(new EntryDelegate(m_list));
  m_list->setFocusPolicy(Qt::NoFocus);
  m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_list->setAccessibleName(QStringLiteral("Found"));
  column->addWidget(m_field);
  column->addWidget(m_list);
  m_nothing->setContentsMargins(10, 6, 10, 6);
  column->addWidget(m_nothing, 1);
  m_field->installEventFilter(this);
  connect(m_field, &QLineEdit::textChanged, this, &CommandPalette::refresh);
  connect(m_list, &QListWidget::itemClicked, this, &CommandPalette::runCurrent);
  hide();
}

void CommandPalette::open(std::vector<PaletteEntry> entries) {
  m_entries = std::move(entries);
  m_before = QApplication::focusWidget();
  m_field->clear();
  refresh();
  const int height = 16 + 30 + 6 + kMostRows * kRow;
  const int width = std::min(kWidth, parentWidget()->width() - 40);
  setGeometry((parentWidget()->width() - width) / 2, 64, width, height);
  show();
  raise();
  m_field->setFocus(Qt::PopupFocusReason);
}

int CommandPalette::shownCount() const { return m_list->currentRow() < 0 ? 0 : m_list->count(); }

QString CommandPalette::currentTitle() const {
  return m_list->currentItem() ? m_list->currentItem()->text() : QString();
}

void CommandPalette::refresh() {
  m_list->clear();
  for (const size_t i : paletteMatches(m_entries, m_field->text())) {
    auto* item = new QListWidgetItem(m_entries[i].title, m_list);
    const QString& whyNot = m_entries[i].whyNot;
    item->setData(kWhere, whyNot.isEmpty() ? m_entries[i].where : whyNot);
    item->setData(kKeys, m_entries[i].keys);
    item->setData(kIdle, !whyNot.isEmpty());
    item->setToolTip(whyNot);
    item->setData(kIndex, static_cast<int>(i));
  }
  const bool any = m_list->count() > 0;
  if (any) m_list->setCurrentRow(0);
  m_nothing->standFor(*m_list, any);
}

void CommandPalette::runCurrent() {
  const QListWidgetItem* item = m_list->currentItem();
  if (!item || item->data(kIdle).toBool()) return;
  const auto run = m_entries[static_cast<size_t>(item->data(kIndex).toInt())].run;
  hide();
  if (m_before) m_before->setFocus(Qt::OtherFocusReason);
  if (run) run();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusOut && isVisible() && !isAncestorOf(QApplication::focusWidget())) {
    hide();
    return false;
  }
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Escape || key == Qt::Key_Up || key == Qt::Key_Down) {
      event->accept();
      return true;
    }
  }
  if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  if (key == Qt::Key_Escape) {
    hide();
    if (m_before) m_before->setFocus(Qt::OtherFocusReason);
    return true;
  }
  if (key == Qt::Key_Return || key == Qt::Key_Enter) {
    runCurrent();
    return true;
  }
  const int step = key == Qt::Key_Down       ? 1
                   : key == Qt::Key_Up       ? -1
                   : key == Qt::Key_PageDown ? kMostRows
                   : key == Qt::Key_PageUp   ? -kMostRows
                                             : 0;
  if (step == 0) return QWidget::eventFilter(watched, event);
  m_list->setCurrentRow(std::clamp(m_list->currentRow() + step, 0, std::max(0, m_list->count() - 1)));
  return true;
}

void CommandPalette::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Window]);
  paintBox(painter, QRectF(rect()), theme[Token::Panel], theme[Token::Line2], 7);
}

}  // namespace ps
