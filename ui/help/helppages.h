// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

#include <vector>

namespace ps {

/// A page of help: written by hand in Markdown, or made from declarations as HTML. Links are "help:ID" to another page,
/// "action:NAME" to an action of the window.
struct HelpPage {
  QString id, title, text;
  bool html = false;
};

/// Those of resources/help/pages, in the order in which they are read.
const std::vector<HelpPage>& writtenHelp();

}  // namespace ps
