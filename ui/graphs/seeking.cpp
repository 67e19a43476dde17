// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/seeking.h"

#include "ui/graphs/timeplot.h"
#include "ui/session/recordedview.h"

#include <QtCore/QTimer>
#include <QtWidgets/QApplication>

#include <memory>

namespace ps {

void seekByClicks(TimePlot& plot, RecordedView& recorded) {
  auto* click = new QTimer(&plot);
  click->setSingleShot(true);
  click->setInterval(QApplication::doubleClickInterval());
  const auto time = std::make_shared<double>(0);
  QObject::connect(&plot, &TimePlot::seekRequested, click, [click, time](double seconds) {
    *time = seconds;
    click->start();
  });
  QObject::connect(&plot, &TimePlot::fitted, click, &QTimer::stop);
  QObject::connect(click, &QTimer::timeout, &recorded, [&recorded, time] { recorded.showAt(*time); });
}

}  // namespace ps
