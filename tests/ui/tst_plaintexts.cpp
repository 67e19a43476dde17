// SPDX-License-Identifier: Apache-2.0
// What files, plugins and paths call things is shown as it stands: a project and plugins whose every text Qt would take
// for rich text, and a walk over all that the window shows.
#include "tests/ui/samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/messagelog.h"
#include "ui/theme/plaintext.h"
#include "ui/window/actions.h"
#include "ui/window/noticebar.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtGui/QHelpEvent>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMessageBox>
#include <QtWidgets/QToolTip>
#include <QtWidgets/QTreeView>

using namespace ps;

namespace {

const QString kMarked = QStringLiteral("<img src='x'>&y");  ///< as in tests/plugins/fixtures/behaviour.h
const QString kTag = QStringLiteral("<img");

/// What stands in the tooltip after the pointer has rested there.
QString tipAt(QWidget* widget, const QPoint& at) {
  QHelpEvent help(QEvent::ToolTip, at, widget->mapToGlobal(at));
  QApplication::sendEvent(widget, &help);
  return QToolTip::text();
}

/// A tip that shows kMarked as it stands.
bool isPlainTip(const QString& tip) { return !tip.contains(kTag) && tip.contains(kTag.toHtmlEscaped()); }

}  // namespace

class TestPlainTexts : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QDir folder(m_folder.path());
    for (const char* kind : {"brush", "constraint", "source"}) {
      QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QStringLiteral("/fixture_%1.so").arg(kind),
                          folder.filePath(QStringLiteral("marked_%1.so").arg(kind))));
    }
    QFile material(folder.filePath(kMarked + QStringLiteral(".json")));
    QVERIFY(material.open(QIODevice::WriteOnly));
    material.write(QStringLiteral("{'format': 'phasesketch-material', 'version': 1, 'id': 'marked', 'label': '%1', "
                                  "'licence': '%1', 'author': '%1', 'help': '%1', "
                                  "'properties': {'density_solid': {'value': 1050, 'source': '%1', 'grade': 'C'}}}")
                       .replace(QLatin1Char('\''), QLatin1Char('"'))
                       .arg(QString(kMarked).replace(QLatin1Char('\''), QStringLiteral("\\u0027")))
                       .toUtf8());
    QFile broken(folder.filePath(kMarked + QStringLiteral(".so")));
    QVERIFY(broken.open(QIODevice::WriteOnly) && broken.write("no library") > 0);
    material.close();
    broken.close();
    m_window = sampleWindow({1280, 800}, {m_folder.path().toStdString()});
    QVERIFY(m_window);
  }
  void cleanupTestCase() { m_window.reset(); }

  /// It filled the memory: the name of a pinned row that is none comes back in the sentence about the file.
  void aFileThatIsRefused() {
    QFile sample(kSample);
    QVERIFY(sample.open(QIODevice::ReadOnly));
    QJsonObject project = QJsonDocument::fromJson(sample.readAll()).object();
    project[QStringLiteral("view")] = QJsonObject{{QStringLiteral("pinned"), QJsonArray{kMarked}}};
    QFile file(m_folder.filePath(QStringLiteral("refused.json")));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(QJsonDocument(project).toJson()) > 0);
    file.close();
    m_window->openFile(file.fileName());
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->topic() != QStringLiteral("plugins"), kLong);
    QVERIFY2(m_window->notice()->text().contains(kTag), qPrintable(m_window->notice()->text()));
    everyLabelIsPlain();
  }

  void everythingOfAProject() {
    openMarked();
    QVERIFY(m_window->windowTitle().contains(kMarked));
    QVERIFY(!m_window->inspector().bodyPanel()->rows().empty());
    m_window->session().log().add(MessageLevel::Error, kMarked, kMarked);
    document().undoStack().push(new QUndoCommand(kMarked));
    QMessageBox box(QMessageBox::Warning, kMarked, kMarked, QMessageBox::Ok, m_window.get());
    box.setInformativeText(kMarked);
    box.show();
    everyLabelIsPlain();
    everyButtonHasItsAmpersand();
    everyTipIsPlain();
  }

  void tipsOfItems() {
    m_window->session().log().add(MessageLevel::Error, kMarked, kMarked);
    m_window->layoutOfDocks().showPage(QStringLiteral("Messages"));
    QTreeView* messages = named<QTreeView>(QStringLiteral("Messages"));
    QVERIFY(messages);
    QTRY_VERIFY(messages->isVisible() && messages->model()->rowCount() > 0);
    const QString tip = tipAt(messages->viewport(), messages->visualRect(messages->model()->index(0, 2)).center());
    QVERIFY2(isPlainTip(tip), qPrintable(tip));

    QComboBox* colours = named<QComboBox>(QStringLiteral("Colour"));
    const int row = colours->findText(kMarked);
    QVERIFY(row > 0);
    colours->showPopup();
    QAbstractItemView* list = colours->view();
    QTRY_VERIFY(list->isVisible());
    const QModelIndex index = list->model()->index(row, colours->modelColumn());
    list->scrollTo(index);
    const QString help = tipAt(list->viewport(), list->visualRect(index).center());
    colours->hidePopup();
    QVERIFY2(isPlainTip(help), qPrintable(help));
  }

  /// Rows have rich tips of our own making, with the texts of others escaped, and notes without links of others.
  void rowsOfAPlugin() {
    openMarked();
    m_window->inspector().setBody("ice");
    ParameterRow* row =
        m_window->inspector().bodyPanel()->row(QStringLiteral("constraint/ice/fixture.constraint/colour"));
    QVERIFY(row);
    const QString tip = tipAt(row, row->rect().center());
    QVERIFY2(isPlainTip(tip) && Qt::mightBeRichText(tip), qPrintable(tip));
    row->setError(kMarked);
    row->setLimit(asNote(kMarked + QStringLiteral(" [look](here) \\[")) + QStringLiteral(" [Mend](it)"));
    everyLabelIsPlain();
    const QString note = row->findChild<QLabel*>(QStringLiteral("psLimit"))->text();
    QVERIFY2(note.contains(QStringLiteral("[look](here) \\[ <a href=\"it\"")), qPrintable(note));
    QCOMPARE(row->findChild<QLabel*>(QStringLiteral("psError"))->text(), kMarked);
    row->setError({});
    row->setLimit({});
  }

 private:
  void openMarked() {
    Project project = document().project();
    const std::string mark = kMarked.toStdString();
    project.title = project.description = project.generator = mark;
    for (SceneMaterial& material : project.materials) material.label = mark;
    for (Body& body : project.bodies) body.name = mark;
    for (SceneWall& wall : project.environment.walls) wall.name = mark;
    project.bodies.front().constraints = {{"bonds", {}, {}}, {"fixture.constraint", {}, {}}};
    Emitter tap;
    tap.id = "tap";
    tap.name = mark;
    tap.material = project.materials.front().id;
    Sink drain;
    drain.id = "drain";
    drain.name = mark;
    Probe probe;
    probe.id = "probe";
    probe.name = mark;
    probe.quantity = "fixture.source.mark_max";
    project.emitters = {tap};
    project.sinks = {drain};
    project.probes = {probe};
    project.solver.heatSources = {{"fixture.source", {}, {}}};
    const QString path = m_folder.filePath(kMarked + QStringLiteral(".phasesketch.json"));
    document().open(project, path, false, false);
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot() && session().snapshot()->stats.frame == 1, kLong);
  }

  /// A label that is rich by intention has none of others' marks.
  static void everyLabelIsPlain() {
    int seen = 0;
    for (QWidget* widget : QApplication::allWidgets()) {
      auto* label = qobject_cast<QLabel*>(widget);
      if (!label || label->inherits("QTipLabel")) continue;
      label->ensurePolished();
      if (label->textFormat() == Qt::PlainText)
        seen += label->text().contains(kTag);
      else
        QVERIFY2(label->textFormat() == Qt::RichText && !label->text().contains(kTag), qPrintable(label->text()));
    }
    QVERIFY(seen > 0);
  }

  void everyButtonHasItsAmpersand() {
    int seen = 0;
    for (const QAction* action : m_window->findChildren<QAction*>()) {
      if (!action->text().contains(kTag)) continue;
      QVERIFY2(cleanText(*action).contains(kMarked), qPrintable(action->text()));
      ++seen;
    }
    QVERIFY2(seen >= 3, qPrintable(QString::number(seen)));  // a brush, a colour, undo
    seen = 0;
    for (const QAbstractButton* button : m_window->findChildren<QAbstractButton*>()) {
      if (!button->text().contains(kTag)) continue;
      QVERIFY2(fromButtonText(button->text()).contains(kMarked), qPrintable(button->text()));
      ++seen;
    }
    QVERIFY(seen > 0);
  }

  void everyTipIsPlain() {
    int seen = 0;
    for (QWidget* widget : m_window->findChildren<QWidget*>()) {
      const QString tip = tipAt(widget, widget->rect().center());
      QVERIFY2(!tip.contains(kTag), qPrintable(tip));
      seen += widget->toolTip().contains(kTag);
    }
    QVERIFY(seen > 0);
  }

  template <class Widget>
  Widget* named(const QString& name) {
    for (Widget* widget : m_window->findChildren<Widget*>()) {
      if (widget->accessibleName() == name) return widget;
    }
    return nullptr;
  }

  QTemporaryDir m_folder;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestPlainTexts test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_plaintexts.moc"
