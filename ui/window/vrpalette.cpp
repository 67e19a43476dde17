// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrpalette.h"

#include "core/plugin_host/registry.h"
#include "core/simulation/particlefield.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/swatches.h"
#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"
#include "ui/tools/becoming.h"
#include "ui/tools/toolbox.h"
#include "ui/window/actions.h"

#include <QtGui/QAction>
#include <QtGui/QPainter>
#include <QtGui/QPixmap>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kColumns = 6, kButton = 30, kEdge = 10, kGap = 5, kIcon = 20;
constexpr double kSharp = 2.5;   // pixels of a picture for each logical one, as panels are painted
constexpr double kDegrees = 10;  // K, that a button adds to a temperature

QToolButton* button(const QString& name, const QString& iconName) {
  auto* one = new QToolButton;
  one->setIcon(icon(iconName));
  one->setIconSize({kIcon, kIcon});
  one->setToolTip(name);
  one->setAccessibleName(name);
  one->setMinimumHeight(kButton);
  one->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  return one;
}

}  // namespace

VrPalette::VrPalette(Session& session, Toolbox& tools, const Actions& actions, const std::vector<const char*>& pages)
    : m_session(session), m_tools(tools), m_actions(actions) {
  setObjectName(QStringLiteral("psVrPalette"));
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(kEdge, kEdge, kEdge, kEdge);
  grid->setSpacing(kGap);
  for (int column = 0; column < kColumns; ++column) grid->setColumnStretch(column, 1);
  addActions(*grid, {{"simulation.play", "play"},
                     {"simulation.step", "step"},
                     {"simulation.reset", "reset-to-start"},
                     {"edit.undo", "undo"},
                     {"edit.redo", "redo"},
                     {"sketch.real", "check"}});
  m_material = addChoice(
      *grid, QStringLiteral("Material"), [this] { return material(); }, [this](int by) { m_tools.stepMaterial(by); },
      "Materials");
  m_material->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  m_material->setIconSize({kIcon, kIcon});
  connect(&session.swatches(), &Swatches::arrived, this, [this] { m_swatched.reset(); });
  addChoice(
      *grid, QStringLiteral("Brush"), [this] { return pluginLabel(m_session.plugins(), m_tools.brush().shape); },
      [this](int by) { m_tools.stepShape(by); }, "Brush");
  addChoice(
      *grid, QStringLiteral("Size"), [this] { return m_tools.brushSizeText(); },
      [this](int by) { m_tools.stepBrush(by); });
  addChoice(
      *grid, QStringLiteral("Temperature"), [this] { return temperatureText(m_tools.brush().temperature, 0); },
      [this](int by) { stepTemperature(by); });
  addChoice(
      *grid, QStringLiteral("Becomes"), [this] { return becomes(); }, [this](int by) { stepBecomes(by); });
  addChoice(
      *grid, QStringLiteral("Colour"), [this] { return colour(); }, [this](int by) { stepColour(by); });
  addTurns(*addActions(*grid, {{"simulation.gravity", "gravity"},
                               {"sketch.hold", "pin"},
                               {"sketch.brush", "brush"},
                               {"sketch.erase", "erase"},
                               {"sketch.mirror", "plane"},
                               {"view.section", "cut"}}));
  addPages(*grid, pages);
  follow();
}

/// Names of actions, and their icons, each in as much of the row as the others.
QHBoxLayout* VrPalette::addActions(QGridLayout& grid, const std::vector<std::pair<const char*, const char*>>& row) {
  auto* line = new QHBoxLayout;
  line->setSpacing(kGap);
  for (const auto& [name, iconName] : row) {
    QAction* action = m_actions.find(QString::fromLatin1(name));
    QToolButton* one = button(cleanText(*action), QString::fromLatin1(iconName));
    connect(one, &QToolButton::clicked, action, &QAction::trigger);
    const auto showState = [one, action] {
      one->setEnabled(action->isEnabled());
      one->setCheckable(action->isCheckable());
      one->setChecked(action->isChecked());
    };
    connect(action, &QAction::changed, one, showState);
    // What is checked is what holds, not what was clicked.
    connect(one, &QToolButton::clicked, one, showState);
    showState();
    line->addWidget(one, 1);
  }
  grid.addLayout(line, grid.rowCount(), 0, 1, kColumns);
  return line;
}

/// For whoever has no stick to turn with.
void VrPalette::addTurns(QHBoxLayout& row) {
  for (const int steps : {-1, 1}) {
    QToolButton* one = button(steps < 0 ? QStringLiteral("Turn left by 30°") : QStringLiteral("Turn right by 30°"),
                              steps < 0 ? QStringLiteral("turn-left") : QStringLiteral("turn-right"));
    connect(one, &QToolButton::clicked, this, [this, steps] { Q_EMIT turnWanted(steps); });
    row.addWidget(one, 1);
  }
}

