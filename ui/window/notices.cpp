// SPDX-License-Identifier: Apache-2.0
#include "ui/window/notices.h"

#include "core/plugin_host/registry.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/finersteps.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/window/actions.h"
#include "ui/window/noticebar.h"

#include <QtGui/QAction>

#include <algorithm>
#include <utility>
#include <vector>

namespace ps {
namespace {

const QString kStep = QStringLiteral("step");  // topic of what the engine says
const QString kRefused = QStringLiteral("refused");
const QString kRefusedNow = QStringLiteral("refused now");  // until the next edit
const QString kMaking = QStringLiteral("making");
const QString kGivingUp = QStringLiteral("Giving up…");

NoticeBar::Button startButton(Session& session) {
  return {QStringLiteral("Back to the start"), [&session] { session.reset(); }};
}

/// In place of the notice with the button, which would make them finer once more.
void showFinerSteps(Session& session, NoticeBar& bar, const QString& done) {
  bar.show(kStep, MessageLevel::Info, QStringLiteral("Steps are finer from the next frame on."),
           QStringLiteral("What was thrown apart is whole again at the start. Undo takes “%1” back.").arg(done),
           {startButton(session)});
}

/// "Use 16 substeps"; none where steps cannot be made finer.
std::vector<NoticeBar::Button> finerStepsButton(Session& session, Notices& notices) {
  const std::optional<FinerSteps> finer = finerSteps(session.document().project());
  if (!finer) return {};
  QString text = QStringLiteral("Use %1 substeps").arg(finer->substeps);
  std::vector<std::pair<Address, Value>> values{{{Owner::Solver, "", "substeps"}, double(finer->substeps)}};
  const Address iterations{Owner::Solver, "", "iterations"};
  if (!(session.document().value(iterations) == Value(double(finer->iterations)))) {
    text += QStringLiteral(" and %1 iterations").arg(finer->iterations);
    values.emplace_back(iterations, double(finer->iterations));
  }
  const auto use = [&session, &notices, values, text] {
    const QString problem = session.document().setParameters(values, text);
    if (!problem.isEmpty()) return notices.refuse(QStringLiteral("The steps stay as they are."), problem);
    showFinerSteps(session, notices.bar(), text);
  };
  return {{text, use, QStringLiteral("What is squeezed gives way less, and a frame takes longer")}};
}

}  // namespace

Notices::Notices(Session& session, NoticeBar& bar, const Actions& actions, QObject* parent)
    : QObject(parent), m_session(session), m_bar(bar), m_actions(actions) {
  connect(&session, &Session::happened, this, &Notices::onEvent);
  connect(&session, &Session::making, this, &Notices::showMaking);
  connect(&session.document(), &Document::changed, this, [this] {
    if (!m_refusedAt || *m_refusedAt == m_session.document().changeCount()) return;
    m_refusedAt.reset();
    m_bar.close(kRefusedNow);
  });
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    const auto* parameter = std::get_if<ParameterChanged>(&event);
    if (parameter && parameter->address.key == "particle_spacing") toolChanged();
  });
  connect(&session, &Session::playingChanged, this, [this] {
    if (m_session.playing()) toolChanged();  // hands are told that they work while time passes
  });
  connect(&session, &Session::madeOrNot, this, [this] {
    m_tellsMaking = m_givesUpMaking = false;
    m_bar.close(kMaking);
  });
}

bool Notices::cancelMaking() {
  if (!m_session.cancelMaking()) return false;
  m_givesUpMaking = true;
  if (m_tellsMaking) m_bar.setText(kMaking, kGivingUp);
  return true;
}

void Notices::showMaking(const QString& stage, double done, double left) {
  const QString text = m_givesUpMaking ? kGivingUp : stage + QStringLiteral(", ") + progressText(done, left);
  if (std::exchange(m_tellsMaking, true)) {
    m_bar.setText(kMaking, text);
  } else {
    m_bar.show(kMaking, MessageLevel::Info, QStringLiteral("The scene is being made."), text,
               {NoticeBar::cancelButton([this] { cancelMaking(); })});
  }
}

void Notices::showCancelled() {
  m_givesUpMaking = false;
  const QString text = m_session.isBroken()
                           ? QStringLiteral("It stands still until you play it, go back to the start or change it.")
                           : QStringLiteral("It goes on as it was.");
  m_bar.show(kStep, MessageLevel::Info, QStringLiteral("Making the scene was cancelled."), text,
             {{QStringLiteral("Try again"), [this] { m_session.reset(); }}});
}

void Notices::onEvent(const EngineEvent& event) {
  if (event.kind == EngineEvent::Kind::Settled) {
    m_bar.close(kStep);
  } else if (event.kind == EngineEvent::Kind::Remark) {
    showRemark(failureText(event));
  } else if (event.kind == EngineEvent::Kind::Late) {
    showLate(event.message);
  } else if (event.kind == EngineEvent::Kind::Cancelled) {
    showCancelled();
  } else if (event.kind == EngineEvent::Kind::NotOpened) {
    showBroken(event);
  } else {
    showFailure(event);
  }
}

