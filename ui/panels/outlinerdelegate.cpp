// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/outlinerdelegate.h"

#include "ui/panels/outliner.h"
#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QLineEdit>

#include <algorithm>

namespace ps {
namespace {

constexpr int kRow = 24, kIcon = 16;
constexpr int kLeastEditor = 60;  // px, of the box in which a name is typed

std::string idOf(const QModelIndex& index) { return index.data(outline::kId).toString().toStdString(); }
/// Whether it can be hidden and locked.
bool hasMarks(const QModelIndex& index) { return index.data(outline::kVisible).isValid(); }
int kindOf(const QModelIndex& index) { return index.data(outline::kKind).toInt(); }
/// What of a row is meant for a mark in it: as wide as the row is high.
QRect around(const QRect& mark, const QRect& row) {
  const int beside = (row.height() - mark.width()) / 2;
  return {mark.left() - beside, row.top(), mark.width() + 2 * beside, row.height()};
}
/// px, where what is said of a row ends: before its swatch and its eye.
double detailEnd(const QRect& row, const QModelIndex& index) {
  if (!hasMarks(index)) return row.right() - 6;
  const int eye = OutlinerDelegate::eyeRect(row).left();
  return index.data(outline::kSwatch).isValid() ? eye - 21 : eye - 4;
}

}  // namespace

QRect OutlinerDelegate::eyeRect(const QRect& row) { return {row.right() - 24, row.top() + 2, 20, 20}; }
/// Takes the place of the count while the pointer is there, and for good when locked.
QRect OutlinerDelegate::lockRect(const QRect& row) { return {row.right() - 62, row.top() + 2, 20, 20}; }

/// Higher where the style says so: a board in a headset has larger rows.
QSize OutlinerDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  return {100, std::max(kRow, QStyledItemDelegate::sizeHint(option, index).height())};
}

void OutlinerDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const Theme& theme = Theme::current();
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  const bool selected = option.state & QStyle::State_Selected, hover = option.state & QStyle::State_MouseOver;
  const bool marks = hasMarks(index), visible = !marks || index.data(outline::kVisible).toBool();
  const QRect row = option.rect;
  if (selected || hover) painter->fillRect(row, theme[selected ? Token::Selection : Token::Header]);
  const QRectF text = row.adjusted(kIcon + 10, 0, 0, 0);
  const QColor ink = theme[!visible ? Token::Disabled : selected ? Token::Text : Token::Text2];
  paintIcon(*painter, QRectF(row.left() + 4, row.top() + 4, kIcon, kIcon), index.data(outline::kIcon).toString(), ink);
  double right = detailEnd(row, index);
  if (marks) {
    const bool locked = index.data(outline::kLocked).toBool();
    if (!visible || selected || hover) {
      paintIcon(*painter, QRectF(eyeRect(row)).adjusted(2, 2, -2, -2),
                visible ? QStringLiteral("eye") : QStringLiteral("eye-off"), ink);
    } else {
      paintIcon(*painter, QRectF(eyeRect(row)).adjusted(2, 2, -2, -2), QStringLiteral("eye"), theme[Token::Muted]);
    }
    if (locked || hover) {
      paintIcon(*painter, QRectF(lockRect(row)).adjusted(2, 2, -2, -2),
                locked ? QStringLiteral("lock") : QStringLiteral("lock-open"),
                theme[locked ? Token::Text2 : Token::Muted]);
    }
    const QRectF swatch(eyeRect(row).left() - 15, row.center().y() - 5, 11, 11);
    painter->setPen(QPen(theme[Token::Line2], 1));
    painter->setBrush(index.data(outline::kPlaceholder).toBool()
                          ? QBrush(theme[Token::Muted], Qt::BDiagPattern)
                          : QBrush(index.data(outline::kSwatch).value<QColor>()));
    if (index.data(outline::kSwatch).isValid()) painter->drawEllipse(swatch);
  }
  const QString detail = index.data(outline::kDetail).toString();
  const bool lockInstead = marks && (index.data(outline::kLocked).toBool() || hover);
  if (lockInstead) right = lockRect(row).left() - 2;
  const QFont small = Theme::font(TextRole::Small);
  const double w = textWidth(detail, small) + 2;
  const QString name = index.data(Qt::DisplayRole).toString();
  // A name goes before what is said of it.
  const bool both = textWidth(name, Theme::font(TextRole::Normal)) <= right - w - 6 - text.left();
  if (!detail.isEmpty() && !lockInstead && both) {
    paintText(*painter, QRectF(right - w, row.top(), w, row.height()), Qt::AlignRight | Qt::AlignVCenter, detail, small,
              theme[selected ? Token::Text2 : Token::Muted]);
    right -= w + 6;
  }
  paintText(*painter, QRectF(text.left(), row.top(), right - text.left(), row.height()),
            Qt::AlignLeft | Qt::AlignVCenter, name, Theme::font(TextRole::Normal), visible ? theme[Token::Text] : ink);
  if (option.state & QStyle::State_HasFocus) paintFocusRing(*painter, row, 4);
  painter->restore();
}

bool OutlinerDelegate::editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                                   const QModelIndex& index) {
  if (hasMarks(index) &&
      (event->type() == QEvent::MouseButtonRelease || event->type() == QEvent::MouseButtonDblClick)) {
    const QPoint at = static_cast<QMouseEvent*>(event)->position().toPoint();
    const bool release = event->type() == QEvent::MouseButtonRelease;
    if (around(eyeRect(option.rect), option.rect).contains(at)) {
      if (release) Q_EMIT visibleToggled(kindOf(index), idOf(index), !index.data(outline::kVisible).toBool());
      return true;
    }
    if (around(lockRect(option.rect), option.rect).contains(at)) {
      if (release) Q_EMIT lockToggled(kindOf(index), idOf(index), !index.data(outline::kLocked).toBool());
      return true;
    }
  }
  return QStyledItemDelegate::editorEvent(event, model, option, index);
}

/// Tab ends the naming, and names nothing else: the rows are made anew.
bool OutlinerDelegate::eventFilter(QObject* object, QEvent* event) {
  auto* editor = qobject_cast<QWidget*>(object);
  const int key = event->type() == QEvent::KeyPress ? static_cast<QKeyEvent*>(event)->key() : 0;
  if (!editor || (key != Qt::Key_Tab && key != Qt::Key_Backtab)) return QStyledItemDelegate::eventFilter(object, event);
  Q_EMIT commitData(editor);
  Q_EMIT closeEditor(editor);
  return true;
}

void OutlinerDelegate::setModelData(QWidget* editor, QAbstractItemModel*, const QModelIndex& index) const {
  if (auto* line = qobject_cast<QLineEdit*>(editor)) {
    Q_EMIT renamed(index.data(outline::kKind).toInt(), idOf(index), line->text());
  }
}

void OutlinerDelegate::updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                                            const QModelIndex& index) const {
  const QRect& row = option.rect;
  const int left = row.left() + kIcon + 6;
  int right = lockRect(row).left() - 2;
  // Beside the count, or, where that leaves no room to write in, over all of it.
  const QString detail = index.data(outline::kDetail).toString();
  if (!detail.isEmpty()) {
    const double end = detailEnd(row, index), begin = end - textWidth(detail, Theme::font(TextRole::Small)) - 2;
    right = static_cast<int>(begin - left < kLeastEditor ? std::max<double>(right, end + 2)
                                                         : std::min<double>(right, begin - 4));
  }
  editor->setGeometry(left, row.top() + 1, right - left, row.height() - 2);
}

}  // namespace ps
