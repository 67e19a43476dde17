// SPDX-License-Identifier: Apache-2.0
#include "ui/fitting/fitpanel.h"

#include "core/experiments/probetable.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/graphsource.h"
#include "core/simulation/measure.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/fitting/fitparameterrows.h"
#include "ui/fitting/wantedview.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/theme.h"

#include <QtCore/QTimer>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QCompleter>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QStyle>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <memory>
#include <utility>

namespace ps {
namespace {

constexpr int kControls = 372;    // logical pixels
constexpr double kAtEnd = 1e-3;   // of a range
constexpr double kBeyond = 1.25;  // shown of the time until the wanted curve ends
enum Line { AsItIs, Found };
const QString kHint = QStringLiteral("Draw on the graph how it shall go (Del clears), and choose what may change");

}  // namespace

FitPanel::FitPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_history(session),
      m_view(new WantedView),
      m_quantity(new QComboBox),
      m_candidate(new QComboBox),
      m_rows(new FitParameterRows(session.document())),
      m_search(new QPushButton(QStringLiteral("Find values"))),
      m_cancel(new QPushButton(QStringLiteral("Cancel"))),
      m_apply(new QPushButton(QStringLiteral("Apply"))),
      m_status(new QLabel) {
  m_quantity->setAccessibleName(QStringLiteral("Quantity that is drawn"));
  m_candidate->setObjectName(QStringLiteral("psCandidates"));
  m_candidate->setAccessibleName(QStringLiteral("Add what may change"));
  m_candidate->setEditable(true);
  m_candidate->setInsertPolicy(QComboBox::NoInsert);
  m_candidate->lineEdit()->setPlaceholderText(QStringLiteral("May change: type to find a parameter"));
  m_candidate->completer()->setCompletionMode(QCompleter::PopupCompletion);
  m_candidate->completer()->setFilterMode(Qt::MatchContains);
  m_search->setProperty("primary", true);
  m_search->setToolTip(QStringLiteral("Runs the scene again and again, as long as the curve reaches"));
  m_apply->setToolTip(QStringLiteral("Takes the values over, as one step that undo takes back"));
  m_status->setWordWrap(true);
  m_status->setTextFormat(Qt::PlainText);
  m_view->setEmptyText(QStringLiteral("Press Space to run"));
  m_view->addSeries(QStringLiteral("as it is"));
  m_view->addSeries(QStringLiteral("found"));

  layOut();
  connect(m_quantity, qOverload<int>(&QComboBox::activated), this, &FitPanel::choose);
  connect(m_candidate, qOverload<int>(&QComboBox::activated), this, &FitPanel::addCandidate);
  connect(m_rows, &FitParameterRows::changed, this, &FitPanel::refreshButtons);
  connect(m_view, &WantedView::wantedChanged, this, &FitPanel::refreshButtons);
  connect(m_search, &QPushButton::clicked, this, &FitPanel::search);
  m_cancel->setToolTip(QStringLiteral("Cancel (Esc)"));
  connect(m_cancel, &QPushButton::clicked, this, &FitPanel::cancel);
  connect(m_apply, &QPushButton::clicked, this, &FitPanel::apply);
  connect(&m_job, &FitJob::tried, this, &FitPanel::onTried);
  connect(&m_job, &FitJob::finished, this, &FitPanel::onFinished);
  connect(&m_job, &FitJob::failed, this, [this](const QString& problem) { end(problem, true); });
  connect(&session, &Session::valuesDue, this, &FitPanel::readHistory);
  connect(&session, &Session::ready, this, &FitPanel::readScene);
  connect(&session.document(), &Document::changed, this, &FitPanel::follow);
  readScene();
  say(kHint);
}

void FitPanel::layOut() {
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setMinimumHeight(1);  // a small window has no room for it
  auto* held = new QWidget;
  auto* upper = new QVBoxLayout(held);
  upper->setContentsMargins(0, 0, 0, 0);
  upper->addWidget(m_rows);
  upper->addStretch(1);
  scroll->setWidget(held);

  auto* controls = new QGridLayout;
  controls->setHorizontalSpacing(6);
  controls->setVerticalSpacing(4);
  controls->setColumnStretch(0, 1);
  controls->setRowStretch(2, 1);
  controls->addWidget(m_quantity, 0, 0);
  controls->addWidget(m_search, 0, 1);
  controls->addWidget(m_cancel, 0, 1);
  controls->addWidget(m_candidate, 1, 0);
  controls->addWidget(m_apply, 1, 1);
  controls->addWidget(scroll, 2, 0, 1, 2);
  controls->addWidget(m_status, 3, 0, 1, 2);
  auto* left = new QWidget;
  left->setLayout(controls);
  left->setFixedWidth(kControls);
  controls->setContentsMargins(0, 0, 0, 0);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 4, 6, 4);
  row->setSpacing(8);
  row->addWidget(left);
  row->addWidget(m_view, 1);
}

