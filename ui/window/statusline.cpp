// SPDX-License-Identifier: Apache-2.0
#include "ui/window/statusline.h"

#include "core/simulation/enginethread.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/rowmodels.h"
#include "ui/session/autosave.h"
#include "ui/session/documentfiles.h"
#include "ui/session/recordedview.h"
#include "ui/session/runwork.h"
#include "ui/session/scenelink.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/viewport/viewport.h"

#include <QtCore/QDateTime>
#include <QtGui/QHelpEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {
constexpr int kHeight = 24;
constexpr const char* kFileTip = "When the project was saved last, or a copy of it was kept for recovery.";
constexpr int kSaying = 30'000;       // ms
constexpr double kSilent = 5;         // s without a frame while playing, after which that is said
constexpr double kClearly = 1.2;      // times as slow as the stage that is named, to be named instead
constexpr double kSmooth = 0.08;      // share of a new frame in the shown mean, so that digits can be read
constexpr double kSmoothTool = 0.25;  // the same of what a tool feels, which one wants to see at once
constexpr double kLeastTold = 0.01;   // W, K/m: what fades from there on is gone
constexpr double kBehind = 2;         // spacings behind its hand from which a tool is said to be

/// That whose name takes most room.
size_t widestStage() {
  size_t widest = 0;
  double most = 0;
  for (size_t stage = 0; stage < static_cast<size_t>(Stage::Count); ++stage) {
    const double width =
        textWidth(QString::fromLatin1(stageName(static_cast<Stage>(stage))), Theme::font(TextRole::Small));
    if (width > most) widest = stage, most = width;
  }
  return widest;
}
}  // namespace

StatusLine::StatusLine(Session& session, Viewport* view, QWidget* parent)
    : QWidget(parent), m_session(session), m_view(view) {
  setFixedHeight(kHeight);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(QStringLiteral("Status"));
  follow();
  refresh();
  // Where nothing comes from the engine any more, nothing else asks to be shown.
  m_sinceValues.start();
  m_watch.setInterval(1000);
  connect(&m_watch, &QTimer::timeout, this, [this] {
    if (m_session.playing()) refresh();
  });
  m_watch.start();
  m_saying.setSingleShot(true);
  m_saying.setInterval(kSaying);
  connect(&m_saying, &QTimer::timeout, this, [this] { say({}); });
}

void StatusLine::setHeadset(const QString& state) {
  if (m_headset == state) return;
  m_headset = state;
  refresh();
}

void StatusLine::setWork(const QString& stage, int percent) {
  m_stage = stage;
  m_percent = percent;
  refresh();
}

void StatusLine::say(const QString& sentence, MessageLevel level) {
  m_said = sentence;
  m_saidLevel = level;
  m_saying.start();
  refresh();
}

/// Who paints a block makes it a sketch, with the values that a sketch has: no word would make them look lost.
void StatusLine::tellOfSketches(const StrokeChanged& event) {
  if (!event.done) return;
  for (const SceneEdit& edit : event.stroke->edits) {
    const auto* body = std::get_if<BodyEdit>(&edit);
    if (!body || !body->before || !body->after) continue;
    if (std::holds_alternative<VoxelShape>(body->before->shape) ||
        !std::holds_alternative<VoxelShape>(body->after->shape))
      continue;
    say(QStringLiteral("“%1” is a sketch now, of cells: it has no measures and angles any more. Undo brings them back.")
            .arg(QString::fromStdString(body->after->name)));
  }
}

/// A value acts where the run stands, also while an earlier moment of it is shown: nothing there would say so. Of what
/// waits for the start its row does.
void StatusLine::noteRecorded(const ChangeEvent& event) {
  const auto* parameter = std::get_if<ParameterChanged>(&event);
  const bool acts =
      parameter ? !m_session.document().actsAtReset(parameter->address) : std::holds_alternative<TracksChanged>(event);
  if (acts && m_session.recorded().isActive()) m_recordedStays = true;
}

/// Once for each step of the history: those of a drag are one.
void StatusLine::tellOfRecorded() {
  const int64_t step = m_session.document().undoStack().position();
  const bool other = std::exchange(m_step, step) != step;
  const SnapshotPtr shown = m_session.recorded().shown(), newest = m_session.newest();
  if (!std::exchange(m_recordedStays, false) || !other || !shown || !newest) return;
  m_saidOfRecorded = QStringLiteral(
                         "It acts where the run stands, at %1; what is recorded stays as it was. Continue "
                         "from here runs on from %2 with it.")
                         .arg(clockText(newest->stats.time), clockText(shown->stats.time));
  say(m_saidOfRecorded);
}

