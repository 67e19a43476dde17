// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/graphspanel.h"

#include "core/simulation/enginethread.h"
#include "core/simulation/parametercourse.h"
#include "ui/document/document.h"
#include "ui/graphs/distributionview.h"
#include "ui/graphs/graphexport.h"
#include "ui/graphs/graphmenu.h"
#include "ui/graphs/graphview.h"
#include "ui/graphs/seeking.h"
#include "ui/graphs/seriesunit.h"
#include "ui/graphs/stackview.h"
#include "ui/session/autosave.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/transitions.h"
#include "ui/session/wording.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QMimeData>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QDropEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

const QString kDrag = QStringLiteral("Drag a probe here to plot it");
const QString kNotRun = QStringLiteral("Press Space to run");
const QString kNoMatter = QStringLiteral("No matter yet");
const QString kAllHeld = QStringLiteral("All matter is held in place; what is held is not measured");

bool isOfFrames(Graph::Kind kind) { return kind != Graph::Kind::Histogram && kind != Graph::Kind::Profile; }

}  // namespace

QString titleOf(const Graph& graph, const Project& project, const ParticleFields& fields,
                const PluginRegistry* plugins) {
  if (!graph.title.empty()) return QString::fromStdString(graph.title);
  if (!isOfFrames(graph.kind)) {
    const FieldPtr field = fields.find(graph.field);
    const QString name = field ? QString::fromStdString(field->label) : QString::fromStdString(graph.field);
    return graph.kind == Graph::Kind::Histogram
               ? QStringLiteral("Particles by ") + name.left(1).toLower() + name.mid(1)
               : name + QStringLiteral(" along ") + QLatin1Char(static_cast<char>('x' + graph.axis));
  }
  if (graph.kind == Graph::Kind::Phases) return QStringLiteral("Mass by phase");
  if (graph.kind == Graph::Kind::Energy) return QStringLiteral("Heat since the start");
  // Of one field, its name; else the one curve's, or the kind of its unit.
  QString name;
  for (const std::string& series : graph.series) {
    const GraphSource source(series, project, fields, plugins);
    if (!source) continue;
    const auto probe = std::find_if(project.probes.begin(), project.probes.end(),
                                    [&](const Probe& p) { return p.id == probeOfSource(series); });
    const Quantity* quantity = probe == project.probes.end() ? nullptr : fields.quantity(probe->quantity);
    const QString own = QString::fromStdString(source.unit() == "K" && !source.parameter() ? "Temperature"
                                               : quantity && quantity->field               ? quantity->field->label
                                               : quantity                                  ? quantity->label
                                                                                           : source.label());
    if (!name.isEmpty() && name != own) return QStringLiteral("Probes");
    name = own;
  }
  return name;
}

GraphsPanel::GraphsPanel(Session& session, QWidget* parent)
    : QWidget(parent), m_session(session), m_history(session), m_row(new QHBoxLayout(this)) {
  m_row->setContentsMargins(6, 4, 6, 4);
  m_row->setSpacing(8);
  setAcceptDrops(true);
  m_catchUp.setSingleShot(true);
  connect(&m_catchUp, &QTimer::timeout, this, &GraphsPanel::catchUp);
  connect(&session, &Session::valuesDue, this, &GraphsPanel::readHistory);
  connect(&session, &Session::totalsDue, this, &GraphsPanel::showDistributions);
  connect(&session.transitions(), &Transitions::changed, this, &GraphsPanel::setTransitions);
  for (const auto signal : {&RecordedView::comparedChanged, &RecordedView::runsChanged}) {
    connect(&session.recorded(), signal, this, [this] {
      for (Shown& shown : m_shown) showCompared(shown);
    });
  }
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    const bool opened = std::holds_alternative<ProjectOpened>(event);
    if (opened) {
      clear();
      for (Shown& shown : m_shown) delete shown.plot;
      m_shown.clear();
    }
    if (opened || std::holds_alternative<GraphsChanged>(event) || std::holds_alternative<ProbesChanged>(event))
      rebuild();
    const bool owners = std::holds_alternative<BodyChanged>(event) || std::holds_alternative<PortChanged>(event) ||
                        std::holds_alternative<WallsChanged>(event) || std::holds_alternative<MaterialsChanged>(event);
    if (owners && plotsParameters()) rebuild();
    if (std::holds_alternative<MarkersChanged>(event)) setMarkers();
    for (const Shown& shown : m_shown) {
      if (shown.overTime && std::holds_alternative<AboutChanged>(event))
        shown.overTime->setDuration(m_session.document().project().duration);
    }
  });
  if (!session.isReady()) return;
  rebuild();  // made later than the project came
  readHistory();
}

