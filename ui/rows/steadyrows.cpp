// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/steadyrows.h"

#include "ui/rows/parameterrow.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QEvent>
#include <QtWidgets/QLayout>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QScrollBar>

#include <algorithm>

namespace ps {

void changeSteadily(QScrollArea& area, const std::vector<ParameterRow*>& rows, const std::function<void()>& change) {
  const auto under = std::find_if(rows.begin(), rows.end(),
                                  [](const ParameterRow* row) { return row->isVisible() && row->underMouse(); });
  const auto top = [&] { return (*under)->mapTo(area.viewport(), QPoint()).y(); };
  const int before = under == rows.end() ? 0 : top();
  change();
  if (under == rows.end() || !area.widget()->layout()->activate()) return;
  QEvent request(QEvent::LayoutRequest);
  QCoreApplication::sendEvent(&area, &request);  // the scroll bar knows the present height now
  area.verticalScrollBar()->setValue(area.verticalScrollBar()->value() + top() - before);
}

}  // namespace ps
