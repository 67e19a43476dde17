// SPDX-License-Identifier: Apache-2.0
// The last column of a row: where its parameter stands among its keys over time.
#include "core/scene/track.h"
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowcommands.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QMetaMethod>
#include <QtGui/QAction>
#include <QtGui/QActionGroup>
#include <QtGui/QPainter>
#include <QtWidgets/QMenu>

namespace ps {
namespace {

constexpr int kKeyColumn = 14, kKeyRight = 2;
constexpr double kDiamond = 4.5;  ///< half its width

}  // namespace

void ParameterRow::setKeyMark(KeyMark mark, ToNext way) {
  if (mark == d->model.keyMark && way == d->model.way) return;
  d->model.keyMark = mark;
  d->model.way = way;
  update();
}

bool ParameterRow::isHovered() const { return d->hover; }

void ParameterRow::toggleKey() {
  if (!d->offersKeys()) return;
  finishEditing();
  Q_EMIT keyToggled(key(), d->model.value);
}

bool ParameterRow::Private::offersKeys() const {
  return q->isSignalConnected(QMetaMethod::fromSignal(&ParameterRow::keyToggled));
}

/// By its declaration and value alone; whoever listens may know more.
bool ParameterRow::Private::takesKeys() const {
  return offersKeys() && isEditable() && !model.mixed && !showsCurve() &&
         declaration().kind != api::ParameterKind::Choice && declaration().actsAt != api::ActsAt::NextReset &&
         declaration().actsAt != api::ActsAt::WithItsMatter;
}

QRect ParameterRow::keyRect() const {
  return {width() - kKeyRight - kKeyColumn, (kRowHeight - kKeyColumn) / 2, kKeyColumn, kKeyColumn};
}

void ParameterRow::Private::paintKey(QPainter& painter) const {
  const bool keyed = model.keyMark != KeyMark::None;
  if (!keyed && !takesKeys()) return;  // where a click would set the first
  const QPointF centre = QRectF(q->keyRect()).center();
  const Token token = !model.disabledReason.isEmpty() ? Token::Disabled
                      : keyed                         ? Token::Keyframe
                      : hover                         ? Token::Text2
                                                      : Token::ControlEdge;
  paintDiamond(painter, centre, kDiamond, Theme::current()[token], model.keyMark == KeyMark::OnKey);
}

QString ParameterRow::Private::keyText() const {
  if (!takesKeys())
    return showsCurve() && model.keyMark != KeyMark::None ? QStringLiteral("Points of the curve go by keys.")
                                                          : QString();
  switch (model.keyMark) {
    case KeyMark::OnKey:
      return QStringLiteral("This time has a key; K removes it.");
    case KeyMark::Between:
      return QStringLiteral("The value goes by its keys; K sets one at this time.");
    case KeyMark::None:
      break;
  }
  return QStringLiteral("K sets a key at this time.");
}

void ParameterRow::Private::addKeyEntries(QMenu* menu) {
  if (!takesKeys() && model.keyMark == KeyMark::None) return;
  menu->addSeparator();
  if (takesKeys()) {
    QAction* key =
        menu->addAction(model.keyMark == KeyMark::OnKey ? QStringLiteral("Remove key") : QStringLiteral("Set key"));
    QObject::connect(key, &QAction::triggered, q, &ParameterRow::toggleKey);
  }
  if (model.keyMark == KeyMark::None) return;
  const auto add = [this](QMenu& to, RowCommand command) {
    QAction* action = to.addAction(textOf(command));
    QObject::connect(action, &QAction::triggered, q, [this, command] { perform(*q, command, {}); });
    return action;
  };
  QMenu* ways = nullptr;  // to the next key
  QActionGroup* group = nullptr;
  for (const NamedRowCommand& each : rowCommands()) {
    const auto way = wayOf(each.command);
    if (!way || !whyNot(*q, each.command).isEmpty()) continue;
    if (!ways) {
      ways = menu->addMenu(QString::fromUtf8(each.menu));
      group = new QActionGroup(ways);
    }
    QAction* action = add(*ways, each.command);
    action->setCheckable(true);
    action->setChecked(*way == model.way);
    group->addAction(action);
  }
  add(*menu, RowCommand::RemoveKeys);
}

}  // namespace ps
