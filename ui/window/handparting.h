// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/bodypieces.h"
#include "ui/document/changeevent.h"
#include "ui/document/matterref.h"

#include <QtCore/QObject>

#include <functional>
#include <memory>
#include <string>
#include <vector>

class QAction;

namespace ps {

class Notices;
class Selection;
class Session;

/// Makes what a hand has cut off a sketched body, by a stroke that erases or cuts, a body of its own: a step of its own
/// after the stroke's, as it takes the engine a moment to say what has come apart. What breaks by itself is left alone,
/// and so are crumbs. Where a stroke leaves too many pieces it tells of them and offers the action.
class HandParting : public QObject {
 public:
  using Test = std::function<bool(const std::string& body)>;
  /// `hasOtherCells`: whether a body's matter is not of the cells that its sketch has. `separate`: the action.
  HandParting(Session& session, Selection& selection, Notices& notices, QAction& separate, Test hasOtherCells,
              QObject* parent = nullptr);

 private:
  /// Where a stroke cuts, and the scene as it was before.
  struct Stroke {
    std::weak_ptr<const MatterKey> matter;
    std::shared_ptr<TiedScene> before = std::make_shared<TiedScene>();  ///< the engine's thread writes it once
    Vector3 low{0, 0, 0}, high{0, 0, 0};                                ///< m, of the box that its cuts lie in
    bool cuts = false;                                                  ///< rather than erases
    std::weak_ptr<StrokeRecord> record{};                               ///< once it has ended
    bool undone = false;
    uint64_t due = 0;  ///< frame in which it is known what a cut has parted; 0: nobody has looked for it yet
    int looks = 0;     ///< for that, while the scene stands still
  };
  using StrokePtr = std::shared_ptr<Stroke>;
  struct Parted {
    Body body;  ///< as it was asked for
    std::vector<CellIndices> pieces;
  };
  static bool reaches(const Stroke& stroke, const TiedScene& after, const std::string& body);
  static std::vector<Parted> partedBy(const Stroke& stroke, const TiedScene& after, const std::vector<Body>& bodies);
  void listen();
  void begin(const MatterRef& matter, const std::vector<api::Touch>& cuts);
  void onChanged(const ChangeEvent& event);
  void dropGivenUp();
  std::vector<Body> candidates() const;
  bool mayPart(const Stroke& stroke) const;
  bool isEarly(Stroke& stroke) const;
  void lookIn(int milliseconds, const StrokePtr& stroke);
  void look(const StrokePtr& stroke);
  void take(const StrokePtr& stroke, const std::shared_ptr<const TiedScene>& after, const std::vector<Body>& bodies);
  void part(const StrokePtr& stroke, const std::vector<Parted>& found);
  void tell(const Body& body, size_t pieces);

  Session& m_session;
  Selection& m_selection;
  Notices& m_notices;
  QAction& m_separate;
  Test m_hasOtherCells;
  std::vector<StrokePtr> m_strokes;  ///< that go on, or have ended and wait for their answer
};

}  // namespace ps
