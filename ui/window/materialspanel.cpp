// SPDX-License-Identifier: Apache-2.0
#include "ui/window/materialspanel.h"

#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtGui/QRadialGradient>
#include <QtWidgets/QAccessibleWidget>

#include <algorithm>

namespace ps {
namespace {

constexpr int kTileWidth = 52, kTileHeight = 58, kMargin = 8, kBall = 28;

void paintBall(QPainter& painter, const QRectF& rect, const QColor& colour) {
  QRadialGradient shade(rect.center() - QPointF(rect.width() * 0.18, rect.height() * 0.2), rect.width() * 0.75);
  shade.setColorAt(0, colour.lighter(135));
  shade.setColorAt(0.55, colour);
  shade.setColorAt(1, colour.darker(190));
  painter.setPen(Qt::NoPen);
  painter.setBrush(shade);
  painter.drawEllipse(rect);
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

MaterialsPanel::MaterialsPanel(Document& document, QWidget* parent) : QWidget(parent), m_document(document) {
  installAccessibility();
  setMouseTracking(true);
  setFocusPolicy(Qt::TabFocus);
  setAccessibleName(QStringLiteral("Materials"));
}

void MaterialsPanel::rebuild() {
  m_tiles.clear();
  const Project& project = m_document.project();
  const PluginRegistry* plugins = m_document.plugins();
  for (const SceneMaterial& material : project.materials) {
    m_tiles.push_back({material.id, QString::fromStdString(material.label.empty() ? material.id : material.label),
                       colourOf(project, plugins, material.id), plugins && !plugins->material(material.base)});
  }
  const bool known =
      std::any_of(m_tiles.begin(), m_tiles.end(), [&](const Tile& tile) { return tile.id == m_current; });
  if (!known) m_current = m_tiles.empty() ? std::string() : m_tiles.front().id;
  update();
}

void MaterialsPanel::setCurrent(const std::string& id) {
  if (id == m_current) return;
  m_current = id;
  update();
  if (!QAccessible::isActive()) return;
  QAccessibleValueChangeEvent event(this, currentLabel());
  QAccessible::updateAccessibility(&event);
}

QString MaterialsPanel::currentLabel() const {
  const auto found =
      std::find_if(m_tiles.begin(), m_tiles.end(), [&](const Tile& tile) { return tile.id == m_current; });
  return found == m_tiles.end() ? QString() : found->label;
}

int MaterialsPanel::columns() const { return std::max(1, (width() - kMargin) / kTileWidth); }

QRect MaterialsPanel::tileRect(size_t index) const {
  const int column = static_cast<int>(index) % columns(), row = static_cast<int>(index) / columns();
  return {kMargin + column * kTileWidth, kMargin + row * kTileHeight, kTileWidth - 4, kTileHeight - 4};
}

int MaterialsPanel::tileAt(const QPoint& at) const {
  for (size_t i = 0; i < m_tiles.size(); ++i) {
    if (tileRect(i).contains(at)) return static_cast<int>(i);
  }
  return -1;
}

void MaterialsPanel::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  for (size_t i = 0; i < m_tiles.size(); ++i) {
    const Tile& tile = m_tiles[i];
    const QRectF rect = tileRect(i);
    const bool current = tile.id == m_current;
    if (current || m_hover == static_cast<int>(i)) {
      paintBox(painter, rect, theme[current ? Token::Selection : Token::Header],
               current ? theme[Token::Accent] : QColor(), 5);
    }
    const QRectF ball(rect.center().x() - kBall / 2.0, rect.top() + 5, kBall, kBall);
    if (tile.missing) {
      painter.setPen(QPen(theme[Token::Muted], 1));
      painter.setBrush(QBrush(theme[Token::Muted], Qt::BDiagPattern));
      painter.drawEllipse(ball);
    } else {
      paintBall(painter, ball, tile.colour);
    }
    paintText(painter, QRectF(rect.left() + 1, rect.bottom() - 19, rect.width() - 2, 16), Qt::AlignCenter, tile.label,
              Theme::font(TextRole::Small), theme[current ? Token::Text : Token::Text2]);
  }
  const double y = m_tiles.empty() ? kMargin : tileRect(m_tiles.size() - 1).bottom() + 10.0;
  paintText(painter, QRectF(kMargin + 4, y, width() - 2 * kMargin, 18), Qt::AlignLeft | Qt::AlignVCenter,
            QStringLiteral("Press B to draw with it"), Theme::font(TextRole::Small), theme[Token::Muted]);
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
}

void MaterialsPanel::pick(size_t index) {
  setCurrent(m_tiles[index].id);
  Q_EMIT picked(m_current);
}

void MaterialsPanel::mousePressEvent(QMouseEvent* event) {
  const int tile = tileAt(event->position().toPoint());
  if (tile >= 0) pick(static_cast<size_t>(tile));
}

void MaterialsPanel::mouseMoveEvent(QMouseEvent* event) {
  const int tile = tileAt(event->position().toPoint());
  if (tile == m_hover) return;
  m_hover = tile;
  setToolTip(tile < 0 ? QString() : m_tiles[static_cast<size_t>(tile)].label);
  update();
}

void MaterialsPanel::leaveEvent(QEvent*) {
  m_hover = -1;
  update();
}

void MaterialsPanel::keyPressEvent(QKeyEvent* event) {
  const int step = event->key() == Qt::Key_Right  ? 1
                   : event->key() == Qt::Key_Left ? -1
                   : event->key() == Qt::Key_Down ? columns()
                   : event->key() == Qt::Key_Up   ? -columns()
                                                  : 0;
  int index = 0;
  for (size_t i = 0; i < m_tiles.size(); ++i) {
    if (m_tiles[i].id == m_current) index = static_cast<int>(i);
  }
  if (step == 0 || index + step < 0 || index + step >= static_cast<int>(m_tiles.size())) {
    QWidget::keyPressEvent(event);
    return;
  }
  pick(static_cast<size_t>(index + step));
}

}  // namespace ps
