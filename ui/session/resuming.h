// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/autosave.h"

#include <QtCore/QObject>

#include <functional>
#include <optional>

namespace ps {

class Selection;
class Session;

/// Closing and opening again shows the same: what is selected, whether the run goes on, which moment of it is shown,
/// how graphs and legend are zoomed, and the brush. Tells the autosave what to note of that, and brings it back with
/// the work.
class Resuming : public QObject {
  Q_OBJECT
 public:
  Resuming(Session& session, Selection& selection);
  ~Resuming() override;
  /// By which graphs, legend and brush are asked for and brought back.
  void setLook(std::function<void(LastLook&)> add, std::function<void(const LastLook&)> show);

 private:
  LastLook present() const;
  void onOpened();
  void onRun(bool whole);

  Session& m_session;
  Selection& m_selection;
  std::function<void(LastLook&)> m_add;
  std::function<void(const LastLook&)> m_show;
  std::optional<LastLook> m_left;     ///< of the work that is being reopened
  std::optional<LastLook> m_waiting;  ///< of the work that is open, until its run is there
};

}  // namespace ps
