// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrmode.h"

#include "core/base/error.h"
#include "ui/document/document.h"
#include "ui/panels/wayout.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/transitions.h"
#include "ui/session/wording.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/propsevent.h"
#include "ui/viewport/viewport.h"
#include "ui/vr/livescene.h"
#include "ui/vr/mirror.h"
#include "ui/window/actions.h"
#include "ui/window/headsetcontext.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"
#include "ui/window/statusline.h"
#include "ui/window/vrhands.h"
#include "ui/window/vrmirror.h"
#include "ui/window/vrpanels.h"
#include "ui/window/vrwithout.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QThread>
#include <QtGui/QAction>

#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace ps {
namespace {

constexpr int kLook = 8;         // ms between looks at the headset
constexpr int kShowAgain = 200;  // ms after which what nobody tells of, like the theme, is shown all the same
constexpr int kOutside = 50;     // ms between looks at the hands that the window's view shows
constexpr int kAsleep = 1000;    // ms without a word of hands, after which they do nothing any more
const QString kTopic = QStringLiteral("VR");

/// As graphics drivers' errors are told, they go on from somebody's words.
QString asSentence(const std::string& text) {
  const QString said = sentence(QString::fromStdString(text));
  return said.left(1).toUpper() + said.mid(1);
}

/// Whoever has it last, it goes on the thread of the windows: the headset's may have been left in its runtime.
std::shared_ptr<HeadsetContext> headsetContext(QOpenGLContext* window) {
  return {new HeadsetContext(window), [](HeadsetContext* context) {
            QCoreApplication* application = QCoreApplication::instance();
            if (!application) return;  // its thread came back when all was over
            if (QThread::currentThread() == application->thread()) return delete context;
            QMetaObject::invokeMethod(
                application, [context] { delete context; }, Qt::QueuedConnection);
          }};
}

/// What pictures do without, to be in time.
QString savings(double detail, int coarser) {
  QString saved;
  if (coarser > 0) saved += QStringLiteral(", soft light and liquids coarser by %1 of %2").arg(coarser).arg(kSoftSteps);
  if (detail < 1) saved += QStringLiteral(", pictures at %1 %").arg(std::lround(100 * detail));
  return saved.isEmpty() ? saved : saved + QStringLiteral(", to be in time");
}

}  // namespace

VrMode::VrMode(const Parts& parts)
    : m_parts(parts),
      m_action(*parts.actions.find(QStringLiteral("simulation.vr"))),
      m_without(*parts.actions.find(QStringLiteral("simulation.tryVr"))),
      m_mirrors(*parts.actions.find(QStringLiteral("simulation.mirror"))),
      m_hands(std::make_unique<VrHands>(parts.session, parts.tools)) {
  m_timer.setInterval(kLook);
  m_timer.setTimerType(Qt::PreciseTimer);
  connect(&m_timer, &QTimer::timeout, this, &VrMode::look);
  for (QAction* action : {&m_action, &m_without, &m_mirrors}) action->setCheckable(true);
  m_mirrors.setChecked(preferences::showsEye());
  connect(&m_mirrors, &QAction::toggled, this, [this](bool on) {
    preferences::setShowsEye(on);
    showMirror();
  });
  connect(&m_action, &QAction::triggered, this, [this](bool on) { on ? enter() : leave(); });
  connect(&m_without, &QAction::triggered, this, [this](bool on) { on ? enterWithout() : leave(); });
  connect(m_hands.get(), &VrHands::boardWanted, this, [this] {
    if (m_panels) m_panels->toggleBoard();
  });
  connect(m_hands.get(), &VrHands::realWanted, m_parts.actions.find(QStringLiteral("sketch.real")), &QAction::trigger);
  follow();
}

VrMode::~VrMode() { delete m_window; }

/// After the view, which has what it draws by then.
void VrMode::follow() {
  const auto changed = [this] { m_changed = true; };
  connect(&m_parts.session, &Session::snapshotArrived, this, [this] {
    if (active()) show();
  });
  connect(&m_parts.session, &Session::projectShown, this, [this] {
    ++m_project;
    m_changed = true;
  });
  connect(&m_parts.session.document(), &Document::changed, this, changed);
  connect(&m_parts.session.recorded(), &RecordedView::ghostChanged, this, changed);
  connect(&m_parts.session.transitions(), &Transitions::changed, this, changed);
  connect(&m_parts.tools.selection(), &Selection::changed, this, changed);
  connect(&m_parts.tools, &Toolbox::toolChanged, this, changed);
  connect(&m_parts.tools, &Toolbox::brushChanged, this, changed);
}

