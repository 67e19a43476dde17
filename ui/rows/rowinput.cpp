// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowvalue.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"

#include <QtCore/QMetaMethod>
#include <QtGui/QHelpEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QLineEdit>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kStill = 3;  ///< a curve is not scaled by a click whose hand is not quite still
constexpr int kGrip = 7;      ///< a press this near to the handle's centre holds it; farther away the handle jumps

/// To three digits.
double roundedFactor(double factor) {
  const double unit = std::pow(10.0, std::floor(std::log10(factor)) - 2);
  return std::round(factor / unit) * unit;
}

QRect grown(const QRect& rect) { return rect.adjusted(-4, 0, 4, 0); }

}  // namespace

void ParameterRow::Private::toggle() { single(q->number() == 0); }

void ParameterRow::Private::choose(int index) {
  const int count = static_cast<int>(choiceNames(declaration()).size());
  single(valueOfNumber(declaration(), std::clamp(index, 0, count - 1)));
}

void ParameterRow::Private::stepBy(double steps, bool fine) {
  const auto kind = declaration().kind;
  if (kind == api::ParameterKind::Choice) {
    choose(static_cast<int>(q->number()) - (steps > 0 ? 1 : -1));  // up is the one above in the list
  } else if (kind != api::ParameterKind::Toggle && !showsCurve() && !model.mixed) {
    begin();
    change(valueOfNumber(declaration(), stepped(declaration(), q->number(), steps, fine)));
    settle.start();
  }
}

void ParameterRow::Private::dragTo(double x, Qt::KeyboardModifiers modifiers) {
  const bool fine = modifiers & Qt::ShiftModifier;
  dragPosition += (x - dragX) / q->sliderRect().width() * (fine ? 0.1 : 1);
  dragX = x;
  if (showsCurve()) {
    scaled = scaled || std::abs(x - dragFrom) >= kStill;
    const double factor = roundedFactor(std::pow(10.0, dragPosition));
    const Value value = std::get<Response>(dragCurve).scaled(factor);
    if (!scaled || !problemOf(value, declaration()).empty()) return;
    if (!mixedBefore) return change(value);
    model.value = value;  // of the owner whose curve is shown; the others' keep their shapes too
    refresh();
    Q_EMIT q->scaled(model.key, factor, 0);
    return;
  }
  const double value = valueAtPosition(declaration(), dragPosition);
  const double kept =
      modifiers & Qt::AltModifier ? snappedToRound(declaration(), value) : roundedForSlider(declaration(), value, fine);
  change(valueOfNumber(declaration(), kept));
}

void ParameterRow::Private::pressed(const QPoint& at, Qt::KeyboardModifiers modifiers) {
  if (modifiers & Qt::ControlModifier && isNumeric()) {
    q->startTyping();
    return;
  }
  switch (declaration().kind) {
    case api::ParameterKind::Toggle:
      if (switchRect().adjusted(-6, -5, 6, 5).contains(at)) toggle();
      return;
    case api::ParameterKind::Choice: {
      const std::vector<QRect> rects = segments();
      for (size_t i = 0; i < rects.size(); ++i) {
        if (rects[i].adjusted(-1, -3, 1, 3).contains(at)) choose(static_cast<int>(i));
      }
      if (rects.empty() && choiceRect().contains(at)) openChoiceMenu();
      return;
    }
    default:
      break;
  }
  const bool onField = q->fieldRect().contains(at), onSlider = grown(q->sliderRect()).contains(at);
  if (onField) {
    q->startTyping();
  } else if (showsCurve() && targetOf(curveRect()).contains(at)) {
    Q_EMIT q->curveRequested(model.key);
  } else if (onSlider) {
    begin();
    dragging = true;
    dragCancelled = false;
    dragX = at.x();
    if (showsCurve()) {
      dragCurve = model.value;
      dragPosition = 0;
      dragFrom = at.x();
      scaled = false;
      return;
    }
    dragPosition = sliderPosition(declaration(), q->number());
    if (model.mixed || std::abs(at.x() - handleX()) > kGrip) {
      const QRectF track = q->sliderRect();
      dragPosition = (at.x() - track.left()) / track.width();
      dragTo(at.x(), modifiers);
    }
    q->update();
  }
}

void ParameterRow::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) {
    QWidget::mousePressEvent(event);
    return;
  }
  event->accept();
  if (!d->model.derivedFrom.isEmpty() && event->position().x() > labelRect().right()) {
    Q_EMIT sourceRequested(key());
  } else if (d->takesKeys() && d->targetOf(keyRect()).contains(event->position().toPoint())) {
    toggleKey();
  } else if (d->isEditable()) {
    d->finish();
    d->pressed(event->position().toPoint(), event->modifiers());
  }
}