/// Whose owners may come, go and be called something else.
bool GraphsPanel::plotsParameters() const {
  for (const Shown& shown : m_shown) {
    for (const std::string& series : shown.graph.series) {
      if (series.starts_with(kParameterSource)) return true;
    }
  }
  return false;
}

std::vector<Plot*> GraphsPanel::plots() const {
  std::vector<Plot*> all;
  for (const Shown& shown : m_shown) all.push_back(shown.plot);
  return all;
}

const GraphsPanel::Shown* GraphsPanel::find(const std::string& id) const {
  const auto found = std::find_if(m_shown.begin(), m_shown.end(), [&](const Shown& s) { return s.graph.id == id; });
  return found == m_shown.end() ? nullptr : &*found;
}

Plot* GraphsPanel::plot(const std::string& id) const { return find(id) ? find(id)->plot : nullptr; }

GraphView* GraphsPanel::valuesIn(const std::string& unit) const {
  for (const Shown& shown : m_shown) {
    if (!shown.sources.empty() && shown.sources.front().unit() == unit) return qobject_cast<GraphView*>(shown.plot);
  }
  return nullptr;
}

PhaseStackView* GraphsPanel::phases() const { return findChild<PhaseStackView*>(); }

std::map<std::string, GraphLook> GraphsPanel::looks() const {
  std::map<std::string, GraphLook> all;
  for (const Shown& shown : m_shown) {
    const Plot& plot = *shown.plot;
    GraphLook look{{plot.reading(0), plot.reading(1)}, {}};
    if (!plot.isFitted()) look.range = plot.range();
    for (const ValueAxis& axis : plot.axes()) look.values.push_back(axis.zoom);
    while (!look.values.empty() && !look.values.back()) look.values.pop_back();
    if (look != GraphLook()) all[shown.graph.id] = look;
  }
  return all;
}

void GraphsPanel::setLooks(const std::map<std::string, GraphLook>& looks) {
  for (const auto& [id, look] : looks) {
    Plot* of = plot(id);
    if (!of) continue;
    for (size_t which = 0; which < look.cursors.size(); ++which) of->setReading(which, look.cursors[which]);
    if (look.range) of->setRange(look.range->first, look.range->second);
    for (size_t axis = 0; axis < look.values.size(); ++axis) of->setValueRange(axis, look.values[axis]);
  }
}

void GraphsPanel::fit() {
  for (const Shown& shown : m_shown) shown.plot->fit();
}

void GraphsPanel::remake() {
  for (const Shown& gone : std::exchange(m_shown, {})) {
    if (gone.plot) gone.plot->deleteLater(), gone.plot->hide();
  }
  rebuild();
}