void StatusLine::follow() {
  connect(&m_session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (const auto* stroke = std::get_if<StrokeChanged>(&event)) tellOfSketches(*stroke);
    noteRecorded(event);
  });
  connect(&m_session.document().undoStack(), &History::indexChanged, this, &StatusLine::tellOfRecorded);
  connect(&m_session.recorded(), &RecordedView::changed, this, [this] {  // of another moment it is true no more
    const QString told = std::exchange(m_saidOfRecorded, QString());
    if (!told.isEmpty() && told == m_said) say({});
  });
  for (const auto signal : {&Session::ready, &Session::valuesDue, &Session::playingChanged})
    connect(&m_session, signal, this, &StatusLine::refresh);
  for (const auto signal : {&Session::valuesDue, &Session::madeOrNot})
    connect(&m_session, signal, this, [this] { m_sinceValues.start(); });
  followWork();
  followHome();
  connect(&m_session, &Session::happened, this, [this](const EngineEvent& event) {
    const bool late = event.kind == EngineEvent::Kind::Late;
    m_late = late ? pluginLabel(m_session.plugins(), event.message) : QString();
  });
  connect(&m_session, &Session::playingChanged, this, [this] { m_sinceValues.start(); });
  connect(&m_session.document(), &Document::changed, this, &StatusLine::refresh);
  const auto say = [this](const QString& what, const QTime& time) {
    m_fileText = what + time.toString(QStringLiteral("HH:mm"));
    refresh();
  };
  const DocumentFiles& files = m_session.files();
  connect(&files, &DocumentFiles::opened, this, [this] {
    m_fileText.clear();
    refresh();
  });
  connect(&files, &DocumentFiles::saved, this, [say](const QString&, bool present) {
    if (present) say(QStringLiteral("Saved "), QTime::currentTime());
  });
  if (m_session.autosave()) {
    connect(m_session.autosave(), &Autosave::autosaved, this,
            [say](const QDateTime& time) { say(QStringLiteral("Autosaved "), time.time()); });
  }
  if (m_view) connect(m_view, &Viewport::glReady, this, &StatusLine::refresh);
}

/// How long it will last is told with the progress alone.
void StatusLine::followWork() {
  const auto tell = [this](double& of, double left) {
    of = left;
    refresh();
  };
  connect(&m_session, &Session::making, this,
          [=, this](const QString&, double, double left) { tell(m_makingLeft, left); });
  connect(&m_session, &Session::madeOrNot, this, [=, this] { tell(m_makingLeft, -1); });
  connect(&m_session.work(), &RunWork::working, this,
          [=, this](const QString&, double, double left) { tell(m_workLeft, left); });
  connect(&m_session.work(), &RunWork::ended, this, [=, this] { tell(m_workLeft, -1); });
}

/// What was drawn stays, what was erased, painted or heated while it ran does not: no word would make that look lost.
void StatusLine::followHome() {
  const auto follow = [this] {
    connect(m_session.link(), &SceneLink::strokesLeft, this, [this](size_t strokes) {
      const QString text =
          (strokes == 1 ? QStringLiteral("One edit made while it ran belongs to that run")
                        : QStringLiteral("%1 edits made while it ran belong to that run").arg(strokes)) +
          QStringLiteral(": the start is as it was. Save with the present state keeps such edits, before Home.");
      m_session.log().add(MessageLevel::Info, QStringLiteral("Back to the start"), text);
      say(text);
    });
  };
  if (m_session.link())
    follow();
  else
    connect(&m_session, &Session::ready, this, follow);
}

void StatusLine::refresh() {
  State state;
  state.ready = m_session.isReady();
  state.playing = m_session.playing();
  state.snapshot = m_session.snapshot();
  state.failed = m_session.isBroken() || (state.snapshot && (state.snapshot->flags & kTakenBack));
  state.realTime = m_session.engine() ? m_session.engine()->realTimeFactor() : 0;
  if (m_view) {
    state.drawMilliseconds = m_view->drawMilliseconds();
    state.graphics = m_view->graphics();
  }
  const auto making = m_session.isReady() ? m_session.engine()->making() : std::nullopt;
  state.making = making ? static_cast<int>(100 * making->done) : -1;
  const bool own = m_session.work().isBusy();
  state.working = own ? m_session.work().percent() : m_percent;
  state.work = (own ? m_session.work().stage() : m_stage).toLower();
  state.left = making ? m_makingLeft : own ? m_workLeft : -1;
  state.silent =
      !making && state.playing && m_sinceValues.isValid() ? static_cast<double>(m_sinceValues.elapsed()) / 1000 : 0;
  state.late = m_late;
  state.headset = m_headset;
  state.file = m_session.document().isDirty() && m_fileText.isEmpty() ? QStringLiteral("Not saved") : m_fileText;
  addNote(state);
  setState(state);
}

