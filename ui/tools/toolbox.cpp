// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/toolbox.h"

#include "core/parameters/condition.h"
#include "core/plugin_host/registry.h"
#include "core/sketch/cellset.h"
#include "core/sketch/stampform.h"
#include "core/sketch/stroke.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/stampof.h"
#include "ui/session/selection.h"
#include "ui/theme/numbers.h"
#include "ui/tools/brushcall.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/surface.h"
#include "ui/tools/tooltable.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
/// Key by which a brush that stamps declares how large its copies are; plugins/examples/README.md says so.
constexpr const char *kScale = "scale", *kFlow = "flow";

/// A shape that is filled with cells within this is waited for; others are looked for.
constexpr std::chrono::milliseconds kAtOnce{8}, kShapeLook{20};

/// What a brush says of its stamp.
struct Said {
  Vector3 half{0, 0, 0};  ///< m
  bool box = false;
  std::shared_ptr<const StampForm> form{};
};

/// The cells of one touch at the origin: on a lattice that lies as evenly about it as the stamp's box does. A ball of a
/// box is a ball, whichever of its cells are filled.
std::shared_ptr<const StampForm> formOf(const api::BrushPlugin& brush, StrokeSetup setup, const Said& said) {
  const Vector3& half = said.half;
  if (!said.box && (half - Vector3::Constant(half[0])).cwiseAbs().maxCoeff() < 1e-9) return nullptr;
  const double edge = setup.grid.spacing;
  for (int k = 0; k < 3; ++k) setup.grid.origin[k] = std::lround(2 * half[k] / edge) % 2 == 0 ? edge / 2 : 0;
  setup.symmetry.reset();
  api::StrokeSample sample{};
  sample.pressure = 1;
  try {
    const api::EditKind kind = kindOf(brush, false);
    StrokeEdits edits = applyBrush(brush, setup, kind, {&sample, 1});
    auto form = stampForm(edits.of(kind), edge, setup.grid.origin);
    return form ? std::make_shared<const StampForm>(std::move(*form)) : nullptr;
  } catch (const Error&) {  // too many cells, or none that can be: the stroke itself will say so
    return nullptr;
  }
}
}  // namespace

Toolbox::Toolbox(Document& document, Selection& selection, QObject* parent)
    : QObject(parent), m_document(document), m_selection(selection), m_active(kSelectTool) {
  for (const ToolRow& row : toolTable()) m_tools.emplace(row.id, row.make(*this));
  connect(&m_shapeLooks, &QTimer::timeout, this, [this] {
    takeShape(std::chrono::milliseconds(0));
    if (!fillsShape()) Q_EMIT brushChanged();
  });
  // What is drawn is of the material that is chosen.
  connect(&selection, &Selection::materialChanged, this, [this] {
    BrushSettings brush = m_brush;
    brush.material = m_selection.material();
    setBrush(brush);
  });
  connect(&selection, &Selection::changed, this, [this] {
    if (m_selection.body().empty() || m_selection.body() == m_stamped) return;
    m_stamped = m_selection.body();
    if (stampsShape()) Q_EMIT brushChanged();
  });
  // A stroke in the making builds on the document as it was when it began.
  connect(&document.undoStack(), &History::indexChanged, this, [this] {
    if (tool().usesBrush()) giveUp();
  });
}

Toolbox::~Toolbox() = default;

void Toolbox::attach(SceneLink* link) {
  tool().leave();
  m_link = link;
  const PluginRegistry* plugins = m_document.plugins();
  if (link && plugins && m_brush.shape.empty()) takeInstalled(plugins->standard(PluginKind::Brush));
}

bool Toolbox::can(const char* capability, const std::string& brush) const {
  const PluginRegistry* plugins = m_document.plugins();
  return plugins && plugins->needs(brush, capability);
}

bool Toolbox::draws(const std::string& brush) const {
  return !can(api::kTouchesMatter, brush) && !can(api::kPaintsMatter, brush) && !can(api::kColoursMatter, brush) &&
         !can(api::kSmoothsMatter, brush);
}

const Body* Toolbox::stampedBody() const { return m_document.body(m_stamped); }

std::string Toolbox::shapeName() const {
  const Body* body = stampedBody();
  return body ? body->name : std::string();
}

std::optional<VoxelShape::Stamp> Toolbox::shape() {
  shapeCells();
  return m_shape.filled.stamp;
}

