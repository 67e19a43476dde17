// SPDX-License-Identifier: Apache-2.0
#include "ui/window/sketchactions.h"

#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "core/scene/track.h"
#include "core/simulation/bodypieces.h"
#include "core/simulation/enginethread.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/materialspanel.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/worker.h"
#include "ui/theme/plaintext.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/window/actions.h"
#include "ui/window/shortcutswindow.h"
#include "ui/window/workspacekeys.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QPointer>
#include <QtGui/QAction>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <memory>
#include <utility>

namespace ps {
namespace {
const Address kGravity{Owner::Scene, "", "gravity"};
constexpr double kEarth = 9.81;  // m/s^2
}  // namespace

QString materialAction(int number) { return QStringLiteral("sketch.material%1").arg(number + 1); }

void SketchActions::makeMenu(QMenu* menu) {
  for (const ToolRow& row : toolTable()) {
    m_actions.add(menu, QStringLiteral("sketch.") + QString::fromLatin1(row.id), QString::fromLatin1(row.name),
                  {QKeySequence(QString::fromLatin1(row.key))}, [this, id = row.id] { m_tools.activate(id); });
  }
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("sketch.smaller"), QStringLiteral("Smaller brush"),
                {QKeySequence(QStringLiteral("["))}, [this] { m_tools.stepBrush(-1); });
  m_actions.add(menu, QStringLiteral("sketch.larger"), QStringLiteral("Larger brush"),
                {QKeySequence(QStringLiteral("]"))}, [this] { m_tools.stepBrush(1); });
  // Keyboards on which a bracket takes Shift itself send braces, where these do.
  m_actions.add(menu, QStringLiteral("sketch.lessFlow"), QStringLiteral("Less flow"),
                {QKeySequence(QStringLiteral("Shift+[")), QKeySequence(QStringLiteral("Shift+{"))},
                [this] { m_tools.stepFlow(-1); });
  m_actions.add(menu, QStringLiteral("sketch.moreFlow"), QStringLiteral("More flow"),
                {QKeySequence(QStringLiteral("Shift+]")), QKeySequence(QStringLiteral("Shift+}"))},
                [this] { m_tools.stepFlow(1); });
  m_actions.add(menu, QStringLiteral("sketch.shape"), QStringLiteral("Next brush shape"),
                {QKeySequence(QStringLiteral("N"))}, [this] { m_tools.stepShape(1); });
  m_actions.add(menu, QStringLiteral("sketch.mirror"), QStringLiteral("Mirror"), {QKeySequence(QStringLiteral("M"))},
                [this] {
                  BrushSettings brush = m_tools.brush();
                  brush.symmetry.mirror = brush.symmetry.mirror == "none" ? "x" : "none";
                  m_tools.setBrush(brush);
                });
  m_actions.add(menu, QStringLiteral("sketch.planeHere"), QStringLiteral("Plane from the surface"),
                {QKeySequence(QStringLiteral("I"))}, [this] { Q_EMIT planeWanted(false); });
  m_actions.add(menu, QStringLiteral("sketch.planeView"), QStringLiteral("Plane across the view"),
                {QKeySequence(QStringLiteral("Shift+I"))}, [this] { Q_EMIT planeWanted(true); });
  addHolding(menu);
  addMaterials(menu->addMenu(QStringLiteral("Material")));
  m_shapes = menu->addMenu(QStringLiteral("Brush shape"));
  m_shapes->setEnabled(false);
}

void SketchActions::addHolding(QMenu* menu) {
  menu->addSeparator();
  m_hold = m_actions.add(menu, QStringLiteral("sketch.hold"), QStringLiteral("Hold what is drawn"),
                         {QKeySequence(QStringLiteral("L"))}, [this] {
                           BrushSettings brush = m_tools.brush();
                           brush.held = !brush.held;
                           m_tools.setBrush(brush);
                         });
  m_hold->setCheckable(true);
  m_makeReal = m_actions.add(menu, QStringLiteral("sketch.real"), QStringLiteral("Make it real"),
                             {QKeySequence(Qt::Key_Return), QKeySequence(Qt::Key_Enter)}, [this] { letGo(); });
  m_makeReal->setToolTip(QStringLiteral("Lets go of all that is held"));
  QAction* separate = m_actions.add(menu, QStringLiteral("sketch.separate"), QStringLiteral("Separate pieces"), {},
                                    [this] { this->separate(); });
  separate->setToolTip(
      QStringLiteral("Makes what has come apart of sketched bodies bodies of their own: of those that "
                     "are selected, or of all that are solid"));
  menu->addSeparator();
  connect(&m_tools, &Toolbox::brushChanged, this, &SketchActions::showHeld);
  connect(&m_session.document(), &Document::changed, this, &SketchActions::showHeld);
  connect(&m_session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    const auto* body = std::get_if<BodyChanged>(&event);
    if (body && body->resized) noteSize(body->id, body->resized->factor);
    if (std::holds_alternative<ProjectOpened>(event)) m_resized.clear();
  });
  showHeld();
}

