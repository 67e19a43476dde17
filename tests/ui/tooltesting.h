// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"
#include "core/simulation/enginethread.h"
#include "ui/document/document.h"
#include "ui/session/scenelink.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"

#include <QtCore/QFile>
#include <QtCore/QObject>
#include <QtCore/QTemporaryDir>
#include <QtTest/QTest>

#include <memory>
#include <optional>

namespace ps {

/// What tests of tools share that have a scene which runs, and no window.
class ToolTest : public QObject {
 protected:
  void open(const Project& project) {
    m_document = std::make_unique<Document>();
    m_document->setPlugins(m_plugins.get());
    m_engine = std::make_unique<EngineThread>(*m_plugins, [] {});
    m_link = std::make_unique<SceneLink>(*m_document, *m_engine);
    m_selection = std::make_unique<Selection>(*m_document);
    m_tools = std::make_unique<Toolbox>(*m_document, *m_selection);
    m_tools->attach(m_link.get());
    m_document->open(project, {}, false, false);
  }
  void close() {
    m_tools.reset();
    m_selection.reset();
    m_link.reset();
    m_engine.reset();
    m_document.reset();
  }
  /// From above and in front, at a place of the scene as it is.
  Pointer at(const Vector3& place) const {
    Pointer pointer;
    pointer.ray.origin = Vector3(0, 1, 1);
    pointer.ray.direction = (place - pointer.ray.origin).normalized();
    pointer.forward = Vector3(0, -1, -1).normalized();
    pointer.scene = m_engine->snapshot();
    return pointer;
  }
  /// Plugins with one of the fixtures, under the name of what it is to do.
  std::unique_ptr<PluginRegistry> fixtureNamed(const QString& behaviour, const QString& library) {
    m_folder.emplace();
    [&] {
      QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QLatin1Char('/') + library,
                          m_folder->filePath(behaviour + QStringLiteral(".so"))));
    }();
    PluginRegistry::Options options;
    options.extraPaths = {m_folder->path().toStdString()};
    return std::make_unique<PluginRegistry>(options);
  }
  void take(const char* brush, double radius = 0.05) {
    m_tools->activate(kBrushTool);
    m_tools->takeBrush(brush);
    BrushSettings settings = m_tools->brush();
    settings.radius = radius;
    m_tools->setBrush(settings);
  }

  std::optional<QTemporaryDir> m_folder;  ///< of the fixture
  std::unique_ptr<PluginRegistry> m_plugins = std::make_unique<PluginRegistry>();
  std::unique_ptr<Document> m_document;
  std::unique_ptr<EngineThread> m_engine;
  std::unique_ptr<SceneLink> m_link;
  std::unique_ptr<Selection> m_selection;
  std::unique_ptr<Toolbox> m_tools;
};

}  // namespace ps
