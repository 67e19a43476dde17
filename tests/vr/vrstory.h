// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"
#include "tests/ui/scenestory.h"
#include "tests/vr/panelhands.h"
#include "ui/document/declared.h"
#include "ui/panels/materialspanel.h"
#include "ui/rows/rowvalue.h"
#include "ui/tools/becoming.h"

#include <QtWidgets/QScrollArea>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

// What stories share that are told in the headset, each in one stay: hands draw, and choose on the palette and the
// board with what they draw, and how strongly they heat.
namespace ps {

/// `Story`: a SceneStory<PanelsTest>, or one that is one too.
template <class Story>
class VrStory : public Story {
 protected:
  using Story::document;
  using Story::m_window;
  using Story::session;
  using Story::timeNow;
  using Story::view;

  /// Both hands at rest.
  void enters(const Vector3& ofLeft, const Vector3& ofRight) {
    m_stand = Story::stand();
    m_run = std::make_unique<ScriptedRun>(vrScript({}, left(0, ofLeft) + right(0, ofRight)));
    Story::enter();
  }
  /// What hands do next, from their own frame 0; the head stays.
  void next(const QString& keys, const QString& more = {}) { m_run->goOn(vrScript(more, keys)); }
  QString right(int frame, const Vector3& tip, const QString& inputs = {}, double roll = 0) {
    return tipKey(frame, "right", m_stand, tip, inputs, roll);
  }
  QString left(int frame, const Vector3& tip, const QString& inputs = {}) {
    return tipKey(frame, "left", m_stand, tip, inputs);
  }
  /// The left hand, which rests at a place, makes what is drawn real, and lets time pass.
  void makeRealAndPlay(const Vector3& rest, const QString& meanwhile) {
    next(left(0, rest) + meanwhile + left(10, rest, clicked("y")) + left(20, rest, clicked("y", false) + clicked("x")) +
         left(30, rest, clicked("x", false)));
    QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  }
  /// The left hand holds the palette up, and the beam of the right one presses a button of it so many times, once it
  /// is there.
  void presses(const char* name, int times = 1) {
    constexpr int kFirst = 4, kPitch = 4;  // frames; a trigger is pulled for half of the latter
    const QToolButton* one = Story::button(vr::kPalette, name);
    QVERIFY2(one, name);
    const vr::HandPose hand = Story::handAt(*one);
    QString keys = ::ps::key(0, "left", palm()) + ::ps::key(0, "right", hand, trigger(0));
    next(keys);
    QTRY_VERIFY2_WITH_TIMEOUT(one->underMouse(), name, kLong);
    for (int k = 0, frame = kFirst; k < times; ++k, frame += kPitch)
      keys += ::ps::key(frame, "right", hand, trigger(1)) + ::ps::key(frame + kPitch / 2, "right", hand, trigger(0));
    next(keys);
  }
  /// One of `names`, which are a ring, in place of `now`: the shorter way round.
  void goesTo(const char* choice, const std::vector<std::string>& names, const std::string& now,
              const std::string& wanted) {
    const auto at = [&](const std::string& name) {
      return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    const int all = static_cast<int>(names.size()), on = (at(wanted) - at(now) + all) % all;
    turns(choice, 2 * on > all ? on - all : on);
  }
  void turns(const char* choice, int times) {
    if (times == 0) return;
    const std::string name = std::string(choice) + (times < 0 ? ": back" : ": on");
    presses(name.c_str(), std::abs(times));
  }
  /// On the palette, too: the brush, its size within a half step, temperature within 5 K, and whether it holds.
  void brush(const char* shape, double radius, double temperature, bool held) {
    Toolbox& tools = m_window->tools();
    goesTo("Brush", idsByLabel(*session().plugins(), PluginKind::Brush), tools.brush().shape, shape);
    QTRY_COMPARE_WITH_TIMEOUT(tools.brush().shape, std::string(shape), kRun);
    const auto sizeSteps = [&] { return std::lround(std::log(radius / tools.brush().radius) / std::log(kBrushStep)); };
    turns("Size", static_cast<int>(sizeSteps()));
    QTRY_COMPARE_WITH_TIMEOUT(sizeSteps(), 0L, kRun);
    const auto warmer = [&] { return std::lround((temperature - tools.brush().temperature) / 10); };
    turns("Temperature", static_cast<int>(warmer()));
    QTRY_COMPARE_WITH_TIMEOUT(warmer(), 0L, kRun);
    if (tools.brush().held != held) presses("Hold what is drawn");
    QTRY_COMPARE_WITH_TIMEOUT(tools.brush().held, held, kRun);
  }
  void becomes(const std::string& what) {
    std::vector<std::string> names;
    for (const auto& [name, label] : becomings()) names.push_back(name);
    goesTo("Becomes", names, m_window->tools().brush().becomes, what);
    QTRY_COMPARE_WITH_TIMEOUT(m_window->tools().brush().becomes, what, kRun);
  }
  /// The beam of the right hand comes to a place on the board, which may only just have been brought.
  void pointsAtBoard(const QWidget& widget, const QPointF& at) {
    next(kBesideBoard + Story::boardKey(0, widget, at, false, false));
    QTRY_VERIFY_WITH_TIMEOUT(widget.underMouse(), kLong);
  }
  void pressesBoard(const QWidget& widget, const QPointF& at) {
    pointsAtBoard(widget, at);
    next(kBesideBoard + Story::boardKey(0, widget, at, false, false) + Story::boardKey(4, widget, at, false, true) +
         Story::boardKey(8, widget, at, false, false));
  }
  /// It stands where hands draw.
  void putsBoardAway() {
    QToolButton* close = Story::button(vr::kBoard, "Put the board away");
    QVERIFY(close);
    pressesBoard(*close, QRectF(close->rect()).center());
    QTRY_VERIFY_WITH_TIMEOUT(!Story::panels().widget(vr::kBoard), kLong);
  }
  /// A notch of the stick towards a height of a page that is scrolled, and the stick rests again.
  void scrolls(const QWidget& page, int height) {
    constexpr int kPush = 2, kRests = 5, kIsSeen = 4;  // frames
    const QRegion before = page.visibleRegion();
    const QPointF middle = before.boundingRect().center();
    const int way = height < middle.y() ? 1 : -1;
    const auto stick = [&](int frame, int y) {
      return Story::boardKey(frame, page, middle, false, false,
                             QStringLiteral(R"(, "/input/thumbstick/y": %1)").arg(y));
    };
    pointsAtBoard(page, middle);
    next(stick(0, 0) + stick(kPush, way) + stick(kRests, 0));
    const uint64_t over = Story::vr().frames() + kRests + kIsSeen;
    QTRY_VERIFY_WITH_TIMEOUT(page.visibleRegion() != before && Story::vr().frames() > over, kLong);
  }
  /// From the page that the palette's name of the material leads to, where the stick brings its tile into sight.
  void choose(const char* material) {
    presses("Material");
    const auto page = [&] {
      QWidget* board = Story::panels().widget(vr::kBoard);
      return board ? board->findChild<MaterialsPanel*>() : nullptr;
    };
    QTRY_VERIFY_WITH_TIMEOUT(page() && page()->isVisible(), kLong);
    MaterialsPanel* tiles = page();
    QVERIFY2(!tiles->tileOf(material).isEmpty(), material);
    const auto seen = [&] { return tiles->visibleRegion().contains(tiles->tileOf(material).center()); };
    for (int k = 0; k < 40 && !seen(); ++k) scrolls(*tiles, tiles->tileOf(material).center().y());
    QVERIFY2(seen(), material);
    pressesBoard(*tiles, tiles->tileOf(material).center());
    QTRY_VERIFY2_WITH_TIMEOUT(m_window->tools().brush().material == material,
                              m_window->tools().brush().material.c_str(), kLong);
    putsBoardAway();
  }
  /// The heat brush: its size as of any brush, and on the board, whose page the palette's name of the brush leads to,
  /// what it gives, W, to what is colder than so many K.
  void heatBrush(double radius, double power, double limit) {
    brush("heat", radius, m_window->tools().brush().temperature, false);
    presses("Brush");
    const auto isThere = [&] {
      return Story::panels().widget(vr::kBoard) && Story::rowOf(QStringLiteral("brush/power"));
    };
    QTRY_VERIFY_WITH_TIMEOUT(isThere(), kLong);
    Story::painted();  // laid out by then
    drags("brush/power", power, 0.1 * power);
    drags("brush/limit", limit, 20);
    putsBoardAway();
  }
  /// The number of a row of the page on the board, by the handle of its slider, which the beam of the right hand takes
  /// and leads there. A hand that a busy machine saw too seldom takes it again. `within`: of the number, a pixel of the
  /// slider or less.
  void drags(const char* key, double wanted, double within) {
    constexpr int kPulls = 4, kGoes = 14, kIsThere = 30, kLets = 36, kIsSeen = 6;  // frames
    ParameterRow* row = Story::rowOf(QString::fromLatin1(key));
    QVERIFY2(row, key);
    for (QWidget* parent = row->parentWidget(); parent; parent = parent->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(parent)) area->ensureWidgetVisible(row);
    const auto isMeant = [&] { return std::abs(row->number() - wanted) <= within; };
    for (int k = 0; k < 3 && !isMeant(); ++k) {
      const api::ParameterDeclaration& declaration = row->model().declaration;
      const QRectF track = row->sliderRect();
      const double now = sliderPosition(declaration, row->number()), then = sliderPosition(declaration, wanted);
      const QPointF from(std::round(track.left() + now * track.width()), std::round(track.center().y()));
      const QPointF to = from + QPointF((then - now) * track.width(), 0);
      QVERIFY2(row->visibleRegion().contains(from.toPoint()), key);
      pointsAtBoard(*row, from);
      const auto hand = [&](int frame, const QPointF& at, bool pulls) {
        return Story::boardKey(frame, *row, at, false, pulls);
      };
      next(kBesideBoard + hand(0, from, false) + hand(kPulls, from, true) + hand(kGoes, from, true) +
           hand(kIsThere, to, true) + hand(kLets, to, false));
      const uint64_t over = Story::vr().frames() + kLets + kIsSeen;
      QTRY_VERIFY_WITH_TIMEOUT(Story::vr().frames() > over, kLong);
    }
    QVERIFY2(isMeant(), qPrintable(QStringLiteral("%1: %2").arg(QLatin1String(key)).arg(row->number())));
  }
  /// The right hand goes to a place and heats there. Whether it meets matter: a brush that misses gives nothing, and
  /// one that does not gives this share of its power at the very least, also to matter that is soon as warm as it gets.
  bool heatsAt(const Vector3& place, double power, const Vector3& from, const Vector3& restOfLeft) {
    constexpr double kShare = 0.05, kSeconds = 1;
    constexpr int kReaches = 20, kPulls = 25, kIsSeen = 5;  // frames
    const double wanted = Story::heaters() + kShare * power * kHeatFaster * kSeconds;
    next(left(0, restOfLeft) + right(0, from) + right(kReaches, place) + right(kPulls, place, kPulled));
    const uint64_t pulled = Story::vr().frames() + kPulls + kIsSeen;
    return QTest::qWaitFor([&] { return Story::vr().frames() > pulled; }, kRun) &&
           comesWithin(kSeconds, [&] { return Story::heaters() > wanted; });
  }
  /// Whether it comes to that within so many seconds of the scene, however long those take here.
  template <class Condition>
  bool comesWithin(double seconds, const Condition& holds) {
    const double until = timeNow() + seconds;
    return QTest::qWaitFor([&] { return holds() || timeNow() > until; }, kRun) && holds();
  }
  void passes(double seconds) {
    const double until = timeNow() + seconds;
    QTRY_VERIFY_WITH_TIMEOUT(timeNow() > until, kRun);
  }
  /// A story goes on from what came before: where that failed there is nothing to go on from.
  void goesOnFromSuccess() {
    if (m_failed) QSKIP("what came before has failed");
  }
  void notesFailure() { m_failed = m_failed || QTest::currentTestFailed(); }
  int steps() { return document().undoStack().index(); }
  /// Both eyes see what the view draws from there, at last. `name`: of the left one's picture.
  void leavesAsEyesSawIt(const QString& name) {
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
    const size_t pictures = m_run->lines("picture").size();
    next(kHandsAway, QStringLiteral(R"(, "pictures": [20])"));
    QTRY_VERIFY_WITH_TIMEOUT(m_run->lines("picture").size() == pictures + 2, kLong);
    Story::leave();
    QVERIFY(m_run->lines("violation").empty());
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) eye(false).save(folder + QLatin1Char('/') + name);
    for (const bool isRight : {false, true}) Story::seesWhatTheViewDraws(eye(isRight), isRight, m_stand);
  }

  std::unique_ptr<ScriptedRun> m_run;
  vr::Stand m_stand;

 private:
  /// Of a left hand, besides the board.
  inline static const QString kBesideBoard = ::ps::key(0, "left", {{-0.3, 0.9, 0}, Quaternion::Identity()});
  bool m_failed = false;

  QImage eye(bool isRight) {
    const auto names = m_run->texts("picture");
    for (auto name = names.rbegin(); name != names.rend(); ++name)
      if (name->ends_with(isRight ? "-right.png" : "-left.png")) return QImage(QString::fromStdString(*name));
    return {};
  }
};

}  // namespace ps
