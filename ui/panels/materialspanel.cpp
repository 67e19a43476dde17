// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/materialspanel.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/keptrows.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/swatches.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"

#include <QtCore/QMimeData>
#include <QtGui/QDrag>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QAccessibleWidget>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>

namespace ps {
namespace {

constexpr int kLeastTile = 64, kTileHeight = 68, kMargin = 8, kSwatch = 34, kBall = 28, kLine = 14, kHint = 20,
              kHeading = 22;

int columnsIn(int width) { return std::max(1, (width - kMargin) / kLeastTile); }

/// One line where it fits, else two, as even as its words allow.
QStringList linesOf(const QString& label, double width) {
  const QFont font = Theme::font(TextRole::Small);
  if (textWidth(label, font) <= width) return {label};
  QStringList best{label};
  double least = textWidth(label, font);
  for (qsizetype at = label.indexOf(QLatin1Char(' ')); at > 0; at = label.indexOf(QLatin1Char(' '), at + 1)) {
    const QStringList lines{label.left(at), label.mid(at + 1)};
    const double widest = std::max(textWidth(lines[0], font), textWidth(lines[1], font));
    if (widest < least) least = widest, best = lines;
  }
  return best;
}

class MaterialsAccessible final : public QAccessibleWidget {
 public:
  explicit MaterialsAccessible(MaterialsPanel* panel) : QAccessibleWidget(panel, QAccessible::List) {}
  QString text(QAccessible::Text kind) const override {
    if (kind == QAccessible::Value) return static_cast<const MaterialsPanel*>(widget())->currentLabel();
    return QAccessibleWidget::text(kind);
  }
};

QAccessibleInterface* makeAccessible(const QString& /*className*/, QObject* object) {
  auto* panel = qobject_cast<MaterialsPanel*>(object);
  return panel ? new MaterialsAccessible(panel) : nullptr;
}

void installAccessibility() {
  static const bool installed = (QAccessible::installFactory(makeAccessible), true);
  (void)installed;
}

}  // namespace

MaterialsPanel::MaterialsPanel(Session& session, Selection& selection, QWidget* parent)
    : QWidget(parent), m_document(session.document()), m_swatches(session.swatches()), m_selection(selection) {
  installAccessibility();
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(QStringLiteral("Materials"));
  QSizePolicy policy = sizePolicy();
  policy.setHeightForWidth(true);  // the area that scrolls it asks
  setSizePolicy(policy);
  connect(&selection, &Selection::materialChanged, this, &MaterialsPanel::showCurrent);
  connect(&m_swatches, &Swatches::arrived, this, qOverload<>(&QWidget::update));
  connect(&m_document, &Document::changed, this, [this](const ChangeEvent& event) {
    const auto* parameter = std::get_if<ParameterChanged>(&event);
    if (std::holds_alternative<MaterialsChanged>(event)) {
      const std::vector<std::string> before = ownIds();
      rebuild();
      revealJoined(before);
    } else if (std::holds_alternative<ProjectOpened>(event)) {
      rebuild();
    } else if (parameter && parameter->address.owner == Owner::Material) {
      showLook(parameter->address.id);
    }
  });
  rebuild();  // a scene may be open already
}

/// A slider that is dragged looks into one material alone.
void MaterialsPanel::showLook(const std::string& material) {
  for (size_t i = 0; i < m_own; ++i) {
    if (m_tiles[i].id != material) continue;
    m_tiles[i].swatch = swatchOf(m_document.project(), m_document.plugins(), material);
    update(tileRect(i));
  }
}

std::vector<std::string> MaterialsPanel::ownIds() const {
  std::vector<std::string> ids;
  for (size_t i = 0; i < m_own; ++i) ids.push_back(m_tiles[i].id);
  return ids;
}

/// One that was dropped on a body, say, somewhere else in the window.
void MaterialsPanel::revealJoined(const std::vector<std::string>& before) {
  for (const std::string& id : ownIds()) {
    if (std::find(before.begin(), before.end(), id) == before.end()) revealSoon(id);
  }
}

/// When what scrolls the panel knows its present height.
void MaterialsPanel::revealSoon(const std::string& id) {
  QMetaObject::invokeMethod(
      this,
      [this, id] {
        if (const QRect tile = tileOf(id); !tile.isEmpty()) Q_EMIT revealed(tile);
      },
      Qt::QueuedConnection);
}

void MaterialsPanel::rebuild() {
  m_tiles.clear();
  m_hover = m_cursor = -1;
  const Project& project = m_document.project();
  const PluginRegistry* plugins = m_document.plugins();
  std::set<std::string> bases;
  for (const SceneMaterial& material : project.materials) {
    if (!material.mixture) bases.insert(material.base);
    m_tiles.push_back({material.id, QString::fromStdString(shownName(material)),
                       swatchOf(project, plugins, material.id), plugins && !plugins->material(material.base), false});
  }
  m_own = m_tiles.size();
  for (const std::string& base : plugins ? plugins->ids(PluginKind::Material) : std::vector<std::string>{}) {
    const Material* material = plugins ? plugins->material(base) : nullptr;
    if (!material || bases.count(base)) continue;
    const std::string& label = material->label;
    m_tiles.push_back({base, QString::fromStdString(label.empty() ? base : label), swatchOf(*material), false, true});
  }
  updateGeometry();
  update();
}

void MaterialsPanel::showCurrent() {
  update();
  revealSoon(m_selection.material());
  if (!QAccessible::isActive()) return;
  QAccessibleValueChangeEvent event(this, currentLabel());
  QAccessible::updateAccessibility(&event);
}

QString MaterialsPanel::currentLabel() const {
  const auto own = m_tiles.begin() + static_cast<std::ptrdiff_t>(m_own);
  const auto found =
      std::find_if(m_tiles.begin(), own, [&](const Tile& tile) { return tile.id == m_selection.material(); });
  return found == own ? QString() : found->label;
}

int MaterialsPanel::columns() const { return columnsIn(width()); }

QRect MaterialsPanel::headingRect(int width) const {
  const size_t rows = (m_own + static_cast<size_t>(columnsIn(width)) - 1) / static_cast<size_t>(columnsIn(width));
  const int top = kMargin + static_cast<int>(rows) * kTileHeight + (m_own > 0 ? kHint : 0);
  return {kMargin + 4, top, width - 2 * kMargin, kHeading};
}

QRect MaterialsPanel::tileRect(size_t index, int width) const {
  const bool own = index < m_own;
  const auto place = static_cast<int>(own ? index : index - m_own);
  const int column = place % columnsIn(width), row = place / columnsIn(width);
  const int top = own ? kMargin : headingRect(width).bottom() + 1;
  const int tileWidth = (width - kMargin) / columnsIn(width);
  return {kMargin + column * tileWidth, top + row * kTileHeight, tileWidth - 4, kTileHeight - 4};
}

QRect MaterialsPanel::tileOf(const std::string& id) const {
  const auto found = std::find_if(m_tiles.begin(), m_tiles.end(), [&](const Tile& tile) { return tile.id == id; });
  return found == m_tiles.end() ? QRect() : tileRect(static_cast<size_t>(found - m_tiles.begin()));
}

int MaterialsPanel::heightForWidth(int width) const {
  return (m_tiles.size() > m_own ? tileRect(m_tiles.size() - 1, width) : headingRect(width)).bottom() + kMargin;
}

int MaterialsPanel::tileAt(const QPoint& at) const {
  for (size_t i = 0; i < m_tiles.size(); ++i) {
    if (tileRect(i).contains(at)) return static_cast<int>(i);
  }
  return -1;
}

void MaterialsPanel::paintTile(QPainter& painter, size_t index) const {
  const Theme& theme = Theme::current();
  const Tile& tile = m_tiles[index];
  const QRectF rect = tileRect(index);
  const bool chosen = !tile.installed && isChosen(tile.id), current = chosen && tile.id == m_selection.material(),
             here = m_cursor == static_cast<int>(index);
  if (chosen || here || m_hover == static_cast<int>(index)) {
    paintBox(painter, rect, theme[chosen ? Token::Selection : Token::Header],
             current || here ? theme[Token::Accent] : QColor(), 5);
  }
  const QRectF square(rect.center().x() - kSwatch / 2.0, rect.top() + 2, kSwatch, kSwatch);
  constexpr double kEdge = (kSwatch - kBall) / 2.0;  // that a swatch leaves free
  const QRectF ball = square.adjusted(kEdge, kEdge, -kEdge, -kEdge);
  if (tile.missing) {
    paintPlaceholder(painter, ball);
  } else {
    paintSwatch(painter, square, tile.swatch, m_swatches);
  }
  const Token colour = chosen ? Token::Text : tile.installed ? Token::Muted : Token::Text2;
  const QStringList lines = linesOf(tile.label, rect.width() - 2);
  QRectF line(rect.left() + 1, ball.bottom() + (lines.size() > 1 ? 2 : kLine / 2), rect.width() - 2, kLine);
  for (const QString& text : lines) {
    paintText(painter, line, Qt::AlignCenter, text, Theme::font(TextRole::Small), theme[colour]);
    line.translate(0, kLine);
  }
}

void MaterialsPanel::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  for (size_t i = 0; i < m_tiles.size(); ++i) {
    if (tileRect(i).intersects(event->rect())) paintTile(painter, i);  // who is out of sight asks for no picture
  }
  const QRectF heading = headingRect(width());
  const auto line = [&](const QRectF& place, const QString& text) {
    paintText(painter, place, Qt::AlignLeft | Qt::AlignVCenter, text, Theme::font(TextRole::Small),
              theme[Token::Muted]);
  };
  if (m_own > 0) line(heading.translated(0, -kHint), QStringLiteral("B draws it; drag it onto a body"));
  if (m_own < m_tiles.size()) line(heading, QStringLiteral("Add"));
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
}