/// Throws Error.
void VrMode::begin() {
  m_leaving = false;
  m_parts.status.say({});
  m_parts.notices.bar().close(kTopic);
  if (!m_parts.view) throw Error("VR needs OpenGL 4.3, which there is none of here; a graphics driver brings it.");
  m_link = std::make_shared<vr::HeadsetLink>();
  m_panels = std::make_shared<VrPanels>(
      VrPanels::Parts{m_parts.session, m_parts.tools, m_parts.curves, m_parts.view, m_parts.actions});
  connect(m_panels.get(), &VrPanels::wayOutWanted, this, &VrMode::wayOutWanted);
  connect(m_panels.get(), &VrPanels::refused, this, &VrMode::refused);
  show();
  m_timer.start();
  m_sinceHands.start();
}

void VrMode::enter() {
  if (m_window) leave();
  m_entersNext = m_headset && m_leaving;
  m_triesNext = false;
  if (active()) return showState();
  try {
    begin();
    const std::shared_ptr<HeadsetContext> context = headsetContext(m_parts.view->context());
    vr::HeadsetSetup setup;
    setup.makeCurrent = [context] { context->makeCurrent(); };
    setup.release = [context] { context->release(); };
    setup.makeScene = [link = m_link] { return std::make_unique<vr::LiveScene>(link); };
    setup.mirror = m_pictures = std::make_shared<vr::Mirror>();
    m_headset = std::make_unique<vr::Headset>(std::move(setup));
    showMirror();
  } catch (const std::exception& error) {
    end({true, error.what()});
  }
  showState();
}

void VrMode::enterWithout() {
  if (m_headset) leave();
  m_triesNext = m_headset != nullptr;
  if (active()) return showState();
  try {
    begin();
    m_panels->showLabels(false);  // the window itself says what its keys do
    m_window = new VrWithout(m_link, m_parts.view->window());
    connect(m_window, &VrWithout::closed, this, &VrMode::leave);
    connect(m_window, &VrWithout::failed, this, [this](const QString& why) { end({true, why.toStdString()}); });
    m_window->show();
  } catch (const std::exception& error) {
    end({true, error.what()});
  }
  showState();
}

void VrMode::leave() {
  m_leaving = true;
  m_entersNext = m_triesNext = false;
  m_hands->letGo();
  if (m_headset) m_headset->leave();
  if (m_window) end({});
  showState();
}

uint64_t VrMode::frames() const { return m_headset ? m_headset->frames() : m_window ? m_window->frames() : 0; }

void VrMode::look() {
  const auto ending = m_headset ? m_headset->ending() : std::nullopt;
  if (ending) return end(*ending);
  useHands();
  if (!m_panels) return;
  showHandsOutside();
  const bool painted = m_panels->paint();
  if (m_changed || m_sinceShown.hasExpired(kShowAgain)) {
    show();
  } else if (painted || m_hands->changed()) {
    showHands();
  }
  showState();
}

/// A hand may open a menu that waits in there until it closes: the looks of that time have seen newer hands, and
/// perhaps the end of the stay.
void VrMode::useHands() {
  const uint64_t look = ++m_looks;
  const std::shared_ptr<VrPanels> panels = m_panels;
  const std::vector<vr::HandsSeen> all = m_link->takeHands();
  for (const vr::HandsSeen& hands : all) {
    m_hands->act(hands, m_parts.view->snapshot());
    panels->act(hands);
    if (look != m_looks || panels != m_panels) return;
  }
  if (!all.empty()) {
    m_sinceHands.start();
  } else if (m_sinceHands.hasExpired(kAsleep)) {
    m_hands->letGo();  // the headset was taken off
    m_panels->letGo();
  }
}

void VrMode::show() {
  Viewport& view = *m_parts.view;
  auto shown = std::make_shared<vr::HeadsetView>();
  shown->matter = view.snapshot();
  shown->goesOn = m_parts.session.previousSnapshot() != nullptr;
  shown->scene = view.scene();
  shown->look = view.look();
  shown->picture = ++m_picture;
  shown->project = m_project;
  const auto before = m_link->shown();
  if (before && before->project == m_project) {
    shown->box = before->box;
  } else {
    static const Snapshot kEmpty;
    shown->box = boxOf(shown->matter ? *shown->matter : kEmpty, shown->scene.environment);
  }
  m_hands->describe(*shown);
  m_panels->describe(*shown);
  m_link->show(std::move(shown));
  m_changed = false;
  m_sinceShown.start();
}

void VrMode::showHands() {
  auto shown = std::make_shared<vr::HeadsetView>(*m_link->shown());
  m_hands->describe(*shown);
  m_panels->describe(*shown);
  m_link->show(std::move(shown));
}

namespace {

bool isSame(const std::vector<MeshVertex>& a, const std::vector<MeshVertex>& b) {
  static_assert(std::is_trivially_copyable_v<MeshVertex> && sizeof(MeshVertex) == 10 * sizeof(float));  // no gaps
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(MeshVertex)) == 0);
}

}  // namespace

