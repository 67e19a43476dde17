// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/repositoryrules.h"

#include <QDirIterator>
#include <QFile>
#include <QTest>

namespace {

using ps::rules::Problems;

struct Source {
  std::string path, text;
};

const QStringList kHouses = {"app", "core", "plugins", "ui", "tests"};

QString root() { return QStringLiteral(PS_SOURCE_DIR "/"); }

Source read(const QString& path) {
  QFile file(root() + path);
  if (!file.open(QIODevice::ReadOnly)) QTest::qFail(("cannot read " + file.fileName()).toUtf8(), __FILE__, __LINE__);
  return {path.toStdString(), file.readAll().toStdString()};
}

// Files of these endings under these folders, sorted by path.
std::vector<Source> sources(const QStringList& folders, const QStringList& endings) {
  QStringList paths;
  for (const QString& folder : folders) {
    QDirIterator it(root() + folder, endings, QDir::Files | QDir::Hidden, QDirIterator::Subdirectories);
    while (it.hasNext()) paths.append(it.next().mid(root().size()));
  }
  paths.sort();
  std::vector<Source> list;
  for (const QString& path : paths) list.push_back(read(path));
  return list;
}

QByteArray joined(const Problems& problems) {
  std::string text;
  for (const std::string& problem : problems) text += "\n  " + problem;
  return QByteArray::fromStdString(text);
}

template <class Rule>
void check(const std::vector<Source>& list, Rule rule) {
  QVERIFY2(!list.empty(), "no files found: the test looks in the wrong place");
  Problems all;
  for (const Source& source : list) {
    const Problems problems = rule(source.path, source.text);
    all.insert(all.end(), problems.begin(), problems.end());
  }
  QVERIFY2(all.empty(), joined(all).constData());
}

}  // namespace

class RepositoryTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void includesFollowTheArrows() { check(sources(kHouses, {"*.h", "*.cpp"}), ps::rules::includes); }
  void sourcesNameTheirLicence() {
    check(sources(kHouses, {"*.h", "*.cpp", "*.sh"}), ps::rules::licence);
    check(sources({"resources"}, {"*.glsl", "*.vert", "*.frag", "*.comp"}), ps::rules::licence);
  }
  void nothingIsLeftForLater() {
    const QStringList texts = {"*.h",  "*.cpp",  "*.sh",   "*.cmake", "*.in",   "CMakeLists.txt", "*.json",
                               "*.md", "*.glsl", "*.vert", "*.frag",  "*.comp", "*.svg",          "*.qrc"};
    check(sources(kHouses + QStringList{"resources", "projects"}, texts), ps::rules::words);
    check(rootFiles(), ps::rules::words);
  }
  void coloursComeFromTheTheme() {
    check(sources({"ui", "app"}, {"*.h", "*.cpp"}), ps::rules::colours);
    check(sources({"resources"}, {"*.qss", "*.svg", "*.json", "*.glsl", "*.vert", "*.frag", "*.comp"}),
          ps::rules::colours);
  }
  void tooltipsKnowWhatIsPlain() { check(sources({"ui", "app"}, {"*.h", "*.cpp"}), ps::rules::tips); }
  void nothingAsksInABox() { check(sources({"ui", "app"}, {"*.h", "*.cpp"}), ps::rules::boxes); }
  void messagesSayWhatToDo() { check(sources({"ui", "app"}, {"*.h", "*.cpp"}), ps::rules::messages); }
  void eachNameIsOfOneThing() {
    std::map<std::string, std::string> known;
    check(sources({"app", "core", "plugins", "ui"}, {"*.h", "*.cpp"}),
          [&](std::string_view path, std::string_view text) { return ps::rules::names(path, text, known); });
    QVERIFY(known.contains("ps::Session") && known.contains("ps::api::Cell") && known.size() > 500);
  }
  void mentionedDocumentsExist() {
    std::vector<std::string> known;
    for (const Source& document : sources({""}, {"*.md"}))
      if (!document.path.starts_with("build/") && !document.path.starts_with("out/"))
        known.push_back(document.path.substr(document.path.rfind('/') + 1));
    const auto rule = [&](std::string_view path, std::string_view text) {
      return ps::rules::documents(path, text, known);
    };
    check(sources(kHouses + QStringList{"resources"}, {"*.h", "*.cpp", "CMakeLists.txt", "*.md", "*.glsl", "*.frag"}),
          rule);
    check(rootFiles(), rule);
  }

  // The rules themselves: each row is a text that breaks, or keeps, one of them.
  void rulesCatchWhatTheyForbid_data();
  void rulesCatchWhatTheyForbid();

 private:
  static std::vector<Source> rootFiles() {
    std::vector<Source> list;
    for (const char* path : {"CMakeLists.txt", "CMakePresets.json", "README.md", "ARCHITECTURE.md", "CHANGELOG.md",
                             "CONTRIBUTING.md", "dev", ".ci/run", ".clang-format", ".clang-tidy"})
      list.push_back(read(QString::fromLatin1(path)));
    return list;
  }
};

