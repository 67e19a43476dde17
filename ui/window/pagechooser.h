// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QObject>

namespace ps {

class Inspector;
class Selection;
class Toolbox;
class WindowLayout;

/// Brings the page to the front that shows what has been selected, picked or taken in hand.
class PageChooser : public QObject {
  Q_OBJECT
 public:
  PageChooser(Selection& selection, Toolbox& tools, Inspector& inspector, WindowLayout& layout,
              QObject* parent = nullptr);
  /// Jumps to a parameter's row: chooses its owner and tab, scrolls, gives it the focus where asked. False: there is
  /// none.
  bool reveal(const Address& address, bool focus = true);

 private:
  void onSelection();
  void onTool();
  Selection& m_selection;
  Toolbox& m_tools;
  Inspector& m_inspector;
  WindowLayout& m_layout;
};

}  // namespace ps
