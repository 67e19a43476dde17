// SPDX-License-Identifier: Apache-2.0
// The tools that a hand can take, filled with particles.
#include "core/geometry/toolbodies.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "tests/physics/leadingscene.h"

#include <QTest>

#include <cmath>
#include <vector>

using namespace ps;
using namespace leading;

class TestToolBodies : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void eachToolIsWhole_data();
  void eachToolIsWhole();
  void aSpoonHoldsWater();

 private:
  PluginRegistry m_plugins;
};

void TestToolBodies::eachToolIsWhole_data() {
  QTest::addColumn<int>("form");
  QTest::addColumn<double>("length");
  for (const double length : {0.1, 0.5})
    for (const ToolForm& form : toolForms()) QTest::addRow("%s %g m", form.id, length) << int(form.kind) << length;
}

/// Its particles fill its volume, to what a lattice leaves of thin walls, and no part of it is away from the others by
/// more than the layer that a seam between two may leave out. None of its parts is packed by itself.
void TestToolBodies::eachToolIsWhole() {
  QFETCH(int, form);
  QFETCH(double, length);
  Project project = scene(1, 2);
  Body body = toolBody(static_cast<ToolForm::Kind>(form), length, kSpacing);
  const auto& shape = std::get<SolidShape>(body.shape);
  QVERIFY(!shape.mesh || choiceOf(shape.parameters, solidParameters(), "fill") == "lattice");
  body = moved(body, {Quaternion::Identity(), {0, 1, 0}});
  const double volume = SolidForm(std::get<SolidShape>(body.shape)).volume();
  body.material = "water";
  body.parameters.values["temperature"] = 260.0;
  const std::string id = body.id;
  project.bodies.push_back(body);
  Engine engine(project, m_plugins);
  const Seen all = seen(engine, id);
  const double cells = volume / std::pow(kSpacing, 3), count = static_cast<double>(all.places.size());
  QVERIFY2(count > 0.6 * cells && count < 1.5 * cells, qPrintable(QString("%1 of %2").arg(count).arg(cells)));
  std::vector<Vector3> places, reached;
  for (const auto& [key, place] : all.places) places.push_back(place);
  reached.push_back(places.back());
  places.pop_back();
  for (size_t k = 0; k < reached.size(); ++k) {
    const Vector3 here = reached[k];
    std::erase_if(places, [&](const Vector3& place) {
      const bool near = (place - here).norm() < 2.2 * kSpacing;
      if (near) reached.push_back(place);
      return near;
    });
  }
  QVERIFY2(places.empty(), qPrintable(QString("%1 of %2 apart").arg(places.size()).arg(count)));
}

/// What lies in the bowl of a spoon is lifted with it, and stays in it.
void TestToolBodies::aSpoonHoldsWater() {
  Project project = scene(1, 1.5);
  Body spoon = toolBody(ToolForm::Kind::Spoon, 0.9, kSpacing);
  const BodyBounds bounds = boundsOf(spoon);
  const double radius = 0.5 * (bounds.maximum.z() - bounds.minimum.z());
  const Vector3 bowl(bounds.minimum.x() + radius, 0, 0);  // its middle
  spoon.id = "tool";
  spoon.material = "water";
  spoon.parameters.values["temperature"] = 260.0;
  project.bodies.push_back(moved(spoon, {Quaternion::Identity(), Vector3(0, 0.4, 0) - bowl}));
  project.bodies.push_back(solid("water", "ellipsoid", {0.14, 0.08, 0.14}, {0, 0.43, 0}, 300));
  Engine engine(project, m_plugins);
  play(engine, 60);
  const double rim = 0.4 + 0.5 * (bounds.maximum.y() - bounds.minimum.y());
  const size_t count = seen(engine, "water").places.size();
  const auto inside = [&](double lifted) {
    size_t held = 0;
    for (const auto& [id, place] : seen(engine, "water").places)
      held += place.y() > rim + lifted - radius && std::hypot(place.x(), place.z()) < radius;
    return held;
  };
  QCOMPARE(inside(0), count);
  for (int frame = 0; frame < 60; ++frame) {
    lead(engine, Vector3(0, 0.005, 0));
    play(engine, 1);
  }
  play(engine, 30);
  QVERIFY2(inside(0.3) >= 0.95 * static_cast<double>(count),
           qPrintable(QString("%1 of %2").arg(inside(0.3)).arg(count)));
}

QTEST_GUILESS_MAIN(TestToolBodies)
#include "tst_toolbodies.moc"
