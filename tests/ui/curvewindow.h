// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/responseedit.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/curves/curvepanel.h"
#include "ui/curves/curvetarget.h"
#include "ui/curves/curveview.h"
#include "ui/curves/pointspanel.h"

#include <QtWidgets/QLineEdit>

// The workspace Tune of the real window, for tests of what hands do to curves.
namespace ps {

inline const Address kViscosity{Owner::Material, "water", "viscosity"};
inline const Address kConductivity{Owner::Material, "water", "conductivity_liquid"};

class CurveWindowTest : public SampleWindowTest {
 protected:
  void openTune() {
    open();
    QVERIFY(m_window);
    session().pause();
  }
  void tuneFromTheStart() {
    backToTheStart();
    m_window->showWorkspace(MainWindow::kTuneTab);
    curves().choose(kViscosity);
    QTRY_VERIFY(curve().width() > 300);
    QCOMPARE(m_window->size(), QSize(1280, 800));  // the docks find room
    curve().fit();
  }
  CurveTarget& curves() { return m_window->curves(); }
  CurveView& curve() { return *m_window->findChild<CurvePanel*>()->view(); }
  PointsPanel& pages() { return *m_window->findChild<PointsPanel*>(); }
  Response response() { return curves().response(); }
  void threePoints(const Address& address = kViscosity) {
    curves().choose(address);
    QVERIFY(curves().set(curveThrough({{280, 0.0015}, {310, 0.001}, {350, 0.0005}}), QStringLiteral("Points")));
    curve().fit();
  }
  QPoint place(size_t index) { return curve().at(response().points[index].x, response().points[index].y).toPoint(); }
  void drag(size_t index, const QPoint& way, Qt::KeyboardModifiers modifiers = {}) {
    pull(place(index), way, modifiers);
  }
  void pull(const QPoint& from, const QPoint& way, Qt::KeyboardModifiers modifiers) {
    hands::pull(curve(), from, way, modifiers);
  }
  void shoot(const char* name) {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) QTest::qWait(200);  // docks and labels find their places
    if (!folder.isEmpty()) m_window->grab().save(QStringLiteral("%1/%2.png").arg(folder, QLatin1String(name)));
  }
  static void type(QLineEdit* field, const QString& text) {
    field->selectAll();
    QTest::keyClick(field, Qt::Key_Delete);
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
  }
};

}  // namespace ps