/// Views stay where the graph is of the same kind: what is zoomed stays so.
void GraphsPanel::rebuild() {
  std::vector<Shown> before = std::exchange(m_shown, {});
  const Project& project = m_session.document().project();
  for (const Graph& graph : m_session.document().graphs()) {
    const auto old = std::find_if(before.begin(), before.end(), [&](const Shown& s) {
      return s.plot && s.graph.id == graph.id && s.graph.kind == graph.kind;
    });
    Shown shown = old == before.end() ? make(graph) : *old;
    const std::vector<std::string> seriesBefore = shown.graph.series;
    if (old != before.end()) old->plot = nullptr;
    shown.graph = graph;
    std::vector<GraphSource> sources = sourcesOf(graph.series);
    const bool same = old != before.end() && seriesBefore == graph.series && shown.sources == sources;
    if (!same) shown.sources = std::move(sources);
    shown.plot->setTitle(titleOf(graph, project, m_session.fields(), m_session.document().plugins()));
    if (!same) prepare(shown);
    if (auto* view = qobject_cast<GraphView*>(shown.plot)) view->setDifference(graph.difference);
    shown.plot->setLogarithmic(graph.logarithmic);
    if (!same && shown.overTime && m_started) shown.unread = 0;
    m_shown.push_back(std::move(shown));
  }
  catchUp();
  for (const Shown& gone : before) {
    if (gone.plot) gone.plot->deleteLater(), gone.plot->hide();
  }
  arrange();
  setMarkers();
  setTransitions();
  setEmptyTexts();
  showDistributions();
  update();
}

GraphsPanel::Shown GraphsPanel::make(const Graph& graph) {
  Shown shown{graph, {}, nullptr, nullptr, {}, 0};
  if (graph.kind == Graph::Kind::Time)
    shown.overTime = new GraphView(this);
  else if (graph.kind == Graph::Kind::Phases)
    shown.overTime = new PhaseStackView(this);
  else if (graph.kind == Graph::Kind::Energy)
    shown.overTime = new EnergyStackView(this);
  shown.plot = shown.overTime ? static_cast<Plot*>(shown.overTime) : new DistributionView(this);
  if (shown.overTime) adopt(shown.overTime);
  const std::string id = graph.id;
  connect(shown.plot, &Plot::menuRequested, this, [this, id](const QPoint& at) {
    QMenu* menu = makeMenu(id);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->popup(at);
  });
  connect(shown.plot, &Plot::titleEdited, this, [this, id](const QString& title) {
    m_session.document().editGraph(id, QStringLiteral("title of a graph"),
                                   [&](Graph& edited) { edited.title = title.trimmed().toStdString(); });
  });
  connect(shown.plot, &Plot::sourceDropped, this,
          [this, id](const QString& source) { m_session.document().plot(id, source.toStdString()); });
  return shown;
}

/// What is done to the time axis of one is done to all.
void GraphsPanel::adopt(TimePlot* plot) {
  seekByClicks(*plot, m_session.recorded());
  connect(plot, &Plot::rangeChanged, this, [this](double first, double last) {
    for (const Shown& other : m_shown) {
      if (other.overTime) other.overTime->setRange(first, last);
    }
  });
  connect(plot, &Plot::fitted, this, [this] {
    for (const Shown& other : m_shown) {
      if (other.overTime) other.overTime->fit();
    }
  });
  for (const Shown& other : m_shown) {
    if (other.overTime && !other.overTime->isFitted())
      plot->setRange(other.overTime->range().first, other.overTime->range().second);
  }
}

/// Without samples.
void GraphsPanel::prepare(Shown& shown) {
  if (!shown.overTime) return;
  shown.overTime->clear();
  if (auto* view = qobject_cast<GraphView*>(shown.plot)) {
    view->removeAllSeries();
    for (const GraphSource& source : shown.sources)
      view->addSeries(QString::fromStdString(source.label()), SeriesUnit(source.unit()).shown);
    showCompared(shown);
  }
  shown.overTime->setDuration(m_session.document().project().duration);
  shown.overTime->setPresentTime(m_session.now());
}

void GraphsPanel::arrange() {
  while (QLayoutItem* column = m_row->takeAt(0)) {
    while (QLayoutItem* item = column->layout()->takeAt(0)) delete item;
    delete column;
  }
  QVBoxLayout* column = nullptr;
  for (const Shown& shown : m_shown) {
    if (!column || !shown.graph.below) {
      column = new QVBoxLayout;
      column->setSpacing(4);
      m_row->addLayout(column, 1);
    }
    column->addWidget(shown.plot, 1);
    shown.plot->show();
  }
  m_row->activate();
}

