// SPDX-License-Identifier: Apache-2.0
#include "ui/help/helppages.h"

#include <QtCore/QFile>
#include <QtCore/QRegularExpression>

// Q_INIT_RESOURCE cannot stand in a namespace; the call keeps the linker from dropping a static library's resources.
static void initHelpResources() { Q_INIT_RESOURCE(help); }

namespace ps {
namespace {

constexpr const char* kPages[] = {"first-steps", "scene", "sketching", "tuning",  "timeline",
                                  "graphs",      "vr",    "files",     "numerics"};

/// Its first line is "# Title".
HelpPage readPage(const QString& id) {
  QFile file(QStringLiteral(":/help/") + id);
  if (!file.open(QIODevice::ReadOnly)) return {id, id, {}};
  QString text = QString::fromUtf8(file.readAll());
  static const QRegularExpression mark(QStringLiteral("\\{#([^}]+)\\}\\*\\*([^*]+)\\*\\*")),
      only(QStringLiteral("\\{#[^}]+\\}"));
  QMap<QString, QString> sections;
  for (auto found = mark.globalMatch(text); found.hasNext();) {
    const QRegularExpressionMatch match = found.next();
    for (const QString& about : match.captured(1).split(QLatin1Char(' '))) sections[about] = match.captured(2);
  }
  text.remove(only);
  return {id, text.section(QLatin1Char('\n'), 0, 0).mid(2), text, false, sections};
}

}  // namespace

const std::vector<HelpPage>& writtenHelp() {
  static const std::vector<HelpPage> pages = [] {
    initHelpResources();
    std::vector<HelpPage> all;
    for (const char* id : kPages) all.push_back(readPage(QString::fromLatin1(id)));
    return all;
  }();
  return pages;
}

}  // namespace ps
