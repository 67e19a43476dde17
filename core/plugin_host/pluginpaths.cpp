// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/pluginpaths.h"

#include <QDir>
#include <QFileInfo>
#include <QStandardPaths>
#include <QString>

#include <algorithm>

// Set by the room's CMakeLists.txt: where this build tree lies and puts its plugins, and the name of the library
// directory under the install prefix.
#if !defined(PS_BUILD_TREE) || !defined(PS_BUILD_TREE_PLUGINS) || !defined(PS_INSTALL_LIBDIR)
#error "core/plugin_host needs PS_BUILD_TREE, PS_BUILD_TREE_PLUGINS and PS_INSTALL_LIBDIR"
#endif

namespace ps {
namespace {

/// Directory of the running program; without QCoreApplication, which a library user may not have. "" when unknown.
QString programDirectory() {
  const QFileInfo self(QStringLiteral("/proc/self/exe"));
  const QString target = self.symLinkTarget();
  return target.isEmpty() ? QString() : QFileInfo(target).absolutePath();
}

bool isInside(const QString& path, const QString& directory) {
  const QString canonical = QFileInfo(directory).canonicalFilePath();
  const QString inner = QFileInfo(path).canonicalFilePath() + QLatin1Char('/');
  return !canonical.isEmpty() && inner.startsWith(canonical + QLatin1Char('/'));
}

class Directories {
 public:
  void add(const QString& path, const char* origin, bool asked, bool own = false) {
    if (path.isEmpty()) return;
    const QFileInfo info(path);
    const QString canonical = info.exists() ? info.canonicalFilePath() : QDir::cleanPath(info.absoluteFilePath());
    const std::string text = canonical.toStdString();
    const auto known = std::find_if(m_list.begin(), m_list.end(), [&](const auto& d) { return d.path == text; });
    if (known != m_list.end()) {
      own = own || known->own;  // the program's own stay that, whoever names them again
      m_list.erase(known);
    }
    m_list.push_back({text, origin, asked, own});
  }
  std::vector<PluginDirectory> result() { return std::move(m_list); }

 private:
  std::vector<PluginDirectory> m_list;
};

/// What lies beside the program counts first: an installation that happens to lie inside the build tree is one all the
/// same.
void addBuiltIn(Directories& list) {
  const QString program = programDirectory();
  if (program.isEmpty()) return;
  bool found = false;
  for (const char* relative :
       {"../share/phasesketch/plugins", "../lib/phasesketch/plugins", "../" PS_INSTALL_LIBDIR "/phasesketch/plugins"}) {
    const QString path = program + QLatin1Char('/') + QLatin1String(relative);
    if (!QFileInfo(path).isDir()) continue;
    list.add(path, "the installation", false, true);
    found = true;
  }
  if (!found && isInside(program, QStringLiteral(PS_BUILD_TREE)))
    list.add(QStringLiteral(PS_BUILD_TREE_PLUGINS), "the build tree", false, true);
}

}  // namespace

std::vector<PluginDirectory> pluginDirectories(const PluginRegistry::Options& options) {
  Directories list;
  if (options.builtIn) addBuiltIn(list);
  if (options.userDirectory) {
    list.add(QString::fromStdString(userPluginDirectory()), "the user's data directory", false);
  }
  for (const std::string& path : options.extraPaths) list.add(QString::fromStdString(path), "the given paths", true);
  if (options.environment) {
    const QString variable = qEnvironmentVariable("PHASESKETCH_PLUGIN_PATH");
    for (const QString& path : variable.split(QLatin1Char(':'), Qt::SkipEmptyParts))
      list.add(path, "PHASESKETCH_PLUGIN_PATH", true);
  }
  return list.result();
}

std::string userPluginDirectory() {
  const QString data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation);
  return data.isEmpty() ? std::string() : (data + QStringLiteral("/phasesketch/plugins")).toStdString();
}

std::string stateDirectory() {
  QString base = qEnvironmentVariable("XDG_STATE_HOME");
  if (QStandardPaths::isTestModeEnabled()) base = QDir::homePath() + QStringLiteral("/.qttest/state");
  if (!QDir::isAbsolutePath(base)) base = QDir::homePath() + QStringLiteral("/.local/state");
  return (base + QStringLiteral("/phasesketch")).toStdString();
}

}  // namespace ps
