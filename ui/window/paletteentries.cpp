// SPDX-License-Identifier: Apache-2.0
#include "ui/window/paletteentries.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/rows/rowvalue.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/window/actions.h"
#include "ui/window/welcome.h"

#include <QtGui/QAction>

#include <set>

namespace ps {
namespace {

QString valueText(Document& document, const Address& address, const api::ParameterDeclaration& declaration) {
  const Value value = document.value(address);
  if (const auto* number = std::get_if<double>(&value)) return formatValue(declaration, *number);
  if (const auto* toggle = std::get_if<bool>(&value)) return *toggle ? QStringLiteral("on") : QStringLiteral("off");
  if (const auto* choice = std::get_if<std::string>(&value)) {
    const QStringList labels = choiceLabels(document.project(), document.plugins(), address, declaration);
    const auto index = choiceNames(declaration).indexOf(QString::fromStdString(*choice));
    return index < 0 || labels.isEmpty() ? choiceLabel(QString::fromStdString(*choice)) : labels[index];
  }
  return formatValue(declaration, std::get<Response>(value).at(293.15));
}

}  // namespace

std::vector<PaletteEntry> paletteEntries(Session& session, Selection& selection, const Actions& actions,
                                         const std::function<void(const Address&)>& reveal) {
  std::vector<PaletteEntry> entries;
  for (QAction* action : actions.all()) {
    if (action->objectName().isEmpty() || !action->objectName().contains(QLatin1Char('.')) || !action->isEnabled() ||
        action->text().isEmpty())
      continue;
    QString where = action->objectName().section(QLatin1Char('.'), 0, 0);
    where = where.left(1).toUpper() + where.mid(1);
    entries.push_back({cleanText(*action), where, action->shortcut().toString(QKeySequence::NativeText),
                       action->property(kWords).toString(), [action] { action->trigger(); },
                       action->property(kReplaces).toBool()});
  }
  Document& document = session.document();
  for (const Address& address : allAddresses(document.project(), document.plugins())) {
    const auto* declaration = document.declaration(address);
    if (!declaration) continue;
    const QString label = QString::fromUtf8(declaration->label);
    entries.push_back({awayLabel(document.project(), address, label), ownerLabel(document.project(), address),
                       valueText(document, address, *declaration),
                       QString::fromUtf8(declaration->group) + QLatin1Char(' ') +
                           QString::fromStdString(address.text()).replace(QLatin1Char('_'), QLatin1Char(' ')),
                       [reveal, address] { reveal(address); }});
  }
  if (const PluginRegistry* plugins = session.plugins()) {
    std::set<std::string> present;
    for (const SceneMaterial& material : document.project().materials) present.insert(material.base);
    for (const std::string& base : plugins->ids(PluginKind::Material)) {
      if (present.count(base)) continue;
      const std::string& label = plugins->material(base)->label;
      entries.push_back(
          {QStringLiteral("Add material %1").arg(QString::fromStdString(label.empty() ? base : label)),
           QStringLiteral("Materials"),
           {},
           QString::fromStdString(base),
           [&session, &selection, base] { selection.pickMaterial(session.document().addMaterial(base)); }});
    }
  }
  return entries;
}

}  // namespace ps