/// What is to be said, or the first of the step's limits; one that no row can show comes before others.
void StatusLine::addNote(State& state) {
  m_noteAddress.clear();
  state.note = m_said;
  state.mild = !m_said.isEmpty() && m_saidLevel != MessageLevel::Warning && m_saidLevel != MessageLevel::Error;
  if (!m_said.isEmpty() || !state.snapshot || state.snapshot->limits.empty()) return;
  const Document& document = m_session.document();
  const auto addressOf = [&](const Limit& limit) { return limitAddress(limit, state.snapshot->bodyIds.get()); };
  std::vector<Limit> limits = state.snapshot->limits;
  std::erase_if(limits, [&](const Limit& limit) {  // a snapshot may know of what the document has lost since
    const std::optional<Address> address = addressOf(limit);
    return address && !hasRow(document, *address);
  });
  if (limits.empty()) return;
  const auto lonely = std::find_if(limits.begin(), limits.end(), [&](const Limit& limit) { return !addressOf(limit); });
  const Limit& first = lonely == limits.end() ? limits.front() : *lonely;
  const std::optional<Address> address = addressOf(first);
  if (address) m_noteAddress = QString::fromStdString(address->text());
  const bool one = limits.size() == 1;
  QString count = one ? QStringLiteral("1 note") : QStringLiteral("%1 notes").arg(limits.size());
  if (address)
    count += (one ? QStringLiteral(" on %1") : QStringLiteral(", first on %1"))
                 .arg(ownerLabel(document.project(), *address));
  state.note = count + QStringLiteral(": ") + limitNote(first, address ? document.declaration(*address) : nullptr);
}

void StatusLine::setState(const State& state) {
  m_state = state;
  if (state.snapshot) {
    const FrameStats& stats = state.snapshot->stats;
    const bool fresh = state.snapshot->revision != m_revision || m_milliseconds == 0;
    if (state.snapshot->revision != m_revision) {
      m_revision = state.snapshot->revision;
      m_started = false;
      m_widths.clear();
    }
    // Matter drawn before the first step belongs to the start.
    if (!m_started) m_startEnergy = stats.thermalEnergy - stats.heat.net();
    m_started = stats.frame > 0;
    followTool();
    const double share = fresh ? 1 : kSmooth;
    m_milliseconds += share * (stats.totalMilliseconds - m_milliseconds);
    for (size_t i = 0; i < m_stages.size(); ++i) m_stages[i] += share * (stats.milliseconds[i] - m_stages[i]);
    // Two that are about as slow must not take turns.
    const auto slowest = std::max_element(m_stages.begin(), m_stages.end());
    if (*slowest > kClearly * m_stages[m_slowest]) m_slowest = static_cast<size_t>(slowest - m_stages.begin());
  }
  setAccessibleDescription(parts().join(QStringLiteral(", ")));
  update();
}

void StatusLine::followTool() {
  const std::vector<ToolContact>& tools = m_state.snapshot->tools;
  if (tools.empty() || !m_session.document().body(tools.front().body)) {
    m_tool = {};
    return;
  }
  const ToolContact& now = tools.front();
  const double share = m_tool.body == now.body ? kSmoothTool : 1;
  const auto follow = [share](auto& mean, const auto& value) { mean += share * (value - mean); };
  m_tool.body = now.body;
  follow(m_tool.force, now.force);
  follow(m_tool.heat, now.heat);
  follow(m_tool.latent, now.latent);
  follow(m_tool.gradient, now.gradient);
  m_tool.behind = now.behind;
}

