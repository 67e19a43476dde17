// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/arrange.h"
#include "ui/window/pinactions.h"

#include <QtCore/QString>

#include <functional>

class QMenu;

namespace ps {

class Actions;
class MaterialsPanel;
class Notices;
class Selection;
class Session;

/// What is done with all that is selected at once: copied, cut, pasted, doubled, deleted, grouped, shown alone,
/// arranged. Each is one undo step.
class ThingActions {
 public:
  ThingActions(Session& session, Selection& selection, const MaterialsPanel& materials, const Actions& actions,
               Notices& notices);
  void makeMenu(QMenu* menu);
  void makeArrangeMenu(QMenu* menu);

 private:
  bool ofMaterials() const;
  Project excerpt() const;
  QString selectedName() const;
  bool copy();
  void paste();
  void duplicate();
  void remove(const char* title);
  void group();
  void ungroup();
  void isolate();
  /// `note`: "" or what of the selected takes no part, whatever it is.
  void arrange(const QString& title, const std::function<Placement(Placement, const MatterBoxes&)>& change,
               const QString& note = {});
  void drop();
  void insert(Project things, const QString& title, const QString& refusal, bool beside);
  MatterBoxes matter() const;

  Session& m_session;
  Selection& m_selection;
  const MaterialsPanel& m_materials;
  const Actions& m_actions;
  Notices& m_notices;
  PinActions m_pins;
};

}  // namespace ps