void RepositoryTest::rulesCatchWhatTheyForbid_data() {
  QTest::addColumn<QString>("rule");
  QTest::addColumn<QString>("path");
  QTest::addColumn<QString>("text");
  QTest::addColumn<int>("problems");
  const auto row = [](const char* name, const char* rule, const char* path, const QString& text, int problems) {
    QTest::newRow(name) << rule << path << text << problems;
  };
  const auto include = [&](const char* name, const char* path, const char* target, int problems) {
    row(name, "includes", path, QStringLiteral("// x\n#include %1\n").arg(QLatin1String(target)), problems);
  };
  include("core to ui", "core/solver/a.h", "\"ui/render/renderer.h\"", 1);
  include("core to app", "core/io/a.cpp", "\"app/cli/x.h\"", 1);
  include("core to plugins", "core/io/a.cpp", "\"plugins/materials/water.h\"", 1);
  include("core to tests", "core/io/a.cpp", "\"tests/shared/scenes.h\"", 1);
  include("core downwards", "core/simulation/a.h", "\"core/solver/solver.h\"", 0);
  include("core within a room", "core/solver/a.h", "\"core/solver/solver.h\"", 0);
  include("core upwards", "core/math/a.h", "\"core/solver/solver.h\"", 1);
  include("core to the SDK by path", "core/math/a.h", "\"core/plugin_api/include/phasesketch/types.h\"", 1);
  include("core to the SDK", "core/math/a.h", "<phasesketch/types.h>", 0);
  include("Eigen by its one door", "core/math/vector.h", "<Eigen/Core>", 0);
  include("Eigen past its door", "core/solver/a.cpp", "<Eigen/Core>", 1);
  include("a module of Eigen where it is needed", "core/solver/a.cpp", "<Eigen/Geometry>", 0);
  include("core to an unknown room", "core/simulation/a.h", "\"core/attic/a.h\"", 1);
  include("from an unknown room", "core/attic/a.h", "\"core/base/error.h\"", 1);
  include("core with Qt", "core/io/a.cpp", "<QString>", 1);
  include("core with a Qt module", "core/io/a.cpp", "<QtCore/QString>", 1);
  include("plugin_host with QtCore", "core/plugin_host/a.cpp", "<QPluginLoader>", 0);
  include("plugin_host with widgets", "core/plugin_host/a.cpp", "<QWidget>", 1);
  include("plugin_host with QtGui", "core/plugin_host/a.cpp", "<QtGui/QColor>", 1);
  include("core with OpenGL", "core/solver/a.cpp", "<epoxy/gl.h>", 1);
  include("SDK with std containers", "core/plugin_api/include/phasesketch/a.h", "<vector>", 1);
  include("SDK with Qt", "core/plugin_api/include/phasesketch/a.h", "<QObject>", 1);
  include("SDK's Qt entry", "core/plugin_api/include/phasesketch/qtentry.h", "<QObject>", 0);
  include("a stage from outside", "core/simulation/a.h", "\"core/solver/heat/radiation.h\"", 1);
  include("a stage from the interface", "ui/panels/a.h", "\"core/solver/fluid/density.h\"", 1);
  include("a stage from the face", "core/solver/solver.cpp", "\"core/solver/frame/solverimpl.h\"", 0);
  include("a stage from the frame", "core/solver/frame/step.cpp", "\"core/solver/heat/heat.h\"", 0);
  include("a stage from an earlier one", "core/solver/structure/a.cpp", "\"core/solver/heat/heat.h\"", 1);
  include("the solver from a stage", "core/solver/heat/a.cpp", "\"core/solver/solver.h\"", 1);
  include("the face's values from a stage", "core/solver/heat/a.cpp", "\"core/solver/settings.h\"", 0);
  include("an unknown room of the solver", "core/solver/solver.cpp", "\"core/solver/attic/a.h\"", 1);
  include("relative path", "core/solver/a.cpp", "\"solver.h\"", 1);
  include("climbing path", "plugins/materials/a.cpp", "\"../../core/base/error.h\"", 1);
  include("plugin to core", "plugins/materials/a.cpp", "\"core/base/error.h\"", 1);
  include("plugin to the SDK", "plugins/materials/a.cpp", "<phasesketch/qtentry.h>", 0);
  include("plugin's own header", "plugins/materials/a.cpp", "\"water.h\"", 0);
  include("ui to core", "ui/panels/a.h", "\"core/scene/project.h\"", 0);
  include("ui to app", "ui/panels/a.h", "\"app/editor/x.h\"", 1);
  include("ui upwards", "ui/render/a.h", "\"ui/window/x.h\"", 1);
  include("renderer with widgets", "ui/render/a.cpp", "<QtWidgets/QWidget>", 1);
  include("renderer with OpenGL", "ui/render/a.cpp", "<epoxy/gl.h>", 0);
  include("command line with widgets", "app/cli/main.cpp", "<QApplication>", 1);
  include("command line with the renderer", "app/cli/main.cpp", "\"ui/render/renderer.h\"", 0);
  include("one program to the other", "app/cli/main.cpp", "\"app/editor/x.h\"", 1);
  include("Highway", "core/solver/a.cpp", "\"hwy/highway.h\"", 0);
  include("moc", "ui/panels/a.cpp", "\"a.moc\"", 0);
  row("spaces about the hash", "includes", "core/io/a.cpp", "  #  include  <QString>\n", 1);
  row("no licence", "licence", "core/io/a.cpp", "#pragma once\n", 1);
  const QString spdx = QStringLiteral("// SPDX-License-") + QStringLiteral("Identifier: ");
  row("licence", "licence", "core/io/a.cpp", spdx + "Apache-2.0\n", 0);
  row("licence after a shebang", "licence", "tests/shared/a.sh",
      "#!/bin/bash\n" + spdx.mid(3).prepend("# ") + "Apache-2.0\n", 0);
  row("wrong licence in the SDK", "licence", "core/plugin_api/include/phasesketch/a.h", spdx + "Apache-2.0\n", 1);
  row("licence too late", "licence", "core/io/a.cpp", "\n\n" + spdx + "Apache-2.0\n", 1);
  row("left for later", "words", "core/io/a.cpp", QStringLiteral("// TO") + "DO: more\n", 1);
  row("a longer word", "words", "core/io/a.cpp", QStringLiteral("// TO") + "DOS\n", 0);
  row("somebody's folder", "words", "README.md", QStringLiteral("see /ho") + "me/me/x\n", 1);
  row("colour in the interface", "colours", "ui/panels/a.cpp", "QColor(\"#12ab9f\")\n", 1);
  row("short colour", "colours", "ui/panels/a.cpp", "\"#fff\"\n", 1);
  row("colour with alpha", "colours", "ui/panels/a.cpp", "\"#12ab9f80\"\n", 1);
  row("short colour with alpha", "colours", "ui/panels/a.cpp", "\"#fff8\"\n", 1);
  row("colour in numbers", "colours", "ui/panels/a.cpp", "QColor(18, 0xab, 159)\n", 1);
  row("colour in numbers with alpha", "colours", "ui/panels/a.cpp", "qRgba(18, 171, 159, 128)\n", 1);
  row("a share of a colour", "colours", "ui/panels/a.cpp", "QColor(0, 0, 0, kOpacity)\n", 0);
  row("colour by name", "colours", "ui/panels/a.cpp", "painter.setPen(Qt::darkGray);\n", 1);
  row("no colour by name", "colours", "ui/panels/a.cpp", "Qt::transparent, Qt::Key_Red\n", 0);
  row("all colours", "colours", "ui/rows/colourpicker.cpp", "across.setColorAt(0, Qt::white);\n", 0);
  row("colour in the style sheet", "colours", "resources/theme/style.qss", "QMenu { color: #12ab9f; }\n", 1);
  row("colour in an icon", "colours", "resources/icons/a.svg", "<path fill=\"#12ab9f\"/>\n", 1);
  row("colour in a shader", "colours", "resources/shaders/a.frag", "// as #12ab9f\n", 1);
  row("colour of data", "colours", "resources/theme/maps.json", "\"#12ab9f\"\n", 0);
  row("a directive is no colour", "colours", "ui/panels/a.cpp", "#define x\n#if add\n", 0);
  row("colour elsewhere", "colours", "core/io/a.cpp", "\"#12ab9f\"\n", 0);
  row("a tooltip past its door", "tips", "ui/panels/a.cpp", "QToolTip::showText(at, text, this);\n", 1);
  row("a tooltip by its door", "tips", "ui/theme/plaintext.cpp", "QToolTip::showText(at, text, of);\n", 0);
  row("a question in a box", "boxes", "ui/window/a.cpp", "#include <QtWidgets/QMessageBox>\n", 1);
  row("a box that waits", "boxes", "app/editor/a.cpp", "QProgressDialog dialog(this);\n", 1);
  row("a dialog of our own", "boxes", "ui/window/a.cpp", "class RunDialog : public QDialog {\n", 0);
  row("a dialog that holds the window", "boxes", "ui/window/a.cpp", "  (new RunDialog(form))->open();\n", 1);
  row("a dialog that waits", "boxes", "ui/library/a.cpp", "  if (dialog.exec() == QDialog::Accepted) return;\n", 1);
  row("a modal dialog", "boxes", "ui/window/a.cpp", "  dialog->setWindowModality(Qt::WindowModal);\n", 2);
  row("a question for a file", "boxes", "ui/window/filenames.cpp", "  return dialog.exec();\n", 0);
  row("a menu at its place", "boxes", "ui/window/a.cpp", "  menu.exec(event->globalPos());\n", 0);
  row("a file that is opened", "boxes", "ui/window/a.cpp", "  if (!file.open(QIODevice::ReadOnly)) return;\n", 0);
  row("a box in a test", "boxes", "tests/ui/a.cpp", "QMessageBox box;\n", 0);
  row("a title that is no sentence", "messages", "ui/window/a.cpp",
      "  m_notices.refuse(QStringLiteral(\"Not done\"), why);\n", 1);
  row("a title that is one", "messages", "ui/window/a.cpp",
      "  m_notices.refuse(QStringLiteral(\"Nothing was done.\"), why);\n", 0);
  row("a notice's title that is no sentence", "messages", "ui/window/a.cpp",
      "  bar.show(kTopic, MessageLevel::Warning,\n           QStringLiteral(\"A plugin\"), text);\n", 1);
  row("a notice of a title alone", "messages", "ui/window/a.cpp", "  bar.show(kTopic, MessageLevel::Error, title);\n",
      1);
  row("a notice with more", "messages", "ui/window/a.cpp", "  bar.show(kTopic, MessageLevel::Error, title, text);\n",
      0);
  row("a bare error", "messages", "ui/window/a.cpp", "  log().add(MessageLevel::Error, what, problem);\n", 1);
  row("a shout", "messages", "ui/window/a.cpp", "  say(QStringLiteral(\"Oh no! It is gone.\"));\n", 1);
  row("no shout", "messages", "ui/window/a.cpp", "  if (!a || text != \"b\") return say(\"c\");\n", 0);
  row("missing document", "documents", "core/io/a.cpp", QStringLiteral("// see NOWHERE.") + "md\n", 1);
  row("a name that is taken", "names", "ui/a.h", "namespace ps {\n\nstruct Taken {\n};\n\n}  // namespace ps\n", 1);
  row("a class of that name", "names", "ui/a.h", "namespace ps {\nclass Taken : public QObject {\n", 1);
  row("a name of a template", "names", "ui/a.h", "namespace ps {\ntemplate <class T>\nstruct Taken final {\n", 1);
  row("a name that is its own", "names", "ui/a.cpp", "namespace ps {\nnamespace {\nstruct Taken {\n", 0);
  row("a name after its own", "names", "ui/a.cpp", "namespace ps {\nnamespace {\n}  // namespace\nclass Taken {};\n",
      1);
  row("a name in another room", "names", "ui/a.h", "namespace ps::vr {\nclass Taken {\n", 0);
  row("a member of that name", "names", "ui/a.h", "namespace ps {\nclass Free {\n  struct Taken {\n", 0);
  row("a name that is only mentioned", "names", "ui/a.h", "namespace ps {\nclass Taken;\n", 0);
  row("known document", "documents", "core/io/a.cpp", QStringLiteral("// see KNOWN.") + "md\n", 0);
}

void RepositoryTest::rulesCatchWhatTheyForbid() {
  QFETCH(QString, rule);
  QFETCH(QString, path);
  QFETCH(QString, text);
  QFETCH(int, problems);
  const std::string p = path.toStdString(), t = text.toStdString();
  std::map<std::string, std::string> taken{{"ps::Taken", "core/a.h"}};
  Problems found;
  if (rule == "includes")
    found = ps::rules::includes(p, t);
  else if (rule == "licence")
    found = ps::rules::licence(p, t);
  else if (rule == "words")
    found = ps::rules::words(p, t);
  else if (rule == "colours")
    found = ps::rules::colours(p, t);
  else if (rule == "tips")
    found = ps::rules::tips(p, t);
  else if (rule == "boxes")
    found = ps::rules::boxes(p, t);
  else if (rule == "messages")
    found = ps::rules::messages(p, t);
  else if (rule == "names")
    found = ps::rules::names(p, t, taken);
  else
    found = ps::rules::documents(p, t, {std::string("KNOWN.") + "md"});
  QVERIFY2(static_cast<int>(found.size()) == problems, joined(found).constData());
}

QTEST_GUILESS_MAIN(RepositoryTest)
#include "tst_repository.moc"
