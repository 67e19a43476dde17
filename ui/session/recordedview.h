// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/runrecord.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <optional>
#include <utility>
#include <vector>

namespace ps {

class Session;

/// Which moment of a run is shown: the newest, or a frame of its record. What a hand asks for while another frame is
/// unpacked waits, and of what waits the last is meant: a worker unpacks. Playing the record simulates nothing.
class RecordedView : public QObject {
  Q_OBJECT
 public:
  explicit RecordedView(Session& session);

  /// nullptr: the newest.
  const SnapshotPtr& shown() const { return m_shown; }
  bool isActive() const { return m_shown != nullptr; }
  RunRecord::Extent extent() const;
  /// The frame next to a time; the run pauses.
  void showAt(double seconds);
  /// So many frames on or back from the one that is shown; beyond the last of them is the newest state.
  void step(int frames);
  /// The next key, marker or end of the record after the time that is shown, or the one before.
  void stepToMark(bool forward);
  void showNewest();
  /// From the frame that is shown, or from the first one where that is the newest. At the end of the record it begins
  /// again where it loops; else the run goes on, up to the end of the scene.
  void play();
  void pause();
  bool playing() const { return m_clock.isActive(); }
  /// Whether to play is to play the record: a frame of it is shown, or it loops.
  bool isMeant() const;
  void setLoop(bool on);
  bool loops() const { return m_loop; }
  void setSpeed(double speed);  ///< s of the run per s
  double speed() const { return m_speed; }
  /// The run goes on from the frame that is shown.
  void continueFromHere();
  /// Runs that were left by that, the oldest first.
  std::vector<RunRecord::EarlierRun> earlier() const;
  /// At its end; the present run is then an earlier one.
  void goOnWith(uint64_t run);
  void forgetRun(uint64_t run);
  void forgetDisk();  ///< what of all runs lies there
  void renameRun(uint64_t run, const QString& name);
  QString runName(uint64_t run) const;  ///< "Run 1" where nobody gave it one
  /// What an earlier run measured stands beside this one's curves; nothing: none does. A run that was just left does.
  void compare(std::optional<uint64_t> run);
  std::optional<uint64_t> compared() const { return m_compared; }
  const std::vector<FrameStats>& comparedStats() const { return m_comparedStats; }
  /// Whether the compared run's matter, as it was at the time that is shown, is to be seen in the scene. On where none
  /// is compared compares the last one; "" or why there is none.
  QString setGhost(bool on);
  bool hasGhost() const { return m_hasGhost; }
  /// It; nullptr: there is none, or the compared run has none at that time.
  const SnapshotPtr& ghost() const { return m_ghost; }
  /// Snapshots of another run, or of this one from an earlier frame on.
  void follow(const SnapshotPtr& newest);

 Q_SIGNALS:
  void changed();
  void playingChanged();
  void paceChanged();  ///< another speed, or whether it loops
  void comparedChanged();
  void runsChanged();  ///< deleted, in part or as wholes, named, or told apart otherwise
  void ghostChanged();

 private:
  void want(uint64_t frame);
  void advance();
  void unpack();
  void setShown(SnapshotPtr snapshot);
  void followGhost();
  void setGhostShown(SnapshotPtr ghost);
  const RunRecord* record() const;

  Session& m_session;
  SnapshotPtr m_shown;
  std::optional<uint64_t> m_wanted;  ///< number of a frame
  bool m_busy = false;
  QTimer m_clock;  ///< runs while the record plays
  QElapsedTimer m_since;
  double m_at = 0, m_speed = 1;  ///< s of the run, s of it per s
  bool m_loop = false;
  uint64_t m_revision = 0;
  std::optional<uint64_t> m_compared;  ///< number of a run
  std::vector<FrameStats> m_comparedStats;
  bool m_hasGhost = false, m_ghostBusy = false;
  std::pair<uint64_t, double> m_ghostAt;  ///< run and time in s of what was unpacked last
  SnapshotPtr m_ghost;
  uint64_t m_left = 0;   ///< number of the run that was left last
  QString m_continuing;  ///< what to tell when the engine has gone there
};

}  // namespace ps