void FitPanel::follow(const ChangeEvent& event) {
  if (std::holds_alternative<ProjectOpened>(event)) {
    m_job.cancel();
    m_abandoned = m_job.isRunning();
    m_found.reset();
    m_view->setWanted({});
    m_drawn = {};
    readScene();
    say(kHint);
  } else if (std::holds_alternative<ProbesChanged>(event)) {
    readScene();
  } else if (std::holds_alternative<MaterialsChanged>(event) || std::holds_alternative<WallsChanged>(event) ||
             std::holds_alternative<BodyChanged>(event) || std::holds_alternative<PortChanged>(event) ||
             std::holds_alternative<TracksChanged>(event)) {
    readCandidates();
  }
}

void FitPanel::readScene() {
  const Project& project = m_session.document().project();
  std::vector<std::string> names;
  for (const Probe& probe : project.probes) names.push_back(probeTitle(probe, m_session.fields()));
  const std::vector<std::string> titles = columnTitles(names);
  m_drawables.clear();
  for (size_t k = 0; k < project.probes.size(); ++k) {
    const Probe& probe = project.probes[k];
    const Quantity* quantity = m_session.fields().quantity(probe.quantity);
    if (!quantity) continue;
    const GraphSource source(probeSource(probe.id), project, m_session.fields());
    m_drawables.push_back({probeSource(probe.id) + ' ' + probe.quantity,
                           titles[2 + k],  // behind the two clocks
                           QStringLiteral("%1: %2").arg(nameOf(probe), QString::fromStdString(quantity->label)),
                           SeriesUnit(quantity->unit), [source](const FrameStats& stats) { return source(stats); }});
  }
  // What every frame tells and tables have a column of.
  const auto whole = [this](const std::string& key, const std::string& column) {
    const GraphSource source(frameSource(key), {}, m_session.fields());
    m_drawables.push_back({column, column, QStringLiteral("All matter: ") + QString::fromStdString(source.label()),
                           SeriesUnit(source.unit()), [source](const FrameStats& stats) { return source(stats); }});
  };
  for (const char* phase : {"solid", "melting", "liquid", "boiling", "gas"})
    whole(std::string(phase) + "_mass", std::string(phase) + ".mass[kg]");
  whole("temperature", "all.temperature[K]");
  m_quantity->clear();
  for (const Drawable& drawable : m_drawables) m_quantity->addItem(drawable.name);
  m_view->setDuration(project.duration);
  readCandidates();
  const auto same = std::find_if(m_drawables.begin(), m_drawables.end(),
                                 [this](const Drawable& drawable) { return drawable.source == m_drawn.source; });
  choose(same == m_drawables.end() ? 0 : static_cast<int>(same - m_drawables.begin()));
}

/// Every number of the scene that can be looked for, points of curves too; what is pinned first.
void FitPanel::readCandidates() {
  const Project& project = m_session.document().project();
  const PluginRegistry* plugins = m_session.plugins();
  m_candidates.clear();
  const auto offer = [&](const FitTarget& target) {
    if (whyNotFitted(project, plugins, target).empty()) m_candidates.push_back(target);
  };
  std::vector<Address> addresses;
  for (const std::string& pinned : project.view.pinned) {
    if (const auto address = Address::parse(pinned)) addresses.push_back(*address);
  }
  for (const Address& address : allAddresses(project, plugins)) {
    const bool seen = std::string_view(address.key).starts_with("color_");
    if (!seen && std::find(addresses.begin(), addresses.end(), address) == addresses.end())
      addresses.push_back(address);
  }
  for (const Address& address : addresses) {
    if (!declarationOf(project, plugins, address)) continue;
    const auto offerBoth = [&](std::optional<size_t> point) {
      offer({address, point});
      const Track* track = findTrack(project.tracks, FitTarget(address, point).trackText());
      for (size_t key = 0; track && key < track->keys.size(); ++key) offer({address, point, key});
    };
    offerBoth(std::nullopt);
    const Value value = valueAt(project, plugins, address);
    const auto* response = std::get_if<Response>(&value);
    const size_t points = response && response->kind == Response::Kind::Curve ? response->points.size() : 0;
    for (size_t point = 0; point < points; ++point) offerBoth(point);
  }
  m_candidate->clear();
  for (const FitTarget& target : m_candidates) m_candidate->addItem(m_rows->nameOf(target));
  m_candidate->setCurrentIndex(-1);
}