/// The view, which goes on as from a camera beside them, shows whoever looks on the hands. While these rest it draws
/// nothing anew; a trial has a window of its own for all that.
void VrMode::showHandsOutside() {
  if (!m_headset || m_mirror) return;
  std::shared_ptr<const Props> hands = m_link->takeShownHands();
  if (hands && !(m_outside && isSame(hands->opaque, m_outside->opaque) && isSame(hands->clear, m_outside->clear))) {
    PropsEvent event(hands);
    QCoreApplication::sendEvent(m_parts.view, &event);
    m_outside = std::move(hands);
  }
  if (m_sinceOutside.isValid() && !m_sinceOutside.hasExpired(kOutside)) return;
  m_link->wantHands();
  m_sinceOutside.start();
}

void VrMode::takeHandsOutside() {
  if (!std::exchange(m_outside, nullptr)) return;
  PropsEvent event(std::make_shared<Props>());
  QCoreApplication::sendEvent(m_parts.view, &event);
}

/// The thread is done by then, or as good as, or left where its runtime keeps it.
void VrMode::end(const vr::Ending& ending) {
  const bool trial = m_window != nullptr;
  m_timer.stop();
  m_mirror.reset();
  m_headset.reset();
  if (m_window) {
    m_window->disconnect(this);
    m_window->hide();
    m_window->deleteLater();  // one of its events may be the reason
    m_window = nullptr;
  }
  m_hands->letGo();
  m_panels.reset();
  m_link.reset();
  takeHandsOutside();
  const QString said = ending.failed ? asSentence(ending.sentence)
                       : m_leaving   ? QString()
                                     : QStringLiteral("VR was left in the headset; the scene goes on here.");
  const MessageLevel level = ending.failed ? MessageLevel::Warning : MessageLevel::Info;
  showState();
  m_parts.status.say(said, level);
  if (ending.failed && !trial) {
    offerTrial(said);
  } else if (!said.isEmpty()) {
    m_parts.notices.message(level, kTopic, said);
  }
  Q_EMIT ended(said);
  if (std::exchange(m_triesNext, false)) enterWithout();
  if (std::exchange(m_entersNext, false)) enter();
}

/// What no headset shows, a window can.
void VrMode::offerTrial(const QString& why) {
  m_parts.session.log().add(MessageLevel::Warning, kTopic, why,
                            {{m_without.text(), wayout::action("simulation.tryVr")}});
  m_parts.notices.bar().show(kTopic, MessageLevel::Warning, kTopic, why,
                             {{m_without.text(), [this] { m_without.trigger(); }}});
}

void VrMode::showMirror() {
  const bool shown = m_headset && m_mirrors.isChecked();
  if (shown == (m_mirror != nullptr)) return;
  m_mirror = shown ? std::make_unique<VrMirror>(m_pictures, *m_parts.view) : nullptr;
}

/// What keeps its wearer from seeing the scene, or a hand from doing anything in it; "": nothing.
QString VrMode::hindrance() const {
  if (!m_headset->answers()) return QStringLiteral("the headset's software does not answer");
  if (m_headset->worn() == vr::Headset::Worn::Off) return QStringLiteral("the headset is not worn");
  if (m_headset->worn() == vr::Headset::Worn::BehindMenu) return QStringLiteral("behind a menu of the headset");
  const vr::HandRoles roles = m_link->shown()->roles;
  if (roles.alone) return m_headset->sees(roles.main) ? QString() : QStringLiteral("no hand is seen");
  const bool left = m_headset->sees(vr::kLeft), right = m_headset->sees(vr::kRight);
  if (left && right) return {};
  return !left && !right
             ? QStringLiteral("no hand is seen")
             : QStringLiteral("the %1 hand is not seen").arg(left ? QStringLiteral("right") : QStringLiteral("left"));
}

void VrMode::showState() {
  m_action.setChecked(m_headset && (!m_leaving || m_entersNext));
  m_without.setChecked(m_window != nullptr);
  const QString why = m_window ? QStringLiteral("The window of the trial shows that already") : QString();
  m_mirrors.setEnabled(!m_window);
  m_mirrors.setProperty(kWhyNot, why);
  m_mirrors.setToolTip(why);
  QString in = QStringLiteral("In VR");
  if (m_headset && m_headset->hertz() > 0) in += QStringLiteral(", %1 Hz").arg(std::lround(m_headset->hertz()));
  if (m_headset) in += savings(m_headset->detail(), m_headset->coarser());
  if (const QString hinders = m_headset ? hindrance() : QString(); !hinders.isEmpty())
    in += QStringLiteral("; ") + hinders;
  m_parts.status.setHeadset(m_window                  ? QStringLiteral("Trying VR")
                            : !m_headset              ? QString()
                            : m_leaving               ? QStringLiteral("Leaving VR")
                            : m_headset->frames() > 0 ? in
                                                      : QStringLiteral("Entering VR"));
}

}  // namespace ps
