// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowvalue.h"

#include <QtGui/QHoverEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>

#include <cmath>
#include <limits>
#include <utility>

// Declarations of every kind, and hands for widgets: shared by the tests of rows, panels and graphs.
namespace ps::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline constexpr api::ParameterDeclaration kList[] = {
    {"plate_temperature", "Plate temperature", "T_w", "K", api::ParameterKind::Number, api::Scale::Linear, 293.15,
     223.15, 573.15, 1, 3000, "°C", 1, -273.15, "", "Heat", "How hot the floor is held.", "kitchen plate 180", "none"},
    {"youngs_modulus", "Young's modulus", "E", "Pa", api::ParameterKind::Response, api::Scale::Logarithmic, 9.3e9, 1e3,
     1e11, 0, 1e13, "GPa", 1e-9, 0, "", "Mechanics", "Stiffness.", "ice 9.3, rubber 0.01", "Petrovic 2003"},
    {"substeps", "Substeps", "n", "", api::ParameterKind::Integer, api::Scale::Linear, 4, 1, 32, 1, 1000, "", 1, 0, "",
     "Mechanics", "Steps within a frame.", "", ""},
    {"gravity_on", "Gravity", "", "", api::ParameterKind::Toggle, api::Scale::Linear, 1, 0, 1, 0, 1, "", 1, 0, "",
     "Mechanics", "Whether things fall.", "", ""},
    {"kernel", "Kernel", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 2, 0, 2, "", 1, 0,
     "cubic_spline|wendland_c2|poly_6", "Mechanics", "Shape of a particle's influence.", "", ""},
    {"conductivity", "Conductivity", "k_s", "W/(m·K)", api::ParameterKind::Response, api::Scale::Linear, 2.2, 0.1, 5, 0,
     1e4, "", 1, 0, "", "Heat", "How well heat passes.", "copper 400", "CRC 97th"}};

inline api::ParameterList list() { return api::listOf(kList); }

inline RowModel model(const char* key) {
  for (RowModel& row : rowModels(list(), {})) {
    if (row.key == QLatin1String(key)) return std::move(row);
  }
  qFatal("no such key");
}

/// What a row told: "B" Begin, "L" Live, "E" End, and the last number.
struct Listener {
  QString sequence;
  double last = kNaN;
  explicit Listener(ParameterRow& row) {
    QObject::connect(&row, &ParameterRow::editingStarted, &row,
                     [this](const QString&, const Value&) { sequence += 'B'; });
    QObject::connect(&row, &ParameterRow::valueEdited, &row, [this, &row](const QString&, const Value& value) {
      sequence += 'L';
      last = numberOfValue(row.model().declaration, value, 293.15);
    });
    QObject::connect(&row, &ParameterRow::editingFinished, &row, [this, &row](const QString&, const Value& value) {
      sequence += 'E';
      last = numberOfValue(row.model().declaration, value, 293.15);
    });
  }
};

inline void show(QWidget& widget, int width = 392) {
  widget.resize(width, widget.height());
  widget.show();
  QVERIFY(QTest::qWaitForWindowExposed(&widget));
  widget.activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(&widget));
}

inline QPoint onSlider(const ParameterRow& row, double position) {
  const QRect track = row.sliderRect();
  return {track.left() + static_cast<int>(std::lround(track.width() * position)), track.center().y()};
}

inline void drag(ParameterRow& row, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = Qt::NoModifier,
                 int steps = 8) {
  QTest::mousePress(&row, Qt::LeftButton, modifiers, from);
  for (int i = 1; i <= steps; ++i) {
    const QPointF at = QPointF(from) + (QPointF(to) - QPointF(from)) * i / steps;
    QMouseEvent move(QEvent::MouseMove, at, row.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, modifiers);
    QApplication::sendEvent(&row, &move);
  }
}

inline void wheel(QWidget& widget, QPointF at, int delta) {
  QWheelEvent event(at, widget.mapToGlobal(at), {}, {0, delta}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

inline constexpr std::pair<const char*, RowState> kStates[] = {{"hover", RowState::Hover},
                                                               {"focus", RowState::Focus},
                                                               {"disabled", RowState::Disabled},
                                                               {"mixed", RowState::Mixed},
                                                               {"out of range", RowState::OutOfRange},
                                                               {"changed", RowState::Changed},
                                                               {"on a key", RowState::OnKey},
                                                               {"between keys", RowState::BetweenKeys},
                                                               {"curve", RowState::Curve},
                                                               {"derived", RowState::Derived},
                                                               {"limited", RowState::Limited},
                                                               {"error", RowState::Error},
                                                               {"editing", RowState::Editing},
                                                               {"dragging", RowState::Dragging}};

/// Without focus, and wherever the pointer stands.
inline void rest(ParameterRow& row) {
  row.clearFocus();
  QHoverEvent leave(QEvent::HoverLeave, QPointF(-1, -1), QPointF(-1, -1), QPointF(20, 10));
  QApplication::sendEvent(&row, &leave);
}

/// Brings a row of model("conductivity") there, as a hand or the editor does.
inline void reach(ParameterRow& row, RowState wanted) {
  switch (wanted) {
    case RowState::Hover: {
      QHoverEvent enter(QEvent::HoverEnter, QPointF(20, 10), QPointF(20, 10), QPointF(-1, -1));
      QApplication::sendEvent(&row, &enter);
      break;
    }
    case RowState::Focus:
      row.setFocus(Qt::TabFocusReason);
      break;
    case RowState::Disabled:
      row.setDisabledReason(QStringLiteral("The plugin is missing."));
      break;
    case RowState::Mixed:
      row.setMixed(true);
      break;
    case RowState::OutOfRange:
      QVERIFY(row.enter(QStringLiteral("400")));
      break;
    case RowState::Changed:
      QVERIFY(row.enter(QStringLiteral("3")));
      break;
    case RowState::Curve: {
      Response curve;
      curve.kind = Response::Kind::Curve;
      curve.points = {{250, 2}, {270, 3}};
      row.setValue(curve);
      break;
    }
    case RowState::Derived:
      row.setDerivedFrom(QStringLiteral("from pressure"));
      break;
    case RowState::Limited:
      row.setLimit(QStringLiteral("The solver reaches **1**."), 1);
      break;
    case RowState::Error:
      QVERIFY(!row.enter(QStringLiteral("-3")));
      break;
    case RowState::Editing:
      row.startTyping();
      break;
    case RowState::Dragging:
      QTest::mousePress(&row, Qt::LeftButton, {}, onSlider(row, 0.8));
      break;
    case RowState::OnKey:
      row.setKeyMark(KeyMark::OnKey, ToNext::Linear);
      break;
    case RowState::BetweenKeys:
      row.setKeyMark(KeyMark::Between, ToNext::Linear);
      break;
  }
}

}  // namespace ps::testing