void FitPanel::addCandidate(int index) {
  if (index < 0 || index >= static_cast<int>(m_candidates.size())) return;
  const QString problem = m_rows->add(m_candidates[static_cast<size_t>(index)]);
  m_candidate->setCurrentIndex(-1);
  if (!problem.isEmpty()) say(problem, true);
}

void FitPanel::choose(int drawable) {
  if (drawable < 0 || drawable >= static_cast<int>(m_drawables.size())) return;
  const Drawable& chosen = m_drawables[static_cast<size_t>(drawable)];
  m_quantity->setCurrentIndex(drawable);
  if (m_job.isRunning()) return;  // what it shows is of what is searched for
  const bool another = chosen.source != m_drawn.source;
  m_drawn = chosen;
  m_view->setTitle(m_drawn.name);
  m_view->setUnit(m_drawn.unit.shown);
  if (another) {
    m_found.reset();
    m_view->setWanted({});
    m_view->clear();
    m_history.rewind();
  }
  readHistory();
  refreshButtons();
}

/// The run that was searched from stays until another begins.
void FitPanel::readHistory() {
  if (!m_drawn.value || m_job.isRunning()) return;
  const HistoryReader::Piece piece = m_history.read();
  if (piece.more) QTimer::singleShot(0, this, &FitPanel::readHistory);
  if (piece.begins) {
    m_view->clear();
    if (m_found) say(kHint);
    m_found.reset();
    refreshButtons();
  }
  if (m_found) return;
  for (const FrameStats& stats : piece.frames)
    m_view->append(AsItIs, stats.time, m_drawn.unit.of(m_drawn.value(stats)));
}

void FitPanel::search() {
  if (m_job.isRunning() || !m_drawn.value || !m_session.isReady()) return;
  m_task = FitTask{m_drawn.column, m_view->wanted(), m_rows->parameters()};
  for (double& value : m_task.wanted.value) value = m_drawn.unit.stored(value);
  m_found.reset();
  m_view->setRange(0, kBeyond * m_task.wanted.time.back());
  m_session.pause();  // the scene would take half of the threads
  m_job.start(std::make_shared<const Project>(m_session.document().project()), m_session.registry(), m_task);
  say(QStringLiteral("Run 1 of at most %1 …").arg(m_task.mostRuns));
  refreshButtons();
}

bool FitPanel::cancel() {
  if (!m_job.isRunning()) return false;
  m_job.cancel();
  m_givesUp = true;
  say(QStringLiteral("Giving up…"));  // the frame that runs ends first
  return true;
}

void FitPanel::showCourse(const FitTrial& trial) {
  if (trial.run == 1) m_view->clear();
  const int line = trial.run == 1 ? AsItIs : Found;
  if (line == Found) m_view->clearSeries(Found);
  for (size_t k = 0; k < trial.course.time.size(); ++k)
    m_view->append(line, trial.course.time[k], m_drawn.unit.of(trial.course.value[k]));
}

QString FitPanel::missed(double error) const {
  // A difference of temperatures is one in kelvin.
  const bool kelvin = m_drawn.unit.zero != 0;
  return amountText(m_drawn.unit.scale * error, kelvin ? QStringLiteral("K") : m_drawn.unit.shown, 3);
}

void FitPanel::onTried(const FitTrial& trial) {
  if (m_abandoned) return;
  if (trial.run == 1) m_missedBefore = trial.error;
  if (trial.isBest) {
    showCourse(trial);
    m_found = trial;
  }
  if (m_givesUp) return;
  say(QStringLiteral("Run %1 of at most %2: missed by %3 so far, %4 as it is")
          .arg(trial.run)
          .arg(m_task.mostRuns)
          .arg(missed(m_found->error), missed(m_missedBefore)));
}