void SketchActions::addMaterials(QMenu* menu) {
  for (int k = 0; k < kMaterialKeys; ++k) {
    const QString key = QString::number((k + 1) % kMaterialKeys);
    QAction* action =
        m_actions.add(menu, materialAction(k), {}, {}, [this, k] { takeMaterial(static_cast<size_t>(k)); });
    action->setProperty(kPlainText, QStringLiteral("Draw with the scene's material %1").arg(k + 1));
    action->setProperty(kWhyNot, QStringLiteral("The scene has fewer materials"));
    addKeys(*action, KeysIn::Sketch, {QKeySequence(key)});
  }
  connect(&m_session.document(), &Document::changed, menu, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event) || std::holds_alternative<MaterialsChanged>(event))
      showMaterials();
  });
  showMaterials();
}

void SketchActions::showMaterials() {
  const std::vector<SceneMaterial>& materials = m_session.document().project().materials;
  for (int k = 0; k < kMaterialKeys; ++k) {
    QAction* action = m_actions.find(materialAction(k));
    const auto number = static_cast<size_t>(k);
    const bool there = number < materials.size();
    const QString name = there ? QString::fromStdString(shownName(materials[number])) : QString::number(k + 1);
    action->setText(asButtonText(QStringLiteral("Draw with %1").arg(name)));
    action->setVisible(there);
    action->setEnabled(there);
  }
}

void SketchActions::takeMaterial(size_t number) {
  const std::vector<SceneMaterial>& materials = m_session.document().project().materials;
  if (number >= materials.size()) return;
  const std::string id = materials[number].id;
  if (!m_tools.tool().usesBrush()) m_tools.activate(kBrushTool);
  m_tools.selection().setMaterial(id);
}

std::vector<std::string> SketchActions::heldBodies() const {
  std::vector<std::string> held;
  const Project& project = m_session.document().project();
  for (const Body& body : project.bodies) {
    const auto is = [&](const char* key) { return toggleOf(body.parameters, bodyParameters(), key); };
    if (is("held") && !is("fixed") && !findTrack(project.tracks, Address{Owner::Body, body.id, "held"}.text()))
      held.push_back(body.id);
  }
  return held;
}

void SketchActions::showHeld() {
  m_hold->setChecked(m_tools.brush().held);
  m_makeReal->setEnabled(!heldBodies().empty());
}

/// One undo step, whose undo holds them again.
void SketchActions::letGo() {
  std::vector<std::pair<Address, Value>> values;
  for (const std::string& id : heldBodies()) values.push_back({{Owner::Body, id, "held"}, false});
  m_session.document().setParameters(values, QStringLiteral("make it real"));
}

void SketchActions::noteSize(const std::string& body, double factor) {
  if (!m_session.newest()) return;
  Resized& known = m_resized[body];
  const uint64_t revision = m_session.newest()->revision;
  known = {revision, known.revision == revision ? known.factor * factor : factor};
}

bool SketchActions::hasOtherCells(const std::string& body) const {
  constexpr double kSame = 1e-9;  // of a size that was taken back
  const auto found = m_resized.find(body);
  return found != m_resized.end() && m_session.newest() && found->second.revision == m_session.newest()->revision &&
         std::abs(found->second.factor - 1) > kSame;
}

/// Drops part and meet all the time: those of what flows are told apart where somebody has chosen it.
void SketchActions::separate() {
  const Document& document = m_session.document();
  const std::vector<std::string> chosen = m_tools.selection().bodies();
  Separation wanted;
  wanted.all = chosen.empty();
  for (const Body& body : document.project().bodies) {
    const bool isMeant = wanted.all || std::find(chosen.begin(), chosen.end(), body.id) != chosen.end();
    if (!isMeant || !mayComeApart(body)) continue;
    if (hasOtherCells(body.id))
      wanted.resized = QString::fromStdString(shownName(body));
    else
      wanted.bodies.push_back({body, {}});
  }
  if (wanted.bodies.empty() || !m_session.engine() || m_session.isBroken()) return part({}, wanted.resized);
  // The engine's thread may come to it when the window has gone.
  m_session.engine()->ask([self = QPointer(this), wanted](const Engine& engine) {
    auto moment = std::make_shared<const TiedScene>(tiedScene(engine));
    QMetaObject::invokeMethod(QCoreApplication::instance(), [self, wanted, moment = std::move(moment)] {
      if (self) self->findPieces(moment, wanted);
    });
  });
}

