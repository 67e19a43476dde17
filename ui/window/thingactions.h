// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/arrange.h"
#include "ui/window/pinactions.h"

#include <QtCore/QObject>
#include <QtCore/QString>

#include <functional>
#include <optional>

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
  void removeMaterials(const char* title);
  void group();
  void ungroup();
  void isolate();
  /// `note`: "" or what of the selected takes no part, whatever it is.
  void arrange(const QString& title, const std::function<Placement(Placement, const MatterBoxes&)>& change,
               const QString& note = {});
  void drop();
  /// Where things come to stand: where they are if nothing else is there, beside all, or where they are in any case.
  enum class Where { IfFree, Beside, Here };
  std::optional<Vector3> wayTo(const Placement& things, Where where) const;
  Placement insert(Project things, const QString& title, const QString& refusal, Where where);
  MatterBoxes matter() const;

  Session& m_session;
  Selection& m_selection;
  const MaterialsPanel& m_materials;
  const Actions& m_actions;
  Notices& m_notices;
  PinActions m_pins;

  /// Copies that were made last: while they stay selected, the next ones go on as these were put elsewhere.
  struct Copies {
    Placement from, made;
    bool goOn = false;  ///< they did so themselves
  };
  std::optional<Copies> m_copies;
  QObject m_watch;  ///< of the selection
};

}  // namespace ps
