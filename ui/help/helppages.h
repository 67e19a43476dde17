// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QMap>
#include <QtCore/QString>

#include <vector>

namespace ps {

/// A page of help: written by hand in Markdown, or made from declarations as HTML. Links are "help:ID" to another page,
/// "action:NAME" to an action of the window; "help:ID#SECTION" leads to a line of a page that says in its file what it
/// is about, by "{#heat cool}" before the bold words that it begins with.
struct HelpPage {
  QString id, title, text;
  bool html = false;
  QMap<QString, QString> sections{};  ///< "heat" and "cool" to "Heat and cool:"
};

/// Those of resources/help/pages, in the order in which they are read.
const std::vector<HelpPage>& writtenHelp();

}  // namespace ps
