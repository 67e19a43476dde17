// SPDX-License-Identifier: Apache-2.0
// The editor: arguments, graphics format, theme, window.
#include "app/editor/arguments.h"
#include "app/editor/displayproblem.h"
#include "app/editor/picture.h"
#include "app/editor/quitsignals.h"
#include "app/editor/quitwatchdog.h"
#include "app/editor/suddenend.h"
#include "core/plugin_host/pluginscan.h"
#include "core/plugin_host/registry.h"
#include "ui/session/settingsformat.h"
#include "ui/theme/theme.h"
#include "ui/viewport/viewport.h"
#include "ui/window/mainwindow.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtWidgets/QApplication>

#include <clocale>
#include <cstdio>

namespace {

constexpr const char* kSample = "ice-on-hot-plate.json";

/// Beside the sources when run from the build tree, else in the installation.
QString samplePath() {
  const QDir program(QCoreApplication::applicationDirPath());
  const bool built = program.canonicalPath().startsWith(QDir(QStringLiteral(PS_BUILD_TREE)).canonicalPath());
  QStringList places{program.filePath(QStringLiteral("../share/phasesketch/projects"))};
  if (built) places.prepend(QStringLiteral(PS_SOURCE_PROJECTS));
  for (const QString& place : places) {
    const QFileInfo file(QDir(place).filePath(QLatin1String(kSample)));
    if (file.isFile()) return file.canonicalFilePath();
  }
  return {};
}

int listPlugins() {
  const ps::PluginRegistry registry;
  for (const ps::PluginInfo& plugin : registry.plugins()) {
    std::printf("%s\t%s\t%s\t%s\t%s\n", plugin.id.c_str(), ps::pluginKindName(plugin.kind), plugin.version.c_str(),
                ps::pluginStateName(plugin.state), plugin.problem.c_str());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ps::servePluginScans(argc, argv);
  QStringList raw;
  for (int i = 1; i < argc; ++i) raw << QString::fromLocal8Bit(argv[i]);
  const ps::EditorArguments early = ps::parseArguments(raw);
  // What needs no display is answered without one.
  if (early.problem.isEmpty() && early.help) return std::fputs(ps::kEditorUsage, stdout) < 0;
  if (early.problem.isEmpty() && early.version) return std::puts("phasesketch " PS_VERSION) < 0;
  if (early.problem.isEmpty() && early.listPlugins) return listPlugins();

  if (const std::string problem = ps::displayProblem(argc, argv); !problem.empty()) {
    std::fprintf(stderr, "phasesketch: %s\n", problem.c_str());
    return 1;
  }
  ps::requestViewFormat();
  QGuiApplication::setHighDpiScaleFactorRoundingPolicy(Qt::HighDpiScaleFactorRoundingPolicy::PassThrough);
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setApplicationName(QStringLiteral("phasesketch"));
  QApplication::setOrganizationName(QStringLiteral("phasesketch"));
  QApplication::setDesktopFileName(QStringLiteral("phasesketch"));  // its icon, under Wayland
  QApplication::setApplicationVersion(QStringLiteral(PS_VERSION));
  ps::keepSettingsWhole();

  const ps::EditorArguments arguments = ps::parseArguments(QApplication::arguments().mid(1));
  if (!arguments.problem.isEmpty()) {
    std::fprintf(stderr, "phasesketch: %s\n%s", qPrintable(arguments.problem), ps::kEditorUsage);
    return 2;
  }
  const bool picture = !arguments.screenshot.isEmpty();
  ps::Theme::apply(application, arguments.dark.value_or(true));
  ps::MainWindow::Options options;
  options.project = arguments.project;
  options.sample = samplePath();
  if (!options.sample.isEmpty()) options.samples = QFileInfo(options.sample).path();
  options.restore = !picture;
  options.session.autosave = !picture;
  options.exitOnBadProject = picture;
  options.dark = arguments.dark.value_or(true);
  options.themeAsked = arguments.dark.has_value();
  const ps::SuddenEnd sudden;  // until the window is gone, and the engine's thread with it
  ps::MainWindow window(options);
  if (arguments.size.isValid()) window.resize(arguments.size);
  window.show();
  std::unique_ptr<ps::PictureByCommand> byCommand;
  if (picture) byCommand = std::make_unique<ps::PictureByCommand>(window, arguments.screenshot, arguments.after);
  // As closing by hand, which keeps unsaved work; where that cannot be done the window stays once, and says so.
  const ps::QuitSignals signalled([&window] {
    if (window.close()) QApplication::exit(0);  // from a dialog's loop too
  });
  window.start();
  const int status = QApplication::exec();
  ps::quitWithin(std::chrono::seconds(10));  // the window has kept what was unsaved
  return status;
}