/// "3.2 N on Spoon · takes 12 W · latent 4 W taken up · 850 K/m · 12 cm behind".
StatusLine::Part StatusLine::toolPart() const {
  const Body* body = m_session.document().body(m_tool.body);
  QStringList weak{QStringLiteral("on %1").arg(body ? nameOf(*body) : QString())};
  const auto watts = [](double value) { return formatPrefixed(std::abs(value), QStringLiteral("W"), 2); };
  const auto shows = [](double value) { return std::abs(value) >= kLeastTold; };
  if (shows(m_tool.heat))
    weak << (m_tool.heat > 0 ? QStringLiteral("takes %1") : QStringLiteral("gives %1")).arg(watts(m_tool.heat));
  if (shows(m_tool.latent)) {
    weak << (m_tool.latent > 0 ? QStringLiteral("latent %1 taken up") : QStringLiteral("latent %1 given off"))
                .arg(watts(m_tool.latent));
  }
  if (shows(m_tool.gradient)) weak << formatPrefixed(m_tool.gradient, QStringLiteral("K/m"), 2);
  if (m_tool.behind > kBehind * m_state.snapshot->spacing)
    weak << QStringLiteral("%1 behind").arg(formatPrefixed(m_tool.behind, QStringLiteral("m"), 2));
  return {formatPrefixed(m_tool.force.norm(), QStringLiteral("N"), 2), weak.join(QStringLiteral(" · ")), {}, {}};
}

double StatusLine::drift() const {
  if (!m_state.snapshot) return 0;
  const FrameStats& stats = m_state.snapshot->stats;
  const double exchanged = std::max(stats.heat.exchanged, 1e-9);
  return stats.heat.exchanged <= 0 ? 0 : (stats.thermalEnergy - m_startEnergy - stats.heat.net()) / exchanged;
}

std::vector<StatusLine::Part> StatusLine::leftParts() const {
  std::vector<Part> parts;
  if (!m_state.ready) return {{QStringLiteral("Loading plugins"), {}}};
  const QString state = !m_state.late.isEmpty() ? QStringLiteral("“%1” does not come back").arg(m_state.late)
                        : m_state.making >= 0
                            ? QStringLiteral("Making the scene, ") + progressText(m_state.making / 100.0, m_state.left)
                        : m_state.failed ? QStringLiteral("Paused, see above")
                        : m_state.silent > kSilent
                            ? QStringLiteral("No answer from the simulation for %1 s").arg(formatFixed(m_state.silent))
                        : m_state.playing ? QStringLiteral("Running")
                                          : QStringLiteral("Paused");
  const auto add = [&parts](Part part, const char* tip) {
    part.tip = QString::fromUtf8(tip);
    parts.push_back(std::move(part));
  };
  add({state, {}, QStringLiteral("Running")}, "What the run does. Space plays and pauses it.");
  if (!m_state.headset.isEmpty()) add({m_state.headset, {}, QStringLiteral("Entering VR")}, "What the headset does.");
  if (m_state.working >= 0) {
    const bool tells = m_state.making < 0 && m_state.left >= 0;
    const QString left = tells ? QStringLiteral(" · %1 left").arg(spanText(m_state.left)) : QString();
    add({QStringLiteral("%1 %").arg(m_state.working), m_state.work + left, QStringLiteral("100 %")},
        "How far long work is. Esc gives it up.");
  }
  if (!m_state.snapshot) return parts;
  const FrameStats& stats = m_state.snapshot->stats;
  add({formatFixed(static_cast<double>(m_state.snapshot->id.size())),
       m_state.snapshot->id.size() == 1 ? QStringLiteral("particle") : QStringLiteral("particles")},
      "Particles in the scene at this moment, of all bodies and taps.");
  if (!m_tool.body.empty()) add(toolPart(), "What the tool feels that a hand leads.");
  add({formatFixed(m_milliseconds, 1) + QStringLiteral(" ms"), detail(m_slowest), QStringLiteral("000.0 ms"),
       detail(widestStage())},
      "Time that a frame of the simulation takes, the stage of it that is slowest, and what drawing the view takes.");
  add({formatFixed(m_state.realTime, 2) + QStringLiteral("×"), QStringLiteral("real time"), QStringLiteral("00.00×")},
      "How fast the scene runs: at 1× a second of the scene takes a second.");
  if (!m_state.graphics.isEmpty()) add({{}, m_state.graphics}, "What draws the view.");
  add({formatFixed(stats.densityErrorMean * 100, 1) + QStringLiteral(" %"), QStringLiteral("density error"),
       QStringLiteral("00.0 %")},
      "How far liquid is from its density, in the mean. More substeps and iterations make it less.");
  add({formatError(drift()), QStringLiteral("energy drift"), formatError(-1.5e-8)},
      "Heat that matter has gained though none came, as a share of all that was exchanged since the start.");
  return parts;
}

/// "/frame · contact 3.1 · draw 0.8", with the name of a stage.
QString StatusLine::detail(size_t stage) const {
  QString text = QStringLiteral("/frame");
  if (m_stages[m_slowest] > 0) {
    text += QStringLiteral(" · %1 %2")
                .arg(QString::fromLatin1(stageName(static_cast<Stage>(stage))), formatFixed(m_stages[m_slowest], 1));
  }
  if (m_state.drawMilliseconds > 0) text += QStringLiteral(" · draw %1").arg(formatFixed(m_state.drawMilliseconds, 1));
  return text;
}