QToolButton* VrPalette::addChoice(QGridLayout& grid, const QString& name, std::function<QString()> text,
                                  const std::function<void(int)>& step, const char* page) {
  const int line = grid.rowCount();
  auto* title = new QLabel(name);
  title->setTextFormat(Qt::PlainText);
  auto* value = new QToolButton;
  value->setAccessibleName(name);
  value->setMinimumHeight(kButton);
  value->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  if (page) {
    const QString wanted = QString::fromLatin1(page);
    value->setToolTip(QStringLiteral("Brings the page %1").arg(wanted));
    connect(value, &QToolButton::clicked, this, [this, wanted] { Q_EMIT pageWanted(wanted); });
  } else {
    value->setAttribute(Qt::WA_TransparentForMouseEvents);
  }
  grid.addWidget(title, line, 0, 1, 2);
  int column = 2;
  for (const int by : {-1, 1}) {
    QToolButton* one =
        button(QStringLiteral("%1: %2").arg(name, by < 0 ? QStringLiteral("back") : QStringLiteral("on")),
               by < 0 ? QStringLiteral("chevron-left") : QStringLiteral("chevron-right"));
    connect(one, &QToolButton::clicked, this, [this, step, by] {
      step(by);
      follow();
    });
    grid.addWidget(one, line, column);
    column = kColumns - 1;
  }
  grid.addWidget(value, line, 3, 1, 2);
  m_choices.push_back({value, std::move(text)});
  return value;
}

/// In two rows, each of which is as wide as the others; behind them what has labels shown.
void VrPalette::addPages(QGridLayout& grid, const std::vector<const char*>& pages) {
  std::vector<QToolButton*> all;
  const auto make = [&](const QString& title) {
    auto* one = all.emplace_back(new QToolButton);
    one->setText(title);
    one->setAccessibleName(title);
    one->setMinimumHeight(kButton);
    one->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    return one;
  };
  for (const char* page : pages) {
    const QString title = QString::fromLatin1(page);
    connect(make(title), &QToolButton::clicked, this, [this, title] { Q_EMIT pageWanted(title); });
  }
  m_labelled = make(QStringLiteral("Labels"));
  m_labelled->setCheckable(true);
  m_labelled->setChecked(true);
  m_labelled->setToolTip(QStringLiteral("What the buttons of the controllers do, beside them"));
  connect(m_labelled, &QToolButton::clicked, this, &VrPalette::labelsWanted);

  const int count = static_cast<int>(all.size()), upper = (count + 1) / 2, lower = count - upper;
  auto* rows = new QGridLayout;
  rows->setSpacing(kGap);
  for (int column = 0; column < upper * std::max(1, lower); ++column) rows->setColumnStretch(column, 1);
  for (int k = 0; k < count; ++k) {
    const bool above = k < upper;
    const int wide = above ? std::max(1, lower) : upper, place = above ? k : k - upper;
    rows->addWidget(all[static_cast<size_t>(k)], above ? 0 : 1, place * wide, 1, wide);
  }
  grid.addLayout(rows, grid.rowCount(), 0, 1, kColumns);
}

void VrPalette::showLabelled(bool labelled) { m_labelled->setChecked(labelled); }

void VrPalette::follow() {
  showSwatch();
  for (const Choice& choice : m_choices) {
    const int room = choice.value->width() - (choice.value->icon().isNull() ? 0 : kIcon + 2 * kGap);
    const QString text = asButtonText(choice.value->fontMetrics().elidedText(choice.text(), Qt::ElideRight, room));
    if (choice.value->text() != text) choice.value->setText(text);
  }
}

std::string VrPalette::materialId() const {
  const Project& project = m_session.document().project();
  if (project.materials.empty()) return {};
  const std::string& now = m_tools.brush().material;
  return now.empty() ? project.materials.front().id : now;
}

QString VrPalette::material() const {
  const std::string id = materialId();
  if (id.empty()) return QStringLiteral("none");
  return ownerLabel(m_session.document().project(), {Owner::Material, id, ""});
}

/// As long as there is no picture it is a ball in the material's colour.
void VrPalette::showSwatch() {
  const Document& document = m_session.document();
  const std::pair now(materialId(), document.changeCount());
  if (m_swatched == now) return;
  m_swatched = now;
  if (now.first.empty()) return m_material->setIcon({});
  QPixmap picture((QSizeF(kIcon, kIcon) * kSharp).toSize());
  picture.setDevicePixelRatio(kSharp);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  const Swatch swatch = swatchOf(document.project(), document.plugins(), now.first);
  paintSwatch(painter, QRectF(0, 0, kIcon, kIcon), swatch, m_session.swatches());
  painter.end();
  m_material->setIcon(picture);
}

void VrPalette::stepTemperature(int by) {
  BrushSettings brush = m_tools.brush();
  setValueOf(brush, "temperature", std::max(0.0, brush.temperature + kDegrees * by));
  m_tools.setBrush(brush);
}

QString VrPalette::becomes() const {
  for (const auto& [name, label] : becomings())
    if (name == m_tools.brush().becomes) return label;
  return {};
}

void VrPalette::stepBecomes(int by) {
  std::vector<std::string> names;
  for (const auto& [name, label] : becomings()) names.push_back(name);
  BrushSettings brush = m_tools.brush();
  if (const std::string* name = further(names, brush.becomes, by)) brush.becomes = *name;
  m_tools.setBrush(brush);
}

QString VrPalette::colour() const {
  const std::string& now = m_session.document().project().view.colour;
  const FieldPtr field = m_session.fields().find(now);
  return field ? QString::fromStdString(field->label) : QStringLiteral("Matter");
}

void VrPalette::stepColour(int by) {
  std::vector<std::string> names{kMatterColour};
  for (const FieldPtr& field : m_session.fields().all()) names.push_back(field->name);
  if (const std::string* name = further(names, m_session.document().project().view.colour, by))
    m_session.document().setColour(*name);
}

void VrPalette::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  paintBox(painter, rect(), theme[Token::Panel], theme[Token::Line2], 7);
}

}  // namespace ps