/// Shift with an arrow chooses one more here; elsewhere it goes to the next marker.
bool MaterialsPanel::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool arrow = key->key() >= Qt::Key_Left && key->key() <= Qt::Key_Down;
    if (m_walks && arrow && (key->modifiers() & ~Qt::KeypadModifier) == Qt::ShiftModifier) {
      event->accept();
      return true;
    }
  }
  return QWidget::event(event);
}

void MaterialsPanel::addInstalled(const std::string& base) { m_selection.pickMaterial(m_document.addMaterial(base)); }

bool MaterialsPanel::isChosen(const std::string& id) const {
  const std::vector<std::string>& chosen = m_selection.materials();
  return std::find(chosen.begin(), chosen.end(), id) != chosen.end();
}

/// With Shift or Ctrl one more, or one less.
void MaterialsPanel::pick(size_t index, Qt::KeyboardModifiers keys) {
  const Tile tile = m_tiles[index];  // adding makes others
  if (tile.installed) {
    addInstalled(tile.id);
    return;
  }
  m_cursor = -1;
  if (keys & (Qt::ShiftModifier | Qt::ControlModifier))
    m_selection.toggleMaterial(tile.id);
  else
    m_selection.pickMaterial(tile.id);
}

void MaterialsPanel::mousePressEvent(QMouseEvent* event) {
  m_pressed = event->position().toPoint();
  m_held = event->button() == Qt::LeftButton ? tileAt(m_pressed) : -1;
}