/// On the thread for what takes its time: no frame waits for it.
void SketchActions::findPieces(const std::shared_ptr<const TiedScene>& moment, Separation wanted) {
  m_session.worker().run([self = QPointer(this), moment, wanted = std::move(wanted)]() mutable {
    for (Pieces& one : wanted.bodies) {
      if (!wanted.all || isSolid(*moment, one.body.id)) one.cells = piecesOf(*moment, one.body);
    }
    QMetaObject::invokeMethod(QCoreApplication::instance(), [self, wanted = std::move(wanted)] {
      if (self) self->part(wanted.bodies, wanted.resized);
    });
  });
}

/// One step. Those that have been drawn on, locked or fixed meanwhile stay whole, and those of a state that knows no
/// cells of theirs.
/// `resized`: the name of one that is left out, because its matter is of other cells.
void SketchActions::part(const std::vector<Pieces>& bodies, const QString& resized) {
  Document& document = m_session.document();
  const auto isParted = [&](const Pieces& one) {
    const Body* now = document.body(one.body.id);
    const bool apart = !one.cells.empty() && std::any_of(one.cells.begin() + 1, one.cells.end(),
                                                         [](const auto& piece) { return !piece.empty(); });
    return apart && now && mayComeApart(*now) && now->shape == one.body.shape;
  };
  const auto parted = std::count_if(bodies.begin(), bodies.end(), isParted);
  bool any = false;
  if (parted > 1) document.undoStack().beginMacro(QStringLiteral("separating pieces"));
  for (const Pieces& one : bodies) {
    if (isParted(one)) any = !document.partBody(one.body.id, {one.cells.begin() + 1, one.cells.end()}).empty() || any;
  }
  if (parted > 1) document.undoStack().endMacro();
  if (!any && !resized.isEmpty())
    m_tools.refuse(QStringLiteral("Nothing was separated."),
                   QStringLiteral("“%1” has another size since the start, and its matter is still of the cells from "
                                  "before. Press Home first, or undo that.")
                       .arg(resized));
  else if (!any)
    m_tools.refuse(QStringLiteral("Nothing was separated."),
                   QStringLiteral("No sketched body that is meant has come apart."));
}

void SketchActions::addGravity(QMenu* menu) {
  m_gravity = m_actions.add(menu, QStringLiteral("simulation.gravity"), QStringLiteral("Zero gravity"),
                            {QKeySequence(QStringLiteral("Shift+G"))}, [this] { turnGravity(); });
  m_gravity->setToolTip(QStringLiteral("Takes gravity away, and gives it back"));
  m_gravity->setCheckable(true);
  const auto follow = [this] { m_gravity->setChecked(m_session.document().value(kGravity) == Value(0.0)); };
  connect(&m_session.document(), &Document::changed, m_gravity, follow);
  connect(&m_session, &Session::projectShown, m_gravity, [this] { m_before = 0; });
  connect(m_gravity, &QAction::triggered, m_gravity, follow);  // what holds, not what was clicked
  follow();
}

/// Back comes what there was, or what the Earth has.
void SketchActions::turnGravity() {
  Document& document = m_session.document();
  const Value now = document.value(kGravity);
  const auto* gravity = std::get_if<double>(&now);
  if (!gravity) return;
  if (*gravity != 0) m_before = *gravity;
  const bool off = *gravity != 0;
  document.setParameters({{kGravity, off            ? 0.0
                                     : m_before > 0 ? m_before
                                                    : kEarth}},
                         off ? QStringLiteral("zero gravity") : QStringLiteral("gravity again"));
}

/// The key that a brush asks for, where nothing else has it.
QList<QKeySequence> SketchActions::keysOf(const std::string& brush) const {
  const PluginInfo* info = m_session.plugins()->info(brush);
  if (!info || info->key.empty()) return {};
  const QKeySequence key(QString::fromStdString(info->key));
  const QList<QAction*> all = m_actions.all();
  const bool taken =
      std::any_of(all.begin(), all.end(), [&](const QAction* action) { return allKeys(*action).contains(key); });
  return taken ? QList<QKeySequence>{} : QList<QKeySequence>{key};
}

void SketchActions::addBrushes() {
  const PluginRegistry* plugins = m_session.plugins();
  for (const std::string& id : idsByLabel(*plugins, PluginKind::Brush)) {
    QAction* action =
        m_actions.add(m_shapes, QStringLiteral("sketch.shape.") + QString::fromStdString(id),
                      QStringLiteral("Brush shape: %1").arg(pluginLabel(plugins, id)), keysOf(id), [this, id] {
                        if (!m_tools.tool().usesBrush()) m_tools.activate(kBrushTool);
                        m_tools.takeBrush(id);
                        Q_EMIT shapeTaken();
                      });
    action->setProperty(kWords, QString::fromStdString(id));
  }
  m_shapes->setEnabled(!m_shapes->isEmpty());
}

}  // namespace ps