/// A mesh on a thread beside the window: what fills it may take its time.
std::shared_ptr<const StampCells> Toolbox::shapeCells() {
  const Body* body = stampedBody();
  if (!body) {
    m_shape = {};
    return nullptr;
  }
  const bool known = m_shape.body == body->id && m_shape.spacing == spacing();
  if (known && m_shape.change == m_document.changeCount()) return m_shape.filled.cells;
  if (!known || !(m_shape.form == body->shape)) {
    const auto fill = [body = *body, spacing = spacing()] {
      Shape::Filled filled;
      try {
        filled.stamp = stampOf(body, spacing);
        filled.cells = stampCells(*filled.stamp);
      } catch (const std::exception&) {  // the stroke itself will say so
      }
      if (!filled.cells) filled.stamp.reset();
      return filled;
    };
    const auto* solid = std::get_if<SolidShape>(&body->shape);
    if (solid && solid->mesh) {
      std::packaged_task<Shape::Filled()> task(fill);
      m_shape.filled = {};
      m_shape.making = task.get_future();
      runDetached(std::move(task));
      takeShape(kAtOnce);
    } else {
      m_shape.making = {};
      m_shape.filled = fill();
    }
  }
  m_shape.change = m_document.changeCount();
  m_shape.body = body->id;
  m_shape.spacing = spacing();
  m_shape.form = body->shape;
  return m_shape.filled.cells;
}

void Toolbox::takeShape(std::chrono::milliseconds patience) {
  if (!m_shape.making.valid()) return m_shapeLooks.stop();
  if (m_shape.making.wait_for(patience) != std::future_status::ready) return m_shapeLooks.start(kShapeLook);
  m_shapeLooks.stop();
  m_shape.filled = m_shape.making.get();
}

/// Or the first one that draws where that cannot be had.
void Toolbox::takeInstalled(const std::string& wanted) {
  const PluginRegistry& plugins = *m_document.plugins();
  BrushSettings brush = m_brush;
  brush.shape = wanted;
  const std::vector<std::string> installed = plugins.ids(PluginKind::Brush);
  if (!plugins.brush(brush.shape) && !installed.empty()) {
    const auto found =
        std::find_if(installed.begin(), installed.end(), [this](const std::string& id) { return draws(id); });
    brush.shape = found == installed.end() ? installed.front() : *found;
  }
  setBrush(brush);
}

void Toolbox::putAside(const std::string& brush, const std::string& problem) {
  Q_EMIT brushFailed(QString::fromStdString(brush), QString::fromStdString(problem));
  takeInstalled(m_document.plugins()->standard(PluginKind::Brush));
}

/// What its user does not see any more is told: Esc alone gives it up by itself.
void Toolbox::giveUp() {
  if (tool().goesOn())
    refuse(QStringLiteral("Nothing was drawn."),
           QStringLiteral("The hollow was still running full when something else was done."));
  tool().cancel();
}

void Toolbox::activate(const std::string& id) {
  if (!toolRow(id)) return;
  const bool stamp = id == kBrushTool && stampsShape();  // an eraser may well take copies away
  if (tool(id).usesBrush() && (stamp || !draws(m_brush.shape)) && !m_drawing.empty()) {
    BrushSettings brush = m_brush;
    brush.shape = m_drawing;
    setBrush(brush);
  }
  if (id == m_active) return;
  giveUp();
  tool().leave();
  m_active = id;
  Q_EMIT toolChanged();
}

void Toolbox::choose(std::optional<ChosenStroke> stroke) {
  if (stroke == m_stroke) return;
  giveUp();
  m_stroke = std::move(stroke);
  Q_EMIT strokeChosen();
}

std::optional<ChosenStroke> Toolbox::stroke() const {
  const Body* body = m_stroke ? m_document.body(m_stroke->body) : nullptr;
  const auto* sketch = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
  return sketch && m_stroke->index < sketch->strokes.size() ? m_stroke : std::nullopt;
}

