// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/parameterrow.h"

#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowvalue.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QRegularExpression>
#include <QtGui/QAccessible>
#include <QtGui/QPainter>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

QLabel* makeNote(ParameterRow* row, const char* name, Qt::TextFormat format) {
  auto* label = new QLabel(row);
  label->setObjectName(QLatin1String(name));
  label->setWordWrap(true);
  label->setTextFormat(format);
  label->setFont(Theme::font(TextRole::Small));
  label->setTextInteractionFlags(Qt::TextBrowserInteraction);
  QObject::connect(label, &QLabel::linkActivated, row,
                   [row](const QString& link) { Q_EMIT row->linkActivated(row->key(), link); });
  return label;
}

constexpr int kNoteGap = 5;

/// The field is narrow: "W/(m·K)" is shown as "W/m·K"; the tooltip has it in full.
FieldText withoutBrackets(FieldText text) {
  text.unit.remove(QLatin1Char('(')).remove(QLatin1Char(')'));
  return text;
}

}  // namespace

QString noteAsRichText(const QString& markdown) {
  QString html = markdown.toHtmlEscaped();
  static const QRegularExpression escaped(QStringLiteral("\\\\([\\\\\\[])"));
  static const QRegularExpression link(QStringLiteral("(?<!\\\\)\\[(.+?)\\]\\((.+?)\\)"));
  html.replace(link, QStringLiteral("<a href=\"\\2\" style=\"color:%1;text-decoration:none\">\\1</a>")
                         .arg(Theme::current()[Token::Accent].name()));
  html.replace(escaped, QStringLiteral("\\1"));
  html.replace(QLatin1Char('\n'), QLatin1String("<br>"));
  return html;
}

QString asNote(QString text) {
  static const QRegularExpression marks(QStringLiteral("([\\\\\\[])"));
  return text.replace(marks, QStringLiteral("\\\\1"));
}

bool ParameterRow::Private::isNumeric() const {
  const auto kind = declaration().kind;
  return kind != api::ParameterKind::Toggle && kind != api::ParameterKind::Choice;
}

bool ParameterRow::Private::showsCurve() const { return isCurve(model.value); }

/// A symbol that is wider than its column begins before it.
int ParameterRow::Private::symbolRoom() const {
  return std::max(kSymbolWidth, static_cast<int>(std::ceil(symbolWidth(QString::fromUtf8(declaration().symbol)))) + 4);
}

bool ParameterRow::Private::drawsSymbol() const {
  if (!showSymbol || !isNumeric() || !declaration().symbol || !*declaration().symbol) return false;
  const int room = q->sliderRect().left() - symbolRoom() - kRowLeft;
  return q->wantedLabelWidth() <= room;
}

FieldText ParameterRow::Private::fieldText() const {
  const double number = q->number();
  // What follows the temperature runs: all its digits stay, so that it keeps its width.
  if (needsPrefix()) return withoutBrackets(shortField(declaration(), number, 3, showsCurve()));
  if (showsCurve() && !model.mixed && std::isfinite(number))
    return withoutBrackets({formatNumber(toDisplay(declaration(), number)), displayUnit(declaration())});
  return withoutBrackets({model.mixed ? QStringLiteral("—") : formatField(declaration(), number),
                          standsForNone(declaration(), number) ? QString() : displayUnit(declaration())});
}

bool ParameterRow::Private::needsPrefix() const {
  const double number = q->number();
  if (model.mixed || standsForNone(declaration(), number)) return false;
  const FieldText text = withoutBrackets({formatField(declaration(), number), displayUnit(declaration())});
  const double room = q->fieldRect().width() - kFieldLeft - (kUnitLeft - kValueRight) - kFieldRight;
  return textWidth(text.value, Theme::font(TextRole::Medium)) + textWidth(text.unit, Theme::font(TextRole::Normal)) >
         room;
}

