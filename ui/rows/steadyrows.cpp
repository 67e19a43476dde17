// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/steadyrows.h"

#include "ui/rows/parameterrow.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QEvent>
#include <QtGui/QCursor>
#include <QtWidgets/QLayout>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QScrollBar>

namespace ps {
namespace {

/// Asked of the pointer itself: a row that was scrolled away beneath it still says that it is under the mouse.
const QWidget* rowUnderPointer(const QWidget& viewport) {
  const QWidget* at = viewport.childAt(viewport.mapFromGlobal(QCursor::pos()));
  while (at && !qobject_cast<const ParameterRow*>(at)) at = at->parentWidget();
  return at;
}

}  // namespace

void changeSteadily(QScrollArea& area, const std::function<void()>& change) {
  const QWidget* under = rowUnderPointer(*area.viewport());
  const auto top = [&] { return under->mapTo(area.viewport(), QPoint()).y(); };
  const int before = under ? top() : 0;
  change();
  if (!under || !area.widget()->layout()->activate()) return;
  QEvent request(QEvent::LayoutRequest);
  QCoreApplication::sendEvent(&area, &request);  // the scroll bar knows the present height now
  area.verticalScrollBar()->setValue(area.verticalScrollBar()->value() + top() - before);
}

}  // namespace ps