std::optional<Wire> Toolbox::strokeWire() const {
  const std::optional<ChosenStroke> chosen = stroke();
  if (!chosen) return std::nullopt;
  const auto& sketch = std::get<VoxelShape>(m_document.body(chosen->body)->shape);
  const VoxelShape::Stroke& stroke = sketch.strokes[chosen->index];
  std::vector<Vector3> places;
  for (const auto& sample : stroke.samples)
    places.push_back(gridOf(sketch).pose.of(Vector3(sample[0], sample[1], sample[2])));
  Wire wire;
  wire.selected = true;
  for (size_t k = 1; k < places.size(); ++k) wire.lines.emplace_back(places[k - 1], places[k]);
  // Of a dab a cross as large as its brush: a line without length is not seen.
  const bool isDab = std::all_of(places.begin(), places.end(), [&](const Vector3& p) { return p == places.front(); });
  for (int axis = 0; isDab && !places.empty() && axis < 3; ++axis) {
    const Vector3 arm = stroke.radius * Vector3::Unit(axis);
    wire.lines.emplace_back(places.front() - arm, places.front() + arm);
  }
  return wire;
}

void Toolbox::setMouse(MousePreset preset) {
  if (preset == m_mouse) return;
  giveUp();
  m_mouse = preset;
  Q_EMIT mouseChanged();
}

void Toolbox::setHandles(const HandleSettings& settings) {
  if (settings == m_handles) return;
  m_handles = settings;
  Q_EMIT handlesChanged();
}

void Toolbox::takeBrush(const std::string& id) {
  // An eraser of one particle at a time is not what one means who chooses to fill.
  const bool onlyAdds = m_active == kEraseTool && can(api::kFillsHollows, id);
  if ((onlyAdds || !draws(id)) && tool().usesBrush()) activate(kBrushTool);
  BrushSettings brush = m_brush;
  brush.shape = id;
  setBrush(brush);
}

void Toolbox::setBrush(const BrushSettings& brush) {
  if (brush == m_brush) return;
  m_brush = brush;
  if (draws(m_brush.shape) && !stampsShape()) m_drawing = m_brush.shape;
  Q_EMIT brushChanged();
}

void Toolbox::stepBrush(int direction) { setBrushSize(brushSize() * (direction > 0 ? kBrushStep : 1 / kBrushStep)); }

void Toolbox::stepFlow(int direction) {
  if (!m_document.plugins()) return;
  const api::ParameterList own = m_document.plugins()->parameters(m_brush.shape);
  const api::ParameterDeclaration* flow = findDeclaration(own, kFlow);
  if (!flow || flow->kind != api::ParameterKind::Number) {
    const QString label = pluginLabel(m_document.plugins(), m_brush.shape);
    return refuse(QStringLiteral("The flow stays."), QStringLiteral("The brush “%1” has none.").arg(label));
  }
  BrushSettings brush = m_brush;
  const double now = std::get<double>(valueOf(m_brush.shapeParameters(), *flow));
  const double next = now * (direction > 0 ? kBrushStep : 1 / kBrushStep);
  brush.parameters[brush.shape].values[flow->key] = std::clamp(next, flow->hardMinimum, flow->hardMaximum);
  setBrush(brush);
}

/// A brush that stamps may be as large as its radius instead; its scale then says that it does not act.
const api::ParameterDeclaration* Toolbox::scaleParameter() const {
  if (!stampsShape()) return nullptr;
  const api::ParameterList own = m_document.plugins()->parameters(m_brush.shape);
  const api::ParameterDeclaration* scale = findDeclaration(own, kScale);
  if (!scale || scale->kind != api::ParameterKind::Number) return nullptr;
  const ParameterSet set = m_brush.shapeParameters();
  const ValueOfKey values = [&](std::string_view key) -> std::optional<Value> {
    const api::ParameterDeclaration* one = findDeclaration(own, key);
    return one ? std::optional(valueOf(set, *one)) : std::nullopt;
  };
  return holds(parseCondition(scale->enabledWhen), values) ? scale : nullptr;
}

double Toolbox::brushSize() const {
  const api::ParameterDeclaration* scale = scaleParameter();
  return scale ? std::get<double>(valueOf(m_brush.shapeParameters(), *scale)) : m_brush.radius;
}

void Toolbox::setBrushSize(double size) {
  BrushSettings brush = m_brush;
  if (const api::ParameterDeclaration* scale = scaleParameter())
    brush.parameters[brush.shape].values[scale->key] = std::clamp(size, scale->hardMinimum, scale->hardMaximum);
  else
    brush.radius = std::clamp(size, kBrushMinimum, kBrushMaximum);
  setBrush(brush);
}

QString Toolbox::brushSizeName() const {
  const api::ParameterDeclaration* scale = scaleParameter();
  return scale ? QString::fromUtf8(scale->label) : QStringLiteral("Radius");
}

