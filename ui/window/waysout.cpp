// SPDX-License-Identifier: Apache-2.0
#include "ui/window/waysout.h"

#include "core/matter/material.h"
#include "core/plugin_host/pluginfolder.h"
#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/missingplugins.h"
#include "ui/panels/inspector.h"
#include "ui/panels/messagespage.h"
#include "ui/panels/pluginpage.h"
#include "ui/panels/wayout.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/session.h"
#include "ui/session/worker.h"
#include "ui/theme/plaintext.h"
#include "ui/window/actions.h"
#include "ui/window/filenames.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <QtCore/QPointer>
#include <QtCore/QStandardPaths>
#include <QtGui/QAction>
#include <QtGui/QCursor>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>
#include <QtWidgets/QStackedWidget>

#include <algorithm>

namespace ps {
namespace {

const QString kTopic = QStringLiteral("missing"), kTaken = QStringLiteral("taken instead"),
              kInstalling = QStringLiteral("installing"), kTried = QStringLiteral("tried again");

/// Of those that are in a folder; "" where the plugin is among them and sound.
QString whyNotIn(const std::vector<PluginInfo>& list, const QString& folder, const std::string& id) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const PluginInfo& info) { return info.id == id; });
  if (found != list.end()) return QString::fromStdString(found->problem);
  QStringList ids;
  for (const PluginInfo& info : list) ids << QString::fromStdString(info.id);
  return QStringLiteral("%1 has no plugin “%2”%3. Choose the folder that its file lies in.")
      .arg(folder, QString::fromStdString(id),
           ids.isEmpty() ? QString() : QStringLiteral(", only %1").arg(ids.join(QStringLiteral(", "))));
}

}  // namespace

WaysOut::WaysOut(const Parts& parts, QObject* parent) : QObject(parent), m_parts(parts) {
  connect(&parts.inspector, &Inspector::wayOutWanted, this, &WaysOut::follow);
  if (parts.messages) connect(parts.messages, &MessagesPage::linkActivated, this, &WaysOut::follow);
  connect(&parts.session.files(), &DocumentFiles::opened, this, &WaysOut::tellMissing);
  // Undo brings what is missing back, and redo takes it away; what was said of either is over.
  connect(&parts.session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    const auto* materials = std::get_if<MaterialsChanged>(&event);
    if (!materials || !materials->other) return;
    m_parts.notices.bar().close(kTaken);
    showMissing();
  });
  connect(&parts.plugins, &PluginPage::folderWanted, this, [this](const std::string& id) {
    const QString folder = folderToUse(&m_parts.actions.window(),
                                       QStringLiteral("Folder of the plugin “%1”").arg(QString::fromStdString(id)),
                                       QStandardPaths::writableLocation(QStandardPaths::DownloadLocation));
    if (!folder.isEmpty()) installFrom(folder, id);
  });
  connect(&parts.plugins, &PluginPage::tried, this, &WaysOut::showTried);
}

void WaysOut::follow(const QString& link) {
  const auto after = [&](const char* prefix) { return link.mid(QLatin1String(prefix).size()).toStdString(); };
  if (link.startsWith(QLatin1String(wayout::kTryAgain))) return m_parts.plugins.tryAgain(after(wayout::kTryAgain));
  if (link.startsWith(QLatin1String(wayout::kPlugin))) return findPlugin(after(wayout::kPlugin));
  if (link.startsWith(QLatin1String(wayout::kAction))) {
    QAction* action = m_parts.actions.find(link.mid(QLatin1String(wayout::kAction).size()));
    if (action && action->isEnabled()) action->trigger();
    return;
  }
  if (!link.startsWith(QLatin1String(wayout::kMaterial))) return;
  QMenu* menu = materialsFor(after(wayout::kMaterial));
  if (menu) menu->popup(QCursor::pos());
}

void WaysOut::tellMissing() {
  showMissing();
  const Document& document = m_parts.session.document();
  if (!document.plugins()) return;
  for (const MissingPlugin& missing : missingPlugins(document.project(), *document.plugins())) {
    m_parts.session.log().add(MessageLevel::Warning, document.title(),
                              missingText(missing, document.project(), *document.plugins()),
                              wayout::linksOf(missing, *document.plugins()));
  }
}

void WaysOut::showMissing() {
  NoticeBar& bar = m_parts.notices.bar();
  bar.close(kTopic);
  const Document& document = m_parts.session.document();
  if (!document.plugins()) return;
  const std::vector<MissingPlugin> all = missingPlugins(document.project(), *document.plugins());
  if (all.empty()) return;
  std::vector<NoticeBar::Button> buttons;
  for (const MessageLink& link : wayout::linksOf(all.front(), *document.plugins()))
    buttons.push_back({link.text, [this, target = link.target] { follow(target); }});
  bar.show(kTopic, MessageLevel::Warning,
           all.size() == 1 ? QStringLiteral("A plugin is missing, the rest runs.")
                           : QStringLiteral("%1 plugins are missing, the rest runs.").arg(all.size()),
           missingText(all.front(), document.project(), *document.plugins()), std::move(buttons));
}

