// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/autosave.h"

#include <QtCore/QObject>

#include <functional>
#include <optional>

namespace ps {

class Selection;
class Session;

/// Closing and opening again shows the same: what is selected, whether the run goes on, and which moment of it is
/// shown. Tells the autosave what to note of that, and brings it back with the work.
class Resuming : public QObject {
  Q_OBJECT
 public:
  Resuming(Session& session, Selection& selection);
  ~Resuming() override;
  /// By which the cursors of the graphs are asked for and brought back.
  void setReadings(std::function<decltype(LastLook::readings)()> read,
                   std::function<void(const decltype(LastLook::readings)&)> show);

 private:
  LastLook present() const;
  void onOpened();
  void onRun(bool whole);

  Session& m_session;
  Selection& m_selection;
  std::function<decltype(LastLook::readings)()> m_read;
  std::function<void(const decltype(LastLook::readings)&)> m_show;
  std::optional<LastLook> m_left;     ///< of the work that is being reopened
  std::optional<LastLook> m_waiting;  ///< of the work that is open, until its run is there
};

}  // namespace ps
