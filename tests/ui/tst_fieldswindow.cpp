// SPDX-License-Identifier: Apache-2.0
// A plugin's field is chosen, shown, plotted and read in the real window as ours are.
#include "core/simulation/particlefield.h"
#include "tests/ui/paintedtexts.h"
#include "tests/ui/samplewindow.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/panels/outliner.h"
#include "ui/panels/outlinerdelegate.h"
#include "ui/session/recordedview.h"
#include "ui/viewport/overlays.h"

#include <QtCore/QAbstractItemModel>
#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QTreeView>

using namespace ps;

namespace {

const QString kMark = QStringLiteral("fixture.source.mark"), kLabel = QStringLiteral("Mark of the fixture");

}  // namespace

class TestFieldsWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  /// The sample with the fixture's source of heat and a probe of its field, a few frames on.
  void initTestCase() {
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/fixture_source.so",
                        m_fixtures.filePath("showing_source.so")));
    m_window = sampleWindow({1280, 800}, {m_fixtures.path().toStdString()});
    QVERIFY(m_window);
    Project project = document().project();
    project.solver.heatSources.push_back({"fixture.source", {}, {}});
    Probe probe;
    probe.id = probe.name = "mark";
    probe.quantity = kMark.toStdString() + "_max";
    project.probes.insert(project.probes.begin(), probe);
    document().open(project, {}, false, false);
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot() && session().snapshot()->stats.frame == 1, kLong);
  }
  void cleanupTestCase() { m_window.reset(); }

  void itIsChosenAndShowsInTheLegend() {
    auto* combo = colours();
    const int row = combo->findText(kLabel);
    QVERIFY(row > 0);
    QVERIFY(combo->findText(QStringLiteral("Specific enthalpy")) > 0);
    combo->setCurrentIndex(row);
    Q_EMIT combo->activated(row);
    QCOMPARE(document().project().view.colour, kMark.toStdString());
    QTRY_VERIFY_WITH_TIMEOUT(legendNow() == std::pair(kLabel, QStringLiteral("MJ/kg")), kLong);
    // Numbers of particles, a thousand joules each: from 0 to a round number not below the last.
    QTRY_VERIFY_WITH_TIMEOUT(view()->legendRange().second > 0, kLong);
    const auto [low, high] = view()->legendRange();
    const double last = 1e3 * (static_cast<double>(session().snapshot()->id.size()) - 1);
    QVERIFY2(low == 0 && high >= last && high <= 10 * last, qPrintable(QString::number(high)));
    const QImage marks = view()->grabFramebuffer();
    m_window->action(QStringLiteral("view.colour1"))->trigger();
    QCOMPARE(combo->currentText(), QStringLiteral("Matter"));
    QTRY_VERIFY_WITH_TIMEOUT(legendNow().first.isEmpty(), kLong);
    QVERIFY(view()->grabFramebuffer() != marks);
  }

  /// The menu has what the combo has, in its order.
  void theViewMenuHasIt() {
    const auto menus = m_window->findChild<QMenuBar*>()->actions();
    const auto viewMenu =
        std::find_if(menus.begin(), menus.end(), [](const QAction* a) { return a->text() == QStringLiteral("View"); });
    QVERIFY(viewMenu != menus.end());
    const auto entries = (*viewMenu)->menu()->actions();
    const auto colour = std::find_if(entries.begin(), entries.end(),
                                     [](const QAction* a) { return a->text() == QStringLiteral("Colour"); });
    QVERIFY(colour != entries.end());
    QStringList names, offered;
    for (const QAction* action : (*colour)->menu()->actions()) names << action->text();
    for (int i = 0; i < colours()->count(); ++i) offered << colours()->itemText(i);
    QCOMPARE(names, offered);
    (*colour)->menu()->actions()[names.indexOf(kLabel)]->trigger();
    QCOMPARE(document().project().view.colour, kMark.toStdString());
    QCOMPARE(colours()->currentText(), kLabel);
    m_window->action(QStringLiteral("view.colour2"))->trigger();
    QCOMPARE(document().project().view.colour, std::string("temperature"));
  }

  /// Bodies have names in place of a scale.
  void bodiesAreToldApart() {
    document().setColour("body");
    QTRY_VERIFY_WITH_TIMEOUT(legendNow().first == QStringLiteral("Body"), kLong);
    const size_t bodies = session().snapshot()->bodyIds->size();
    QVERIFY(bodies > 0);
    QCOMPARE(view()->overlayHits().legendClasses, static_cast<int>(std::min(bodies, size_t{8})));
    QVERIFY(view()->overlayHits().legendBar.isEmpty());
  }

  /// Every colouring that can be chosen has one with a title, and names or numbers with their unit beside its colours.
  void everyColouringHasALegend() {
    QComboBox* combo = colours();
    QVERIFY(combo->count() > 8);
    for (int row = 1; row < combo->count(); ++row) {
      const QByteArray name = combo->itemText(row).toUtf8();
      combo->setCurrentIndex(row);
      Q_EMIT combo->activated(row);
      QTRY_VERIFY2_WITH_TIMEOUT(legendNow().first == combo->itemText(row), name.constData(), kLong);
      const FieldPtr field = session().fields().find(combo->itemData(row).toString().toStdString());
      QVERIFY2(field, name.constData());
      const OverlayHits& hits = view()->overlayHits();
      QVERIFY2(!hits.legend.isEmpty() && QRectF(view()->rect()).contains(hits.legend), name.constData());
      if (hits.legendClasses > 0) {
        QVERIFY2(hits.legendBar.isEmpty(), name.constData());
        continue;
      }
      QVERIFY2(hits.legend.contains(hits.legendBar) && !hits.legendBar.isEmpty(), name.constData());
      QVERIFY2(field->unit == "1" || !hits.legendUnit.isEmpty(), name.constData());
      const auto [low, high] = view()->legendRange();
      QVERIFY2(high > low || !hits.legendWithout.isEmpty(), name.constData());
      // With values, which the scene may lack now: a number at each end at least, and where it can tell a change of
      // phase what changes there.
      std::pair<double, double> range = high > low ? std::pair(low, high) : std::pair(0.0, 0.7);
      if (field->name == "temperature") range = {250, 400};
      const QStringList texts = legendTexts(field, range);
      QVERIFY2(texts.filter(QRegularExpression(QStringLiteral("\\d"))).size() >= 2, qPrintable(texts.join('|')));
      QVERIFY2(field->unit == "1" || texts.join('|').contains(hits.legendUnit.right(1)), qPrintable(texts.join('|')));
      const bool both = texts.contains(QStringLiteral("melts")) && texts.contains(QStringLiteral("boils"));
      QVERIFY2(both == (field->name == "temperature"), qPrintable(texts.join('|')));
    }
    document().setColour("temperature");
  }

  /// What the scene does not keep has a legend that says so, and matter keeps its own colours.
  void whatIsNotThereIsSaid() {
    Document& scene = document();
    scene.setColour("thesis_latent.melting");
    QTRY_VERIFY_WITH_TIMEOUT(legendNow().first == QStringLiteral("Heat of melting"), kLong);
    QVERIFY(view()->legendRange() == (std::pair{0.0, 0.0}));
    scene.setColour("org.example.lost.field");
    QCOMPARE(colours()->currentText(), QStringLiteral("Matter"));
    QTRY_VERIFY_WITH_TIMEOUT(legendNow().first.isEmpty(), kLong);
  }

  /// Frames hold the fields that were asked for when they were recorded.
  void whatWasNotRecordedIsSaid() {
    document().setColour("thesis_latent.melting");
    QTRY_COMPARE_WITH_TIMEOUT(view()->overlayHits().legendWithout, QStringLiteral("none here"), kLong);
    session().recorded().showAt(0);
    QTRY_VERIFY_WITH_TIMEOUT(session().recorded().isActive(), kLong);
    QTRY_COMPARE_WITH_TIMEOUT(view()->overlayHits().legendWithout, QStringLiteral("not recorded"), kLong);
    picture(QStringLiteral("tst_fieldswindow_notrecorded.png"));
    document().setColour("temperature");
    QTRY_COMPARE_WITH_TIMEOUT(view()->overlayHits().legendWithout, QString(), kLong);
    session().recorded().showNewest();
    QTRY_VERIFY_WITH_TIMEOUT(!session().recorded().isActive(), kLong);
  }

  void itsProbeIsPlottedAndRead() {
    auto* panel = m_window->findChild<GraphsPanel*>();
    GraphView* graph = panel->valuesIn("J/kg");
    QVERIFY(graph && panel->valuesIn("K") && panel->valuesIn("K") != graph);
    QCOMPARE(graph->title(), kLabel);
    QTRY_VERIFY_WITH_TIMEOUT(graph->sampleCount(0) > 1, kLong);
    graph->grab();
    QVERIFY2(graph->axisTitle().endsWith(QStringLiteral("MJ/kg")), qPrintable(graph->axisTitle()));
    QVERIFY2(graph->summary().contains(QStringLiteral("MJ/kg")), qPrintable(graph->summary()));
    const QAbstractItemModel* rows = m_window->findChild<Outliner*>()->findChild<QTreeView*>()->model();
    QTRY_VERIFY_WITH_TIMEOUT(detailOf(*rows, {}).contains(QStringLiteral("MJ/kg")), kLong);
    Project without = document().project();
    without.probes.clear();
    document().open(without, {}, false, false);
    QVERIFY(!panel->valuesIn("J/kg"));
  }

 private:
  QComboBox* colours() {
    for (QComboBox* combo : m_window->findChildren<QComboBox*>()) {
      if (combo->accessibleName() == QStringLiteral("Colour")) return combo;
    }
    return nullptr;
  }
  std::pair<QString, QString> legendNow() {
    view()->grabFramebuffer();
    return {view()->overlayHits().legendTitle, view()->overlayHits().legendUnit};
  }
  /// What a legend of water says.
  QStringList legendTexts(const FieldPtr& field, std::pair<double, double> range) {
    OverlayState state;
    state.size = view()->size();
    state.field = field;
    state.range = range;
    state.shown = {};
    TextDevice device(view()->size());
    QPainter painter(&device);
    const OverlayHits hits = paintOverlays(painter, state);
    QStringList texts;
    for (const PaintedText& painted : device.texts) {
      if (hits.legend.contains(painted.place.center())) texts << painted.text;
    }
    return texts;
  }
  static QString detailOf(const QAbstractItemModel& model, const QModelIndex& parent) {
    QString all;
    for (int row = 0; row < model.rowCount(parent); ++row) {
      const QModelIndex at = model.index(row, 0, parent);
      all += at.data(outline::kDetail).toString() + QLatin1Char('\n') + detailOf(model, at);
    }
    return all;
  }
  QTemporaryDir m_fixtures;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestFieldsWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_fieldswindow.moc"
