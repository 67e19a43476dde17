// SPDX-License-Identifier: Apache-2.0
#include "ui/session/documentfiles.h"

#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/projectstate.h"
#include "ui/document/document.h"
#include "ui/document/wallside.h"
#include "ui/session/autosave.h"
#include "ui/session/worker.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QSettings>

#include <string_view>

namespace ps {
namespace {

constexpr int kRecentFiles = 10;
constexpr const char* kRequiredPointer = ":/pluginsRequired/";  // where loadProject() says that one is missing
constexpr const char* kRecentKey = "files/recent";

/// An empty tray to begin with, and what the plugins offer as standard.
Project emptyProject(const PluginRegistry* plugins) {
  Project project;
  project.title = "New scene";
  if (plugins) {
    project.solver.thermalModel = plugins->standard(PluginKind::Thermal);
    SceneMaterial material;
    material.id = material.base = plugins->standard(PluginKind::Material);
    const Material* installed = plugins->material(material.base);
    if (installed) material.label = installed->label;
    if (!material.base.empty()) project.materials.push_back(material);
  }
  for (const WallSide& side : kWallSides) {
    if (std::string_view(side.id) != "lid")
      project.environment.walls.push_back(wallOn(side, {-0.3, 0, -0.3}, {0.3, 0.8, 0.3}));
  }
  project.environment.boundsMinimum = {-0.4, -0.2, -0.4};
  project.environment.boundsMaximum = {0.4, 1, 0.4};
  project.view.camera = ViewCamera();
  return project;
}

/// With its list of required plugins set aside while it is checked, and kept for the next save.
LoadedProject loadWithoutRequired(const QString& path, const PluginRegistry& plugins) {
  LoadedProject loaded = readProject(path.toStdString(), plugins, {"pluginsRequired=[]"});
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return loaded;
  for (const QJsonValue& id :
       QJsonDocument::fromJson(file.readAll()).object()[QLatin1String("pluginsRequired")].toArray())
    loaded.project.pluginsRequired.push_back(id.toString().toStdString());
  return loaded;
}

/// The camera and colour of `seen`, with the pins and unknown keys of `stored`.
ViewState asSeen(ViewState stored, const ViewState& seen) {
  ViewState view = seen;
  view.pinned = std::move(stored.pinned);
  view.unknown = std::move(stored.unknown);
  return view;
}

}  // namespace

DocumentFiles::DocumentFiles(Document& document, Worker& worker, QObject* parent)
    : QObject(parent), m_document(document), m_worker(worker) {}

void DocumentFiles::open(const QString& path) { load(QFileInfo(path).absoluteFilePath(), std::nullopt); }

void DocumentFiles::openAnyway(const QString& path) { load(QFileInfo(path).absoluteFilePath(), std::nullopt, true); }

bool DocumentFiles::lacksRequired(const QString& problem) { return problem.contains(QLatin1String(kRequiredPointer)); }

void DocumentFiles::reopen(const AutosavedSession& session) {
  load(session.copy.isEmpty() ? session.path : session.copy, session);
}

/// `session`: the one that is reopened by it.
void DocumentFiles::load(const QString& path, const std::optional<AutosavedSession>& session, bool anyway) {
  const int request = ++m_request;
  const PluginRegistry* plugins = m_document.plugins();
  if (!plugins) {
    Q_EMIT openFailed(path, QStringLiteral("Plugins are still being loaded. Open it again in a moment."));
    return;
  }
  m_worker.run([this, request, plugins, path, session, anyway] {
    QElapsedTimer clock;
    clock.start();
    LoadedProject loaded;
    QString problem;
    try {
      loaded = anyway ? loadWithoutRequired(path, *plugins) : readProject(path.toStdString(), *plugins);
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    std::vector<ProjectMessage> messages = std::move(loaded.problems);  // it opens nevertheless, to be mended
    messages.insert(messages.end(), loaded.warnings.begin(), loaded.warnings.end());
    const double seconds = static_cast<double>(clock.elapsed()) / 1000;
    if (session && session->copy.isEmpty()) loaded.project.view = asSeen(loaded.project.view, session->view);
    QMetaObject::invokeMethod(this, [this, request, path, session, problem, seconds,
                                     project = std::move(loaded.project), messages = std::move(messages)] {
      if (request != m_request) return;
      if (!problem.isEmpty()) {
        Q_EMIT openFailed(path, problem);
        return;
      }
      QStringList warnings;
      for (const ProjectMessage& message : messages) warnings << QString::fromStdString(message.text);
      const QString documentPath = session ? session->path : path;
      m_document.open(project, documentPath, session && !session->copy.isEmpty());
      if (!documentPath.isEmpty()) addRecent(documentPath);
      if (session) Q_EMIT reopened(*session);
      Q_EMIT opened(documentPath, warnings, seconds);
    });
  });
}

void DocumentFiles::bringBack(const ReplacedWork& work) {
  ++m_request;
  m_document.open(work.project, work.session.path, true);
  Q_EMIT reopened(work.session);
  Q_EMIT opened(work.session.path, {}, 0);
}

void DocumentFiles::newProject() {
  ++m_request;
  m_document.open(emptyProject(m_document.plugins()), {}, false, false);
  Q_EMIT opened({}, {}, 0);
}

void DocumentFiles::save(const QString& path) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  m_worker.run([this, absolute, count = m_document.changeCount(), project = m_document.project(),
                plugins = m_document.plugins()] {
    QString problem, why;
    Project written = project;
    if (written.state && plugins) why = QString::fromStdString(whyStateDoesNotFit(*written.state, written, *plugins));
    if (!why.isEmpty()) written.state = nullptr;
    try {
      saveProject(written, absolute.toStdString());
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, absolute, count, problem, why] {
      if (!problem.isEmpty()) {
        Q_EMIT saveFailed(absolute, problem, m_document.had(count));
        return;
      }
      addRecent(absolute);
      if (!why.isEmpty()) Q_EMIT stateLeftOut(absolute, why);
      Q_EMIT saved(absolute, m_document.saved(absolute, count));
    });
  });
}

QStringList DocumentFiles::recent() {
  QStringList existing;
  for (const QString& path : QSettings().value(QLatin1String(kRecentKey)).toStringList()) {
    if (QFileInfo(path).isFile()) existing << path;
  }
  return existing;
}

void DocumentFiles::addRecent(const QString& path) {
  QStringList paths = recent();
  paths.removeAll(path);
  paths.prepend(path);
  QSettings().setValue(QLatin1String(kRecentKey), QVariant(paths.mid(0, kRecentFiles)));
}

}  // namespace ps
