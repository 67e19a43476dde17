// SPDX-License-Identifier: Apache-2.0
// What the viewport tells in words: to assistive technology, and under the pointer.
#include "ui/document/document.h"
#include "ui/viewport/viewport.h"

#include <QtGui/QHelpEvent>
#include <QtWidgets/QAccessibleWidget>
#include <QtWidgets/QToolTip>

#include <algorithm>

namespace ps {
namespace {

class ViewportAccessible final : public QAccessibleWidget {
 public:
  explicit ViewportAccessible(Viewport* view) : QAccessibleWidget(view, QAccessible::Graphic) {}
  QString text(QAccessible::Text kind) const override {
    if (kind == QAccessible::Value) return static_cast<const Viewport*>(widget())->summary();
    return QAccessibleWidget::text(kind);
  }
};

QAccessibleInterface* makeAccessible(const QString& /*className*/, QObject* object) {
  auto* view = qobject_cast<Viewport*>(object);
  return view ? new ViewportAccessible(view) : nullptr;
}

}  // namespace

void Viewport::installAccessibility() {
  static const bool installed = (QAccessible::installFactory(makeAccessible), true);
  (void)installed;
}

QString Viewport::summary() const {
  QStringList parts;
  if (m_tool == ViewTool::Select) {
    parts << QStringLiteral("Select and orbit");
  } else if (places(m_tool)) {
    parts << (m_tool == ViewTool::Tap ? QStringLiteral("Place a tap") : QStringLiteral("Place a drain"));
  } else {
    parts << (m_tool == ViewTool::Brush ? QStringLiteral("Brush") : QStringLiteral("Eraser"))
          << QString::fromStdString(m_brush.shape) << QStringLiteral("radius ") + lengthText(m_brush.radius);
    if (m_tool == ViewTool::Brush && m_document) {
      for (const SceneMaterial& material : m_document->project().materials) {
        if (material.id == m_brush.material) parts << QString::fromStdString(material.label);
      }
    }
    if (m_cursor) {
      parts << QStringLiteral("height ") + lengthText(std::max(0.0, m_cursor->centre[1] - m_cursor->floor));
    }
  }
  if (m_selectedPort && m_document) parts << m_document->portName(*m_selectedPort);
  if (const auto marked = tag()) parts << marked->name + QLatin1Char(' ') + marked->value;
  return parts.join(QStringLiteral(", "));
}

void Viewport::announce() {
  if (!QAccessible::isActive()) return;
  QAccessibleValueChangeEvent event(this, summary());
  QAccessible::updateAccessibility(&event);
}

bool Viewport::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    if (!m_hits.legendBar.isEmpty() && m_hits.legend.contains(help->pos())) {
      QToolTip::showText(help->globalPos(),
                         QStringLiteral("Drag an end to set the range; double-click for the automatic one."), this,
                         m_hits.legend.toRect());
      return true;
    }
  }
  return QOpenGLWidget::event(event);
}

}  // namespace ps