bool ParameterRow::Private::hasEditor() const {
  return showsCurve() && isEditable() && q->isSignalConnected(QMetaMethod::fromSignal(&ParameterRow::curveRequested));
}

bool ParameterRow::Private::leadsTo(const QPoint& at) const {
  if (at.x() <= q->labelRect().right()) return false;
  if (!model.derivedFrom.isEmpty())
    return q->isSignalConnected(QMetaMethod::fromSignal(&ParameterRow::sourceRequested));
  return hasEditor() && (grown(q->sliderRect()).contains(at) || targetOf(curveRect()).contains(at));
}

void ParameterRow::mouseMoveEvent(QMouseEvent* event) {
  if (d->dragging && !d->dragCancelled) {
    d->dragTo(event->position().x(), event->modifiers());
    return;
  }
  const QPoint at = event->position().toPoint();
  const bool types = d->isEditable() && d->isNumeric() && fieldRect().contains(at),
             scales = d->isEditable() && d->showsCurve() && grown(sliderRect()).contains(at);
  const bool keys = d->takesKeys() && d->targetOf(keyRect()).contains(at);
  setCursor(keys             ? Qt::PointingHandCursor
            : types          ? Qt::IBeamCursor
            : d->leadsTo(at) ? Qt::PointingHandCursor
            : scales         ? Qt::SizeHorCursor
                             : Qt::ArrowCursor);
}

void ParameterRow::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !d->dragging) return;
  d->dragging = false;
  const bool clicked = d->showsCurve() && !d->dragCancelled && !d->scaled;
  d->dragCancelled = false;
  if (clicked) Q_EMIT curveRequested(key());
  // A double-click that resets begins with a click: both are one gesture, so the end waits for it a little.
  if (d->open) d->settle.start();
  update();
}

void ParameterRow::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !d->isEditable()) return;
  const QPoint at = event->position().toPoint();
  if (labelRect().contains(at) || (d->isNumeric() && grown(sliderRect()).contains(at))) {
    d->dragging = false;
    reset();
  } else if (!d->isNumeric()) {
    d->pressed(at, event->modifiers());
  }
}

void ParameterRow::wheelEvent(QWheelEvent* event) {
  if (!hasFocus() || !d->isEditable() || !d->isNumeric() || d->showsCurve()) {
    event->ignore();
    return;
  }
  event->accept();
  // Alt turns the wheel sideways on some systems.
  const QPoint delta = event->angleDelta();
  d->wheelRest += (delta.y() != 0 ? delta.y() : delta.x()) / 120.0;
  const double steps = std::trunc(d->wheelRest);
  if (steps == 0) return;
  d->wheelRest -= steps;
  d->stepBy(steps, event->modifiers() & Qt::ShiftModifier);
}

bool ParameterRow::Private::wantsKey(int key, const QString& text) const {
  switch (key) {
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_PageUp:
    case Qt::Key_PageDown:
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_F2:
      return true;
    case Qt::Key_Escape:
      return open;
    case Qt::Key_Space:
      return keyboardFocus && !isNumeric();
    default:
      break;
  }
  static const QString starts = QStringLiteral("0123456789-.,*/(\u2212");
  return keyboardFocus && isNumeric() && text.size() == 1 && starts.contains(text[0]);
}

void ParameterRow::keyPressEvent(QKeyEvent* event) {
  if (!d->isEditable() || !d->wantsKey(event->key(), event->text()) || event->modifiers() & Qt::ControlModifier) {
    QWidget::keyPressEvent(event);
    return;
  }
  const bool fine = event->modifiers() & Qt::ShiftModifier;
  switch (event->key()) {
    case Qt::Key_Up:
      d->stepBy(1, fine);
      break;
    case Qt::Key_Down:
      d->stepBy(-1, fine);
      break;
    case Qt::Key_PageUp:
      d->stepBy(10, fine);
      break;
    case Qt::Key_PageDown:
      d->stepBy(-10, fine);
      break;
    case Qt::Key_Escape:
      d->dragCancelled = d->dragging;
      d->takeBack();
      break;
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_F2:
    case Qt::Key_Space:
      if (d->declaration().kind == api::ParameterKind::Toggle)
        d->toggle();
      else if (d->declaration().kind == api::ParameterKind::Choice)
        d->openChoiceMenu();
      else if (d->hasEditor())
        Q_EMIT curveRequested(key());
      else
        startTyping();
      break;
    default:
      d->startTyping(event->text());
  }
}

void ParameterRow::startTyping() { d->startTyping({}); }