void Notices::showFailure(const EngineEvent& event) {
  const FailureText failure = failureText(event);
  const auto level = event.kind == EngineEvent::Kind::Stopped || (event.flags & kTakenBack) ? MessageLevel::Error
                                                                                            : MessageLevel::Warning;
  const bool takenBack = event.kind == EngineEvent::Kind::Refused && event.culprit;
  const QString more = takenBack ? sentence(failure.text) + QStringLiteral(" The value before holds.") : failure.text;
  const QString text = failure.title + QLatin1Char(' ') + more;
  m_session.log().add(level, QStringLiteral("Simulation"), text);
  if (m_bar.isVisible() && m_bar.text() == text) return;  // one of its buttons may be under the pointer
  std::vector<NoticeBar::Button> buttons;
  if (event.flags & static_cast<StepFlags>(StepFlag::Diverged)) buttons = finerStepsButton(m_session, *this);
  // Matter runs off without any edit to blame.
  if (failure.lost) {
    buttons.push_back({QStringLiteral("Add sides"), [this] {
                         if (QAction* walls = m_actions.find(QStringLiteral("sketch.walls"))) walls->trigger();
                       }});
  } else if (!takenBack && m_session.document().undoStack().canUndo()) {
    buttons.push_back({QStringLiteral("Undo"), [this] { m_session.document().undoStack().undo(); }});
  }
  if (!takenBack) buttons.push_back(startButton(m_session));
  m_bar.show(kStep, level, failure.title, more, std::move(buttons));
}

void Notices::showLate(const std::string& plugin) {
  const auto& all = m_session.plugins()->plugins();
  const auto is = [&](const auto& so) {
    return std::any_of(all.begin(), all.end(), [&](const PluginInfo& info) { return info.id == plugin && so(info); });
  };
  const bool brush = is([](const PluginInfo& info) { return info.kind == PluginKind::Brush; });  // its stroke is over
  const bool own = is([](const PluginInfo& info) { return info.own; });  // no start leaves it out
  const QString title =
      QStringLiteral("The plugin “%1” does not come back.").arg(pluginLabel(m_session.plugins(), plugin));
  const QString text = (brush ? QStringLiteral("Its stroke was given up, and the scene goes on.")
                              : QStringLiteral("Nothing moves until it does.")) +
                       QStringLiteral(" Your work is kept: close the window and start the program again%1.")
                           .arg(own ? QString() : QStringLiteral(", which then leaves the plugin out"));
  m_session.log().add(MessageLevel::Error, QStringLiteral("Simulation"), title + QLatin1Char(' ') + text);
  m_bar.show(kStep, MessageLevel::Error, title, text);
}

void Notices::showRemark(const FailureText& remark) {
  m_session.log().add(MessageLevel::Warning, m_session.document().title(), remark.text);
  m_bar.show(QStringLiteral("open"), MessageLevel::Warning, remark.title, remark.text);
}

void Notices::showBroken(const EngineEvent& event) {
  const QString title = QStringLiteral("“%1” cannot run as it is.").arg(m_session.document().title());
  const QString text = sentence(QString::fromStdString(event.message)) +
                       QStringLiteral(" It stands still until a change makes it possible.");
  std::vector<NoticeBar::Button> buttons;
  if (event.culprit)
    buttons.push_back({QStringLiteral("Show it"), [this, culprit = *event.culprit] { Q_EMIT rowWanted(culprit); }});
  if (m_session.document().undoStack().canUndo())
    buttons.push_back({QStringLiteral("Undo"), [this] { m_session.document().undoStack().undo(); }});
  buttons.push_back({QStringLiteral("Open another…"), [this] {
                       if (QAction* open = m_actions.find(QStringLiteral("file.open"))) open->trigger();
                     }});
  m_bar.show(kStep, MessageLevel::Error, title, text, std::move(buttons));
  m_session.log().add(MessageLevel::Error, QStringLiteral("Simulation"), title + QLatin1Char(' ') + text);
}

void Notices::refuse(const QString& title, const QString& why) {
  ++m_refusals;
  if (why.isEmpty()) {
    m_bar.close(kRefused);
  } else {
    m_bar.show(kRefused, MessageLevel::Warning, title, why);
    m_session.log().add(MessageLevel::Warning, QStringLiteral("Scene"), title + QLatin1Char(' ') + why);
  }
}

/// Who refuses may take another brush in the same breath, of which nobody would have read why.
void Notices::refuseTool(const QString& title, const QString& why) {
  refuse(title, why);
  QTimer::singleShot(0, this, [this, number = m_refusals] { m_toolRefusal = number; });
}

void Notices::toolChanged() {
  if (m_toolRefusal == m_refusals) refuse({}, {});
}

void Notices::refuseUntilEdited(const QString& title, const QString& why) {
  m_refusedAt = m_session.document().changeCount();
  m_bar.show(kRefusedNow, MessageLevel::Warning, title, why);
  m_session.log().add(MessageLevel::Warning, QStringLiteral("Scene"), title + QLatin1Char(' ') + why);
}

void Notices::message(MessageLevel level, const QString& where, const QString& text) {
  m_session.log().add(level, where, text);
  if (level == MessageLevel::Error || level == MessageLevel::Warning) m_bar.show(where, level, where, text);
}

}  // namespace ps