void WaysOut::findPlugin(const std::string& id) {
  m_parts.centre.setCurrentWidget(&m_parts.plugins);
  m_parts.plugins.find(id);
}

QMenu* WaysOut::materialsFor(const std::string& material) {
  const Document& document = m_parts.session.document();
  const PluginRegistry* plugins = document.plugins();
  const auto& materials = document.project().materials;
  const auto found =
      std::find_if(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == material; });
  if (!plugins || found == materials.end()) return nullptr;
  std::vector<std::pair<QString, std::string>> choices;
  for (const std::string& id : plugins->ids(PluginKind::Material)) {
    if (id != found->base) choices.emplace_back(pluginLabel(plugins, id), id);
  }
  std::sort(choices.begin(), choices.end(),
            [](const auto& a, const auto& b) { return a.first.localeAwareCompare(b.first) < 0; });
  auto* menu = new QMenu(&m_parts.actions.window());
  menu->setAttribute(Qt::WA_DeleteOnClose);
  for (const auto& [label, base] : choices)
    menu->addAction(asButtonText(label), this, [this, material, base = base] { useOther(material, base); });
  return menu;
}

void WaysOut::useOther(const std::string& material, const std::string& base) {
  Session& session = m_parts.session;
  const auto& materials = session.document().project().materials;
  const auto found =
      std::find_if(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == material; });
  if (found == materials.end()) return;
  const QString gone = QString::fromStdString(found->base);
  const bool atOnce = session.appliesAtOnce();
  session.document().useOtherMaterial(material, base);
  NoticeBar& bar = m_parts.notices.bar();
  const QString text =
      QStringLiteral("What was of “%1” is of “%2” now. Undo brings back the old one with all its values.")
          .arg(gone, ownerLabel(session.document().project(), {Owner::Material, material, ""}));
  session.log().add(MessageLevel::Ok, session.document().title(), text);
  if (atOnce) return bar.show(kTaken, MessageLevel::Ok, QStringLiteral("Another material is used."), text);
  bar.show(kTaken, MessageLevel::Info, QStringLiteral("Another material is used from the start on."), text,
           {{QStringLiteral("Back to the start"), [this] {
               m_parts.notices.bar().close(kTaken);
               m_parts.session.reset();
             }}});
}

void WaysOut::showTried(const std::string& id, const QString& problem) {
  showMissing();
  NoticeBar& bar = m_parts.notices.bar();
  const QString name = QString::fromStdString(id);
  if (problem.isEmpty())
    return bar.show(kTried, MessageLevel::Info, QStringLiteral("The plugin “%1” came back.").arg(name),
                    QStringLiteral("Start the program again to have it; your work is kept meanwhile."),
                    {{QStringLiteral("Close the program"), [this] { m_parts.actions.window().close(); }}});
  bar.show(kTried, MessageLevel::Warning, QStringLiteral("The plugin “%1” failed again.").arg(name), problem,
           {{QStringLiteral("Try again"), [this, id] { m_parts.plugins.tryAgain(id); }}});
}

void WaysOut::installFrom(const QString& folder, const std::string& id) {
  m_parts.session.worker().run([folder, id, ways = QPointer<WaysOut>(this), &session = m_parts.session] {
    QString problem, place;
    try {
      const std::vector<PluginInfo> list = pluginsIn(folder.toStdString());
      problem = whyNotIn(list, folder, id);
      const auto found = std::find_if(list.begin(), list.end(), [&](const PluginInfo& info) { return info.id == id; });
      if (problem.isEmpty()) place = QString::fromStdString(installPlugin(*found));
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(&session, [ways, id, problem, place] {
      if (ways) ways->showInstalled(id, problem, place);
    });
  });
}

void WaysOut::showInstalled(const std::string& id, const QString& problem, const QString& place) {
  const bool done = problem.isEmpty();
  const QString name = QString::fromStdString(id);
  const QString title = done ? QStringLiteral("The plugin “%1” is installed.").arg(name)
                             : QStringLiteral("The plugin “%1” was not installed.").arg(name);
  const QString text =
      done
          ? QStringLiteral("Start the program again to have it; your work is kept meanwhile. It lies at %1.").arg(place)
          : problem;
  m_parts.session.log().add(done ? MessageLevel::Ok : MessageLevel::Warning, title, text);
  m_parts.plugins.showNews(title + QLatin1Char(' ') + text);
  std::vector<NoticeBar::Button> buttons;
  if (done) buttons.push_back({QStringLiteral("Close the program"), [this] { m_parts.actions.window().close(); }});
  m_parts.notices.bar().show(kInstalling, done ? MessageLevel::Info : MessageLevel::Warning, title, text,
                             std::move(buttons));
}

}  // namespace ps