void MaterialsPanel::mouseReleaseEvent(QMouseEvent* event) {
  const int held = std::exchange(m_held, -1);
  if (held >= 0 && held == tileAt(event->position().toPoint())) pick(static_cast<size_t>(held), event->modifiers());
}

void MaterialsPanel::drag(const Tile& tile) {
  auto* carried = new QMimeData;
  carried->setData(QLatin1String(tile.installed ? kInstalledMime : kMaterialMime), QByteArray::fromStdString(tile.id));
  auto* way = new QDrag(this);  // goes by itself
  way->setMimeData(carried);
  way->exec(Qt::CopyAction);
}

void MaterialsPanel::mouseMoveEvent(QMouseEvent* event) {
  const int at = tileAt(event->position().toPoint());
  const bool far = (event->position().toPoint() - m_pressed).manhattanLength() >= QApplication::startDragDistance();
  if (m_held >= 0 && far) {
    const Tile held = m_tiles[static_cast<size_t>(std::exchange(m_held, -1))];
    return drag(held);
  }
  if (at == m_hover) return;
  m_hover = at;
  QString tip;
  if (at >= 0) {
    const Tile& tile = m_tiles[static_cast<size_t>(at)];
    tip = tile.installed ? QStringLiteral("Add %1 to the scene").arg(tile.label)
          : at < kMaterialKeys
              ? QStringLiteral("%1 (%2 in Sketch)").arg(tile.label, QString::number((at + 1) % kMaterialKeys))
              : tile.label;
  }
  setToolTip(tip);
  update();
}

