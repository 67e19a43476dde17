// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/curvefit.h"
#include "ui/document/changeevent.h"
#include "ui/fitting/fitjob.h"
#include "ui/graphs/seriesunit.h"
#include "ui/session/historyreader.h"

#include <QtWidgets/QWidget>

#include <functional>
#include <optional>
#include <string>
#include <vector>

class QComboBox;
class QLabel;
class QPushButton;

namespace ps {

class FitParameterRows;
class Session;
class WantedView;

/// Draw the result: how a quantity shall go is drawn over how it went, what may change is chosen, values are looked for
/// in the background, and what was found is taken over as one undo step.
class FitPanel : public QWidget {
  Q_OBJECT
 public:
  explicit FitPanel(Session& session, QWidget* parent = nullptr);
  /// What can be drawn: a column of the table of probes.
  struct Drawable {
    std::string source;  ///< what it is, whatever it is called
    std::string column;  ///< see columnTitles()
    QString name;
    SeriesUnit unit{"1"};
    std::function<double(const FrameStats&)> value;
  };
  WantedView* view() const { return m_view; }
  FitParameterRows* parameters() const { return m_rows; }
  const std::vector<Drawable>& drawables() const { return m_drawables; }
  void choose(int drawable);
  QSize sizeHint() const override { return {700, 150}; }

 public Q_SLOTS:
  void search();
  bool cancel();  ///< false where none runs
  void apply();
  QString applyKey(size_t parameter);

 Q_SIGNALS:
  void ended();  ///< a search, however

 private:
  void layOut();
  void follow(const ChangeEvent& event);
  void readScene();
  void readHistory();
  void readCandidates();
  void addCandidate(int index);
  void showCourse(const FitTrial& trial);
  void onTried(const FitTrial& trial);
  void onFinished(const FitResult& result);
  void end(const QString& text, bool problem = false);
  void say(const QString& text, bool problem = false);
  void refreshButtons();
  QString missed(double error) const;

  Session& m_session;
  HistoryReader m_history;
  std::vector<Drawable> m_drawables;
  Drawable m_drawn;  ///< what is drawn; of the search while one runs
  std::vector<FitTarget> m_candidates;
  FitJob m_job;
  FitTask m_task;  ///< of the search that runs, or has ended
  double m_missedBefore = 0;
  bool m_abandoned = false;  ///< it is of a project that has gone
  bool m_givesUp = false;    ///< somebody has cancelled it
  std::optional<FitTrial> m_found;
  WantedView* m_view;
  QComboBox *m_quantity, *m_candidate;
  FitParameterRows* m_rows;
  QPushButton *m_search, *m_cancel, *m_apply;
  QLabel* m_status;
};

}  // namespace ps