QStringList StatusLine::parts() const {
  QStringList list;
  for (const Part& part : leftParts()) list << (part.strong + QLatin1Char(' ') + part.weak).trimmed();
  if (!m_state.note.isEmpty()) list << m_state.note;
  if (!m_state.file.isEmpty()) list << m_state.file;
  return list;
}

void StatusLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  painter.fillRect(rect(), theme[Token::Window]);
  double right = width() - 12;
  const auto fromRight = [&](const QString& text, Token token) {
    const double w = textWidth(text, font) + 1;
    right -= w;
    paintText(painter, QRectF(right, 0, w + 1, height()), Qt::AlignLeft | Qt::AlignVCenter, text, font, theme[token]);
  };
  m_places.clear();
  if (!m_state.file.isEmpty()) {
    const double edge = right;
    fromRight(m_state.file, Token::Text2);
    m_places.push_back({QRectF(right, 0, edge - right, height()), QString::fromUtf8(kFileTip)});
    right -= 12;
  }
  m_noteRect = {};
  m_shownAddress = m_noteAddress;
  if (!m_state.note.isEmpty()) {
    const double edge = right;
    const Token token = m_state.mild ? Token::Info : Token::Warning;
    fromRight(m_state.note, token);
    right -= 20;
    paintIcon(painter, QRectF(right, 5, 14, 14), m_state.mild ? QStringLiteral("info") : QStringLiteral("warning"),
              theme[token]);
    m_noteRect = QRectF(right, 0, edge - right, height());
    m_places.push_back({m_noteRect, m_state.note});
    right -= 12;
  }
  const Token dot = m_state.failed || !m_state.late.isEmpty() || m_state.silent > kSilent ? Token::Error
                    : m_state.playing                                                     ? Token::Ok
                                                                                          : Token::Warning;
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme[m_state.ready ? dot : Token::Muted]);
  painter.drawEllipse(QPointF(16, height() / 2.0), 4, 4);
  paintParts(painter, right);
}

/// From the left, as many as end before `right`.
void StatusLine::paintParts(QPainter& painter, double right) {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  double x = 26;
  bool first = true;
  const std::vector<Part> parts = leftParts();
  if (m_widths.size() != parts.size()) m_widths.assign(parts.size(), {});
  for (size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    // As wide as they have been: a digit less must not move what stands beside it.
    Width& known = m_widths[i];
    const auto room = [&](const QString& a, const QString& b) {
      return std::max(textWidth(a, font), textWidth(b, font));
    };
    if (!part.strong.isEmpty()) known.strong = std::max(known.strong, room(part.strong, part.strongRoom) + 4);
    known.whole = std::max(known.whole, known.strong + room(part.weak, part.weakRoom) + 2);
    const double strong = known.strong, w = known.whole;
    if (x + w + 12 > right) break;  // no half words: what does not fit is left out
    if (!first) paintVerticalLine(painter, x - 8, 6, height() - 6, theme[Token::Line2]);
    first = false;
    m_places.push_back({QRectF(x - 8, 0, w + 16, height()), part.tip});
    paintText(painter, QRectF(x, 0, strong + 1, height()), Qt::AlignLeft | Qt::AlignVCenter, part.strong, font,
              theme[Token::Text]);
    paintText(painter, QRectF(x + strong, 0, w - strong + 1, height()), Qt::AlignLeft | Qt::AlignVCenter, part.weak,
              font, theme[Token::Text2]);
    x += w + 16;
  }
}

QString StatusLine::tipAt(const QPointF& at) const {
  const auto place =
      std::find_if(m_places.begin(), m_places.end(), [&](const Place& each) { return each.rect.contains(at); });
  return place == m_places.end() ? QString() : place->tip;
}

bool StatusLine::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  showTip(help->globalPos(), tipAt(help->pos()), this);
  return true;
}

/// The note may be another one when the button comes up: what was read is what is meant.
void StatusLine::mousePressEvent(QMouseEvent* event) {
  m_pressed = m_noteRect.contains(event->position()) ? std::optional(m_shownAddress) : std::nullopt;
}

void StatusLine::mouseReleaseEvent(QMouseEvent* event) {
  const std::optional<QString> pressed = std::exchange(m_pressed, std::nullopt);
  if (pressed && m_noteRect.contains(event->position())) Q_EMIT noteClicked(*pressed);
}

}  // namespace ps