void ParameterRow::Private::startTyping(const QString& text) {
  if (!isEditable() || !isNumeric() || edit) return;
  finish();
  edit = new QLineEdit(q);
  edit->setObjectName(QStringLiteral("psRowEdit"));
  edit->setFont(Theme::font(TextRole::Medium));
  edit->setAccessibleName(QString::fromUtf8(declaration().label));
  edit->setGeometry(q->fieldRect());
  // All digits of the value, not only those of the field: what is not touched must not be rounded.
  const double number = q->number();
  QString shown = standsForNone(declaration(), number) ? formatField(declaration(), number)
                                                       : formatShort(toDisplay(declaration(), number), 7);
  editUnit.clear();
  const FieldText prefixed = shortField(declaration(), number, 7);
  if (needsPrefix() && prefixed.unit != displayUnit(declaration())) {
    editUnit = prefixed.unit;
    shown = prefixed.value + QLatin1Char(' ') + prefixed.unit;
  }
  edit->setText(text.isEmpty() && !model.mixed ? shown : text);
  edit->setModified(!text.isEmpty());
  edit->installEventFilter(q);
  QObject::connect(edit, &QLineEdit::textChanged, q, [this] { q->setError({}); });  // it was about the text before
  edit->show();
  edit->setFocus(Qt::OtherFocusReason);
  if (text.isEmpty()) edit->selectAll();
  q->update();
}

void ParameterRow::Private::closeEdit() {
  if (!edit) return;
  QLineEdit* closing = edit;
  edit = nullptr;
  editUnit.clear();
  closing->removeEventFilter(q);
  closing->hide();
  closing->deleteLater();
  q->update();
}

bool ParameterRow::Private::editKey(int key) {
  const bool modified = edit->isModified();
  switch (key) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_Tab:
    case Qt::Key_Backtab:
      if (modified && !q->enter(edit->text())) return true;  // stays open; the row says why
      closeEdit();
      q->setFocus(Qt::OtherFocusReason);
      keyboardFocus = true;
      if (key == Qt::Key_Tab) q->focusNextChild();
      if (key == Qt::Key_Backtab) q->focusPreviousChild();
      return true;
    case Qt::Key_Escape:
      q->setError({});
      closeEdit();
      q->setFocus(Qt::OtherFocusReason);
      keyboardFocus = true;
      return true;
    default:
      return false;
  }
}

bool ParameterRow::eventFilter(QObject* watched, QEvent* event) {
  if (watched != d->edit) return QWidget::eventFilter(watched, event);
  if (event->type() == QEvent::MouseButtonDblClick) {
    d->edit->selectAll();  // a number is one word, also where it has a point
    return true;
  }
  if (event->type() == QEvent::KeyPress) return d->editKey(static_cast<QKeyEvent*>(event)->key());
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
    event->accept();
    return true;
  }
  if (event->type() == QEvent::FocusOut && static_cast<QFocusEvent*>(event)->reason() != Qt::PopupFocusReason) {
    if (d->edit->isModified()) enter(d->edit->text());
    setError({});  // what could not be read is dropped with the edit
    d->closeEdit();
  }
  return false;
}

bool ParameterRow::event(QEvent* event) {
  switch (event->type()) {
    case QEvent::HoverEnter:
    case QEvent::HoverLeave:
      d->hover = event->type() == QEvent::HoverEnter;
      update();
      break;
    case QEvent::FocusIn: {
      const auto reason = static_cast<QFocusEvent*>(event)->reason();
      // The window's return, or a menu's end, says nothing new about how the focus came here.
      if (reason == Qt::TabFocusReason || reason == Qt::BacktabFocusReason)
        d->keyboardFocus = true;
      else if (reason == Qt::MouseFocusReason)
        d->keyboardFocus = false;
      update();
      break;
    }
    case QEvent::Hide:  // no release comes to what is hidden: the document's gesture would stay open
      d->finish();
      break;
    case QEvent::FocusOut:
      if (!d->dragging) d->finish();
      update();
      break;
    case QEvent::ShortcutOverride: {
      auto* key = static_cast<QKeyEvent*>(event);
      if (d->isEditable() && !(key->modifiers() & Qt::ControlModifier) && d->wantsKey(key->key(), key->text())) {
        event->accept();
        return true;
      }
      break;
    }
    case QEvent::ToolTip:
      showRichTip(static_cast<QHelpEvent*>(event)->globalPos(), d->toolTipText(), this);
      return true;
    default:
      break;
  }
  return QWidget::event(event);
}

void ParameterRow::changeEvent(QEvent* event) {
  if (event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange) {
    if (d->limit || d->error) d->styleNotes();
    update();
  }
  QWidget::changeEvent(event);
}

}  // namespace ps