void GraphsPanel::setTransitions() {
  const double melts = m_session.transitions().melts(), boils = m_session.transitions().boils();
  const SeriesUnit kelvin("K");
  std::vector<ReferenceLine> lines;
  if (std::isfinite(melts) && melts > 0) lines.push_back({kelvin.of(melts), QStringLiteral("melts")});
  if (std::isfinite(boils)) lines.push_back({kelvin.of(boils), QStringLiteral("boils")});
  for (const Shown& shown : m_shown) {
    auto* view = qobject_cast<GraphView*>(shown.plot);
    if (view) view->setReferenceLines(view->axes().front().unit == kelvin.shown ? lines : std::vector<ReferenceLine>());
  }
}

void GraphsPanel::setMarkers() {
  std::vector<std::pair<double, QString>> markers;
  for (const Marker& marker : m_session.document().project().markers)
    markers.emplace_back(marker.time, QString::fromStdString(marker.name));
  for (const Shown& shown : m_shown) {
    if (shown.overTime) shown.overTime->setMarkers(markers);
  }
}

void GraphsPanel::setEmptyTexts() {
  const SnapshotPtr snapshot = m_session.snapshot();
  const bool particles = snapshot && !snapshot->id.empty();
  for (const Shown& shown : m_shown) {
    const bool nothing = shown.graph.kind == Graph::Kind::Time && shown.sources.empty();
    shown.plot->setEmptyText(nothing ? kDrag : !m_started || m_matter ? kNotRun : particles ? kAllHeld : kNoMatter);
  }
}

QMenu* GraphsPanel::makeMenu(const std::string& id) {
  auto* menu = new QMenu(this);
  const Shown* shown = find(id);
  GraphMenu(m_session.document(), m_session.fields()).fill(*menu, shown ? &shown->graph : nullptr);
  if (!shown) return menu;
  menu->addAction(QStringLiteral("Rename"), this, [this, id] {
    if (const Shown* now = find(id)) now->plot->editTitle();
  });
  menu->addSeparator();
  menu->addAction(QStringLiteral("Fit"), this, [this, id] {
    if (const Shown* now = find(id)) Q_EMIT now->plot->fitted(), now->plot->fit();
  });
  for (const char* ending : {"png", "svg", "csv"}) {
    const QString name = QString::fromLatin1(ending);
    menu->addAction(QStringLiteral("Export as %1…").arg(name.toUpper()), this,
                    [this, id, name] { Q_EMIT exportRequested(QString::fromStdString(id), name); });
  }
  return menu;
}

QString GraphsPanel::fileName(const std::string& id, const QString& ending) const {
  const Shown* shown = find(id);
  QString title = shown ? shown->plot->title().toLower() : QString();
  for (QChar& c : title) c = c.isLetterOrNumber() ? c : QLatin1Char('-');  // of a path nothing
  return (title.isEmpty() ? QStringLiteral("graph") : title) + QLatin1Char('.') + ending;
}

/// What histograms and profiles did not follow while they were hidden.
void GraphsPanel::showEvent(QShowEvent*) { showDistributions(); }

void GraphsPanel::paintEvent(QPaintEvent*) {
  if (!m_shown.empty()) return;
  QPainter painter(this);
  paintText(painter, rect(), Qt::AlignCenter, kDrag, Theme::font(TextRole::Normal), Theme::current()[Token::Muted]);
}

void GraphsPanel::contextMenuEvent(QContextMenuEvent* event) {
  QMenu* menu = makeMenu({});
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->popup(event->globalPos());
}

void GraphsPanel::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasFormat(QLatin1String(kSourceMime))) event->acceptProposedAction();
}

/// Beside the others, a graph of its own.
void GraphsPanel::dropEvent(QDropEvent* event) {
  event->acceptProposedAction();
  m_session.document().plot({}, event->mimeData()->data(QLatin1String(kSourceMime)).toStdString());
}

}  // namespace ps