void MaterialsPanel::leaveEvent(QEvent*) {
  m_hover = -1;
  update();
}

void MaterialsPanel::focusInEvent(QFocusEvent* event) {
  const bool back = event->reason() == Qt::ActiveWindowFocusReason || event->reason() == Qt::PopupFocusReason;
  if (!back) m_walks = event->reason() != Qt::MouseFocusReason;
  QWidget::focusInEvent(event);
}

void MaterialsPanel::focusOutEvent(QFocusEvent* event) {
  m_cursor = -1;
  QWidget::focusOutEvent(event);
}

/// Arrows pick among the scene's materials, with Shift one more each, and only walk among what can be added: Enter adds
/// it.
void MaterialsPanel::keyPressEvent(QKeyEvent* event) {
  if (!m_walks) return QWidget::keyPressEvent(event);
  const bool enters = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter || event->key() == Qt::Key_Space;
  if (enters && m_cursor >= 0) {
    pick(static_cast<size_t>(m_cursor));
    return;
  }
  const int step = event->key() == Qt::Key_Right  ? 1
                   : event->key() == Qt::Key_Left ? -1
                   : event->key() == Qt::Key_Down ? columns()
                   : event->key() == Qt::Key_Up   ? -columns()
                                                  : 0;
  const auto own = static_cast<int>(m_own), count = static_cast<int>(m_tiles.size());
  int index = m_cursor;
  for (int i = 0; i < own && m_cursor < 0; ++i) {
    if (m_tiles[static_cast<size_t>(i)].id == m_selection.material()) index = i;
  }
  int next = index + step;
  // A row of its own begins with what can be added.
  if (std::abs(step) > 1 && index >= 0 && index < own && next >= own) next = own;
  if (std::abs(step) > 1 && index >= own && next < own) next = own - 1;
  if (step == 0 || next < 0 || next >= count) {
    QWidget::keyPressEvent(event);
    return;
  }
  if (next < own) {
    pick(static_cast<size_t>(next), event->modifiers() & Qt::ShiftModifier);
  } else {
    m_cursor = next;
    update();
  }
  Q_EMIT revealed(tileRect(static_cast<size_t>(next)));
}

void MaterialsPanel::contextMenuEvent(QContextMenuEvent* event) {
  const bool keyboard = event->reason() == QContextMenuEvent::Keyboard;
  const QRect place = keyboard ? tileOf(m_selection.material()) : QRect();
  const int at = keyboard ? tileAt(place.center()) : tileAt(event->pos());
  if (at < 0) return;
  const Tile& tile = m_tiles[static_cast<size_t>(at)];
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  if (tile.installed) {
    menu->addAction(QStringLiteral("Add to the scene"), this, [this, base = tile.id] { addInstalled(base); });
  } else {
    const QString why = m_document.whyMaterialStays(tile.id);
    QAction* remove =
        menu->addAction(why.isEmpty() ? QStringLiteral("Remove from the scene")
                                      : QStringLiteral("Remove from the scene: %1").arg(asButtonText(why)),
                        this, [this, id = tile.id] { m_document.removeMaterial(id); });
    remove->setEnabled(why.isEmpty());
  }
  menu->popup(keyboard ? mapToGlobal(place.center()) : event->globalPos());
}

}  // namespace ps
