// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/graphsource.h"
#include "ui/graphs/timeplot.h"
#include "ui/session/historyreader.h"

#include <QtCore/QByteArray>
#include <QtCore/QTimer>
#include <QtWidgets/QWidget>

#include <map>
#include <optional>
#include <string>
#include <vector>

class QHBoxLayout;
class QMenu;

namespace ps {

struct GraphLook;
class GraphView;
class PhaseStackView;
class Session;

/// The graphs of the document, live: in columns from the left to the right, those that stand below others in the same
/// column. Those over time share their time axis.
class GraphsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit GraphsPanel(Session& session, QWidget* parent = nullptr);
  /// In the order of the document's graphs.
  std::vector<Plot*> plots() const;
  Plot* plot(const std::string& id) const;  ///< Graph::id; nullptr: there is none
  /// The first graph over time whose first curve is in this SI unit; nullptr where there is none.
  GraphView* valuesIn(const std::string& unit) const;
  PhaseStackView* phases() const;  ///< the first of its kind; nullptr: none
  /// Cursors and zoom of those graphs that have some, by Graph::id.
  std::map<std::string, GraphLook> looks() const;
  void setLooks(const std::map<std::string, GraphLook>& looks);
  void fit();     ///< all, up to now
  void remake();  ///< all anew: units are shown otherwise
  /// The menu of a graph; "": of the place where none is. The caller owns it.
  QMenu* makeMenu(const std::string& id);
  /// A graph as a file: "png", "svg" or "csv".
  QByteArray exported(const std::string& id, const QString& ending) const;
  QString fileName(const std::string& id, const QString& ending) const;  ///< suggested for it
  QSize sizeHint() const override { return {700, 150}; }

 Q_SIGNALS:
  void exportRequested(const QString& id, const QString& ending);

 protected:
  void showEvent(QShowEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  /// What is shown of a graph: its view is made again where that is another.
  struct Shown {
    Graph graph;
    std::vector<GraphSource> sources;  ///< of the curves that there are
    Plot* plot = nullptr;
    TimePlot* overTime = nullptr;      ///< the same, where it is one
    std::optional<uint64_t> unread{};  ///< number of the frame from which on its curves are still to be read
    size_t otherRead = 0;              ///< frames of the compared run that its curves have
  };
  void readHistory();
  std::vector<GraphSource> sourcesOf(const std::vector<std::string>& series) const;
  void follow(std::vector<GraphSource>& sources, std::optional<uint64_t> run) const;
  void showDistributions();
  void rebuild();
  Shown make(const Graph& graph);
  void adopt(TimePlot* plot);
  void prepare(Shown& shown);
  void showCompared(Shown& shown);
  bool readOther(Shown& shown);
  void catchUp();
  void arrange();
  void feed(const std::vector<FrameStats>& frames, const std::vector<size_t>& graphs);
  void setTransitions();
  void setEmptyTexts();
  void setMarkers();
  bool plotsParameters() const;
  void clear();
  const Shown* find(const std::string& id) const;

  Session& m_session;
  HistoryReader m_history;
  QTimer m_catchUp;  ///< runs while curves are still to be read, piece by piece
  QHBoxLayout* m_row;
  std::vector<Shown> m_shown;
  double m_startEnergy = 0;  ///< J, thermal energy at the start
  bool m_started = false, m_matter = false;
};

/// "Temperature", "Speed": what a graph is called where it has no title.
QString titleOf(const Graph& graph, const Project& project, const ParticleFields& fields,
                const PluginRegistry* plugins);

}  // namespace ps