QString Toolbox::brushSizeText() const {
  return scaleParameter() ? formatQuantity(100 * brushSize(), QStringLiteral("%"), 3) : lengthText(m_brush.radius);
}

const std::string* further(const std::vector<std::string>& ring, const std::string& now, int by) {
  if (ring.empty()) return nullptr;
  const auto found = std::find(ring.begin(), ring.end(), now);
  if (found == ring.end()) return &ring.front();
  const auto count = static_cast<std::ptrdiff_t>(ring.size());
  return &ring[static_cast<size_t>((found - ring.begin() + by + count) % count)];
}

void Toolbox::layPlane(const Pointer& pointer, bool acrossView) {
  const QString refusal = QStringLiteral("No plane was laid.");
  BrushSettings brush = m_brush;
  if (acrossView) {
    brush.plane = FreePlane::across(pointer.target, -pointer.forward);
  } else {
    const auto surface = surfaceUnder(pointer, m_document.project().environment);
    if (!surface || surface->normal.isZero())
      return refuse(refusal, QStringLiteral("The pointer is on no matter, nor on a floor."));
    const Vector3 normal = matterOn(pointer) ? facingAt(pointer, surface->point) : surface->normal;
    const Vector3 half = stamp(normal).first.cwiseProduct(normal);
    brush.plane = FreePlane::across(surface->point + half.norm() * normal, normal);
  }
  brush.drawOn = DrawOn::Plane;
  setBrush(brush);
  if (!tool().usesBrush()) activate(kBrushTool);
  refuse(refusal, {});  // what was said before is over
}

void Toolbox::stepShape(int by) {
  if (!m_document.plugins()) return;
  const std::vector<std::string> shapes = idsByLabel(*m_document.plugins(), PluginKind::Brush);
  if (const std::string* shape = further(shapes, m_brush.shape, by)) takeBrush(*shape);
}

void Toolbox::stepMaterial(int by) {
  std::vector<std::string> materials;
  for (const SceneMaterial& one : m_document.project().materials) materials.push_back(one.id);
  if (materials.empty()) return;
  const std::string& now = m_brush.material.empty() ? materials.front() : m_brush.material;
  if (const std::string* material = further(materials, now, by)) m_selection.setMaterial(*material);
}

double Toolbox::spacing() const {
  return numberOf(m_document.project().solver.parameters, solverParameters(), "particle_spacing");
}

std::pair<Vector3, bool> Toolbox::stamp(const Vector3& up) {
  const Stamp& known = stampNow(up);
  return {known.half, known.box};
}

std::shared_ptr<const StampForm> Toolbox::form(const Vector3& up) { return stampNow(up).form; }

const Toolbox::Stamp& Toolbox::stampNow(const Vector3& up) {
  const PluginRegistry* plugins = m_document.plugins();
  const api::BrushPlugin* plugin = plugins ? plugins->brush(m_brush.shape) : nullptr;
  if (!plugin) {
    Stamp& none = m_stamps[m_lastStamp] = {};
    none.half = Vector3::Constant(m_brush.radius);
    return none;
  }
  StrokeSetup setup = strokeSetup(m_brush, *plugins, spacing(), up);
  if (stampsShape()) setup.stamp = shapeCells();
  for (size_t k = 0; k < m_stamps.size(); ++k) {
    const Stamp& known = m_stamps[k];
    if (known.brush != m_brush.shape || known.spacing != setup.grid.spacing || known.radius != setup.radius ||
        known.parameters != setup.parameters || known.shape != setup.stamp || known.up != up)
      continue;
    m_lastStamp = k;
    return known;
  }
  const auto asked = inTime(m_brush.shape, [plugin, setup, draws = !touchesMatter()]() -> Said {
    Said said{vectorOf(plugin->extent(contextOf(setup))), plugin->extension(api::kBoxStamp) != nullptr};
    if (draws) said.form = formOf(*plugin, setup, said);
    return said;
  });
  if (!asked)
    QMetaObject::invokeMethod(
        this, [this, brush = m_brush.shape] { putAside(brush, kNotBack); }, Qt::QueuedConnection);
  const Said said = asked.value_or(Said{Vector3(Vector3::Constant(m_brush.radius)), false});
  m_lastStamp = 1 - m_lastStamp;
  return m_stamps[m_lastStamp] = {m_brush.shape, setup.grid.spacing, setup.radius, setup.parameters, setup.stamp, up,
                                  said.half,     said.box,           said.form};
}

}  // namespace ps
