// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/session/historyreader.h"

#include <QtWidgets/QWidget>

class QLabel;
class QScrollArea;

namespace ps {

class EnergyStackView;
class Session;

/// Where the energy is and where it came from, in kJ since the start, and by how much the balance is open.
class EnergyPanel : public QWidget {
  Q_OBJECT
 public:
  explicit EnergyPanel(Session& session, QWidget* parent = nullptr);
  void append(const FrameStats& stats);
  void clear();
  void setDuration(double seconds);
  QString balanceText() const;
  QString ledgerText() const;  ///< rich text: a row for each place that heat or matter came from or went to

 private:
  void readHistory();
  void take(const FrameStats& stats);
  void showLedger();
  void fitRoom();
  Session& m_session;
  HistoryReader m_history;
  EnergyStackView* m_graph;
  QLabel* m_ledger;
  QScrollArea* m_room;                      ///< for it: its lines do not keep the window high
  bool m_started = false, m_shown = false;  ///< m_shown: there has been matter
  double m_start = 0;
  FrameStats m_last;
};

}  // namespace ps
