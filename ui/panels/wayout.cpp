// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/wayout.h"

#include "ui/document/document.h"
#include "ui/rows/parameterrow.h"

#include <QtCore/QStringList>

#include <algorithm>

namespace ps::wayout {

QString action(const char* name) { return QLatin1String(kAction) + QLatin1String(name); }

bool isWayOut(const QString& link) {
  return link.startsWith(QLatin1String(kAction)) || link.startsWith(QLatin1String(kPlugin)) ||
         link.startsWith(QLatin1String(kMaterial)) || link.startsWith(QLatin1String(kTryAgain));
}

std::vector<MessageLink> linksOf(const MissingPlugin& missing, const PluginRegistry& plugins) {
  const std::vector<PluginInfo>& all = plugins.plugins();
  const bool held = std::any_of(all.begin(), all.end(), [&](const PluginInfo& info) {
    return info.id == missing.id && info.state == PluginInfo::State::Quarantined;
  });
  const QString id = QString::fromStdString(missing.id);
  std::vector<MessageLink> links{held ? MessageLink{QStringLiteral("Try again"), QLatin1String(kTryAgain) + id}
                                      : MessageLink{QStringLiteral("Find plugin…"), QLatin1String(kPlugin) + id}};
  if (missing.kind == PluginKind::Material) {
    links.push_back(
        {QStringLiteral("Use another material…"), QLatin1String(kMaterial) + QString::fromStdString(missing.material)});
  }
  return links;
}

QString note(const MissingPlugin& missing, const Document& document) {
  QStringList links;
  for (const MessageLink& link : linksOf(missing, *document.plugins())) {
    // What stands in brackets ends at the first that closes; ids have neither.
    links << QStringLiteral("[%1](%2)").arg(link.text, link.target);
  }
  return asNote(missingText(missing, document.project(), *document.plugins())) + QLatin1Char(' ') +
         links.join(QStringLiteral(" · "));
}

}  // namespace ps::wayout