void FitPanel::onFinished(const FitResult& result) {
  if (result.runs == 0) return end(QStringLiteral("Given up in the first run"));
  if (!m_found || m_found->run == 1) {
    m_found.reset();
    return end(
        QStringLiteral("No run came closer than the scene as it is, which misses by %1").arg(missed(m_missedBefore)));
  }
  QStringList values;
  for (size_t k = 0; k < m_task.parameters.size(); ++k) {
    const FitParameter& p = m_task.parameters[k];
    const double value = m_found->values[k], edge = kAtEnd * (p.maximum - p.minimum);
    const bool atEnd = value < p.minimum + edge || value > p.maximum - edge;
    values << QStringLiteral("%1 %2%3").arg(m_rows->nameOf(p.target), m_rows->shown(p.target, value),
                                            atEnd ? QStringLiteral(", where its range ends") : QString());
  }
  end(QStringLiteral("%1. Missed by %2, %3 as it is%4")
          .arg(values.join(QStringLiteral(", ")), missed(m_found->error), missed(m_missedBefore),
               result.stopped ? QStringLiteral("; ended early") : QString()));
}

/// A search has ended: what came and went in the scene meanwhile is looked up again.
void FitPanel::end(const QString& text, bool problem) {
  m_givesUp = false;
  if (std::exchange(m_abandoned, false))
    m_found.reset();
  else
    say(text, problem);
  readScene();
  refreshButtons();
  Q_EMIT ended();
}

/// Where the parameter is one: the value that was found for it. Returns "" or why it has it not.
QString FitPanel::applyKey(size_t parameter) {
  Document& document = m_session.document();
  const FitTarget& target = m_task.parameters[parameter].target;
  const auto track = Address::parse(target.trackText());
  if (!target.key || !track) return {};
  const double time = document.track(*track)->keys[*target.key].time;
  return document.moveKey(*track, *target.key, time, m_found->values[parameter]);
}

void FitPanel::apply() {
  if (!m_found || m_job.isRunning()) return;
  Document& document = m_session.document();
  std::vector<std::pair<Address, Value>> values;
  for (size_t k = 0; k < m_task.parameters.size(); ++k) {
    const std::string why = whyNotFitted(document.project(), document.plugins(), m_task.parameters[k].target);
    if (!why.empty()) return say(QString::fromStdString(why) + QStringLiteral("; nothing was changed"), true);
  }
  const Project changed = withValues(document.project(), *document.plugins(), m_task, m_found->values);
  for (const FitParameter& p : m_task.parameters) {
    if (!p.target.key) values.emplace_back(p.target.address, valueAt(changed, document.plugins(), p.target.address));
  }
  const QString title = QStringLiteral("values found for a drawn curve");
  document.undoStack().beginMacro(title);
  QString problem = values.empty() ? QString() : document.setParameters(values, title);
  for (size_t k = 0; k < m_task.parameters.size() && problem.isEmpty(); ++k) problem = applyKey(k);
  document.undoStack().endMacro();
  if (!problem.isEmpty()) {
    document.undoStack().undo();
    return say(problem, true);
  }
  m_found.reset();
  m_view->clearSeries(AsItIs);  // the run that is shown goes on there
  m_history.rewind();
  readHistory();
  say(QStringLiteral("Taken over; press Home to run it from the start"));
  refreshButtons();
}

void FitPanel::say(const QString& text, bool problem) {
  m_status->setText(text);
  m_status->setToolTip(text);
  m_status->setProperty("role", problem ? "error" : "text2");
  m_status->style()->unpolish(m_status);
  m_status->style()->polish(m_status);
}

void FitPanel::refreshButtons() {
  const bool running = m_job.isRunning();
  m_search->setVisible(!running);
  m_cancel->setVisible(running);
  m_search->setEnabled(m_session.isReady() && !m_view->wanted().time.empty() && !m_rows->parameters().empty());
  m_apply->setEnabled(!running && m_found.has_value());
  for (QWidget* input : {static_cast<QWidget*>(m_quantity), static_cast<QWidget*>(m_candidate),
                         static_cast<QWidget*>(m_rows), static_cast<QWidget*>(m_view)})
    input->setEnabled(!running);
}

}  // namespace ps