ParameterRow::ParameterRow(RowModel model, QWidget* parent) : QWidget(parent), d(std::make_unique<Private>(this)) {
  installRowAccessibility();
  d->model = std::move(model);
  d->wasChanged = isChanged();
  d->settle.setSingleShot(true);
  d->settle.setInterval(kSettleMilliseconds);
  connect(&d->settle, &QTimer::timeout, this, [this] { d->finish(); });
  setAttribute(Qt::WA_Hover);
  setMouseTracking(true);
  setFocusPolicy(d->isEditable() ? Qt::StrongFocus : Qt::NoFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setFixedHeight(kRowHeight);
  setAccessibleName(QString::fromUtf8(d->declaration().label));
  setAccessibleDescription(QString::fromUtf8(d->declaration().help));
}

ParameterRow::~ParameterRow() {
  if (d->edit) d->edit->removeEventFilter(this);
}

const RowModel& ParameterRow::model() const { return d->model; }
const QString& ParameterRow::key() const { return d->model.key; }

void ParameterRow::setValue(const Value& value) {
  if (d->open) return;
  d->model.value = value;
  d->refresh();
}

void ParameterRow::setDefaultValue(const Value& value) {
  d->model.defaultValue = value;
  d->refresh();
}

void ParameterRow::setIsPinned(bool isPinned) { d->model.isPinned = isPinned; }

void ParameterRow::setMixed(bool mixed) {
  d->model.mixed = mixed;
  d->refresh();
}

void ParameterRow::setDisabledReason(const QString& reason) {
  d->model.disabledReason = reason;
  if (!reason.isEmpty()) d->takeBack();
  setFocusPolicy(d->isEditable() ? Qt::StrongFocus : Qt::NoFocus);
  d->refresh();
}

void ParameterRow::setChoiceLabels(const QStringList& labels) {
  d->model.choiceLabels = labels;
  d->refresh();
}

void ParameterRow::setDerivedFrom(const QString& derivedFrom) {
  d->model.derivedFrom = derivedFrom;
  if (!derivedFrom.isEmpty()) d->takeBack();
  setFocusPolicy(d->isEditable() ? Qt::StrongFocus : Qt::NoFocus);
  d->refresh();
}

void ParameterRow::setTemperature(double kelvin) {
  if (d->model.temperature == kelvin) return;
  d->model.temperature = kelvin;
  if (d->showsCurve()) update();
}

void ParameterRow::setLimit(const QString& text, double delivered) {
  const bool hatchingSame = delivered == d->delivered || (std::isnan(delivered) && std::isnan(d->delivered));
  if (text == d->limitText && hatchingSame) return;
  d->limitText = text;
  d->delivered = delivered;
  d->styleNotes();
}

void ParameterRow::setError(const QString& text) {
  if (text == d->errorText) return;
  d->errorText = text;
  d->styleNotes();
}

void ParameterRow::Private::styleNotes() {
  const auto show = [this](QLabel*& label, const char* name, const QString& text, Qt::TextFormat format) {
    if (text.isEmpty()) {
      if (label) {
        label->setParent(nullptr);  // gone from sight at once
        label->deleteLater();       // its link may be what asked for this
      }
      label = nullptr;
      return;
    }
    if (!label) label = makeNote(q, name, format);
    label->setText(text);
    label->show();
  };
  show(limit, "psLimit", noteAsRichText(limitText), Qt::RichText);
  show(error, "psError", errorText, Qt::PlainText);
  layoutNotes();
  refresh();
}

void ParameterRow::Private::layoutNotes() {
  int top = kRowHeight;
  for (QLabel* label : {error, limit}) {
    if (!label) continue;
    const int width = q->width() - kRowLeft - 8;
    const int height = label->heightForWidth(width);
    label->setGeometry(kRowLeft, top, width, height);
    top += height + kNoteGap;
  }
  if (q->height() != top) q->setFixedHeight(top);
}

void ParameterRow::setShowSymbol(bool show) {
  d->showSymbol = show;
  update();
}

void ParameterRow::setLabelWidth(int pixels) {
  d->labelWidth = pixels;
  update();
}

int ParameterRow::wantedLabelWidth() const {
  const double text = textWidth(QString::fromUtf8(d->declaration().label), Theme::font(TextRole::Normal));
  return static_cast<int>(std::ceil(text)) + 3;
}

void ParameterRow::setRightMargin(int pixels) {
  d->rightMargin = pixels;
  if (d->edit) d->edit->setGeometry(fieldRect());
  update();
}

bool ParameterRow::isChanged() const { return !sameValue(d->model.value, d->model.defaultValue); }

double ParameterRow::number() const { return numberOfValue(d->declaration(), d->model.value, d->model.temperature); }

unsigned ParameterRow::states() const {
  unsigned states = 0;
  const auto add = [&states](bool on, RowState state) { states |= on ? static_cast<unsigned>(state) : 0u; };
  const bool editable = d->isEditable();
  add(d->hover && editable, RowState::Hover);
  add(hasFocus() || d->edit, RowState::Focus);
  add(!d->model.disabledReason.isEmpty(), RowState::Disabled);
  add(d->model.mixed, RowState::Mixed);
  // What is a material's own is usual, whatever the slider offers for others.
  add(!d->model.mixed && d->isNumeric() && isChanged() && isOutOfRange(d->declaration(), number()),
      RowState::OutOfRange);
  add(isChanged() || d->model.mixed, RowState::Changed);
  add(d->showsCurve(), RowState::Curve);
  add(!d->model.derivedFrom.isEmpty(), RowState::Derived);
  add(!d->limitText.isEmpty(), RowState::Limited);
  add(!d->errorText.isEmpty(), RowState::Error);
  add(d->edit, RowState::Editing);
  add(d->dragging, RowState::Dragging);
  add(d->model.keyMark == KeyMark::OnKey, RowState::OnKey);
  add(d->model.keyMark == KeyMark::Between, RowState::BetweenKeys);
  return states;
}

QString ParameterRow::valueText() const {
  if (d->model.mixed) return QStringLiteral("—");
  switch (d->declaration().kind) {
    case api::ParameterKind::Toggle:
      return number() != 0 ? QStringLiteral("on") : QStringLiteral("off");
    case api::ParameterKind::Choice: {
      const std::string* name = std::get_if<std::string>(&d->model.value);
      if (!name) return {};
      const auto index = choiceNames(d->declaration()).indexOf(QString::fromStdString(*name));
      return index < 0 ? choiceLabel(QString::fromStdString(*name)) : d->choiceTexts()[index];
    }
    default:
      return formatValue(d->declaration(), number());
  }
}

void ParameterRow::Private::begin() {
  settle.stop();
  if (open) return;
  open = true;
  before = model.value;
  mixedBefore = model.mixed;
  Q_EMIT q->editingStarted(model.key, before);
}

void ParameterRow::Private::change(const Value& value) {
  if (sameValue(value, model.value) && !model.mixed) return;
  model.value = value;
  model.mixed = false;
  refresh();
  Q_EMIT q->valueEdited(model.key, value);
}

void ParameterRow::Private::finish() {
  settle.stop();
  if (!open) return;
  open = false;
  dragging = false;
  refresh();
  Q_EMIT q->editingFinished(model.key, model.value);
}

void ParameterRow::Private::takeBack() {
  closeEdit();
  if (!open) return;
  if (mixedBefore) {  // no one value is what all had
    model.value = before;
    model.mixed = true;
    Q_EMIT q->takenBack(model.key);
  } else {
    change(before);
  }
  finish();
}

void ParameterRow::Private::single(const Value& value) {
  begin();
  change(value);
  finish();
}

void ParameterRow::Private::refresh() {
  q->update();
  const bool changed = q->isChanged();
  if (changed != wasChanged) {
    wasChanged = changed;
    Q_EMIT q->changedChanged();
  }
  if (QAccessible::isActive()) {
    QAccessibleValueChangeEvent event(q, q->number());
    QAccessible::updateAccessibility(&event);
  }
}

void ParameterRow::reset() {
  if (!d->isEditable()) return;
  d->closeEdit();
  setError({});
  if (d->model.together) {
    d->takeBack();  // a double-click's first one
    Q_EMIT resetAsked(key());
  } else {
    d->single(d->model.defaultValue);
  }
}

void ParameterRow::finishEditing() {
  d->closeEdit();
  d->finish();
}

bool ParameterRow::enter(const QString& text) {
  if (!d->isEditable() || !d->isNumeric()) return false;
  // A bare number is in the unit that the field showed when the typing began.
  const bool bare = !d->editUnit.isEmpty() && parseNumber(text);
  const Typed typed = parseTyped(bare ? text + QLatin1Char(' ') + d->editUnit : text, d->declaration(), number());
  if (!typed.problem.isEmpty()) {
    setError(typed.problem);
    return false;
  }
  if (typed.relative && d->model.mixed) {
    setError({});
    Q_EMIT scaled(d->model.key, typed.factor, typed.added);
    return true;
  }
  if (typed.relative && d->showsCurve()) return d->scaleCurve(typed.factor, typed.added);
  return enterNumber(typed.value);
}

bool ParameterRow::enterNumber(double value) {
  if (!d->isEditable()) return false;
  if (const QString problem = refusal(d->declaration(), value); !problem.isEmpty()) {
    setError(QStringLiteral("%1; %2 stays in force").arg(problem, valueText()));
    return false;
  }
  setError({});
  d->single(valueOfNumber(d->declaration(), value));
  return true;
}

bool ParameterRow::Private::scaleCurve(double factor, double added) {
  Value changed = model.value;
  if (const QString problem = scale(changed, declaration(), factor, added); !problem.isEmpty()) {
    q->setError(problem);
    return false;
  }
  const Response response = std::get<Response>(changed);
  if (const std::string problem = problemOf(Value(response), declaration()); !problem.empty()) {
    q->setError(QString::fromStdString("The curve " + problem));
    return false;
  }
  q->setError({});
  single(response);
  return true;
}

QRect ParameterRow::fieldRect() const {
  return {width() - d->rightMargin - kFieldWidth, (kRowHeight - kFieldHeight) / 2, kFieldWidth, kFieldHeight};
}

QRect ParameterRow::sliderRect() const {
  const int right = fieldRect().left() - kSliderGap;
  const int symbol = d->showSymbol ? kSymbolWidth : 0;
  int left = std::min(kRowLeft + d->labelWidth + symbol, right - kMinimumSlider);
  // Labels give way last, after the row's own symbol and most of its slider.
  left = std::max(left, std::min(kRowLeft + wantedLabelWidth(), right - kLeastSlider));
  return {left, 0, right - left, kRowHeight};
}

QRect ParameterRow::labelRect() const {
  int right = sliderRect().left() - (d->drawsSymbol() ? d->symbolRoom() : 0);
  if (d->declaration().kind == api::ParameterKind::Toggle) right = d->switchRect().left() - kSliderGap;
  if (d->declaration().kind == api::ParameterKind::Choice) right = d->choiceRect().left() - kSliderGap;
  return {kRowLeft, 0, right - kRowLeft, kRowHeight};
}

QSize ParameterRow::sizeHint() const { return {392, heightForWidth(width())}; }
QSize ParameterRow::minimumSizeHint() const { return {240, kRowHeight}; }

int ParameterRow::heightForWidth(int width) const {
  int height = kRowHeight;
  for (QLabel* label : {d->error, d->limit}) {
    if (label) height += label->heightForWidth(width - kRowLeft - 8) + kNoteGap;
  }
  return height;
}

void ParameterRow::resizeEvent(QResizeEvent*) {
  d->layoutNotes();
  if (d->edit) d->edit->setGeometry(fieldRect());
}

void ParameterRow::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  d->paint(painter);
}

}  // namespace ps
