// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/viewportaccess.h"

#include "ui/viewport/viewport.h"

#include <QtWidgets/QAccessibleWidget>

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

void installViewportAccessibility() {
  static const bool installed = (QAccessible::installFactory(makeAccessible), true);
  (void)installed;
}

}  // namespace ps
