// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/wayout.h"

#include "ui/document/document.h"
#include "ui/rows/parameterrow.h"

#include <QtCore/QStringList>

namespace ps::wayout {

QString action(const char* name) { return QLatin1String(kAction) + QLatin1String(name); }

bool isWayOut(const QString& link) {
  return link.startsWith(QLatin1String(kAction)) || link.startsWith(QLatin1String(kPlugin)) ||
         link.startsWith(QLatin1String(kMaterial));
}

std::vector<MessageLink> linksOf(const MissingPlugin& missing) {
  std::vector<MessageLink> links{
      {QStringLiteral("Find plugin…"), QLatin1String(kPlugin) + QString::fromStdString(missing.id)}};
  if (missing.kind == PluginKind::Material) {
    links.push_back(
        {QStringLiteral("Use another material…"), QLatin1String(kMaterial) + QString::fromStdString(missing.material)});
  }
  return links;
}

QString note(const MissingPlugin& missing, const Document& document) {
  QStringList links;
  for (const MessageLink& link : linksOf(missing)) {
    // What stands in brackets ends at the first that closes; ids have neither.
    links << QStringLiteral("[%1](%2)").arg(link.text, link.target);
  }
  return asNote(missingText(missing, document.project(), *document.plugins())) + QLatin1Char(' ') +
         links.join(QStringLiteral(" · "));
}

}  // namespace ps::wayout
