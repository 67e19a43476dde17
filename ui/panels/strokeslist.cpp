// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/strokeslist.h"

#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "core/sketch/cellset.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/strokerecord.h"
#include "ui/panels/strokelistedits.h"
#include "ui/rows/groupheading.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/tools/brushsettings.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"

#include <QtCore/QTimer>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QAccessibleWidget>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ps {
namespace {

constexpr int kMostShown = 8;
const QString kKeys = QStringLiteral(
    "Del removes the stroke; a drag, Alt+Up and Alt+Down draw it earlier or later; W moves it in the view; the other "
    "mouse button gives it another material, hides it, as does the eye, or has it drawn anew. The sketch is drawn "
    "again from them.");
const QString kNone = QStringLiteral("Strokes of the body that is selected are listed here");

double lengthOf(const VoxelShape::Stroke& stroke) {
  double length = 0;
  for (size_t i = 1; i < stroke.samples.size(); ++i) {
    double square = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double step = stroke.samples[i][k] - stroke.samples[i - 1][k];
      square += step * step;
    }
    length += std::sqrt(square);
  }
  return length;
}

QString nameOf(const VoxelShape::Stroke& stroke, const PluginRegistry* plugins) {
  QString name = pluginLabel(plugins, stroke.brush);
  if (stroke.erase) name += QStringLiteral(", erased");
  if (!stroke.symmetry) return name;
  if (stroke.symmetry->mirror != "none") name += QStringLiteral(", in a mirror");
  if (stroke.symmetry->turns > 1) name += QStringLiteral(" ×%1").arg(stroke.symmetry->turns);
  return name;
}

/// Of the matter that it leaves: one that erases, smooths or colours leaves none of its own.
QColor matterOf(const VoxelShape::Stroke& stroke, const VoxelShape& shape, const Document& document) {
  const PluginRegistry* plugins = document.plugins();
  const auto needs = [&](const char* what) { return plugins && plugins->needs(stroke.brush, what); };
  const auto entry = static_cast<size_t>(stroke.palette);
  if (stroke.erase || needs(api::kSmoothsMatter) || needs(api::kColoursMatter) || entry >= shape.palette.size())
    return {};
  return colourOf(document.project(), plugins, shape.palette[entry].material);
}

}  // namespace

/// What is painted; it holds the keys.
class StrokesList::Rows : public QWidget {
 public:
  explicit Rows(StrokesList& list) : m_list(list) {
    setFocusPolicy(Qt::TabFocus);
    setAccessibleName(QStringLiteral("Strokes"));
    setToolTip(kKeys);
  }
  /// Nothing is dragged any more: the lines are others.
  void letGo() {
    m_held.reset();
    m_drop = -1;
    update();
  }
  QSize sizeHint() const override { return {120, kRow * std::max(1, static_cast<int>(m_list.m_lines.size())) + 4}; }
  QSize minimumSizeHint() const override { return {80, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Theme& theme = Theme::current();
    painter.fillRect(rect(), theme[Token::Panel]);
    if (m_list.m_lines.empty())
      paintText(painter, QRectF(12, 0, width() - 20, kRow), Qt::AlignVCenter, kNone, Theme::font(TextRole::Small),
                theme[Token::Muted]);
    for (int i = 0; i < static_cast<int>(m_list.m_lines.size()); ++i) paintLine(painter, i);
    if (m_held && m_drop >= 0 && m_drop != m_held->line) {
      const int edge = (m_drop > m_held->line ? m_drop + 1 : m_drop) * kRow;
      painter.fillRect(QRectF(8, edge - 1, width() - 16, 2), theme[Token::Accent]);
    }
    if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 4);
  }
  void mousePressEvent(QMouseEvent* event) override {
    m_list.setCurrent(lineAt(event->position()));
    setFocus(Qt::MouseFocusReason);
    letGo();
    const int line = m_list.m_current;
    if (event->button() == Qt::LeftButton && line >= 0 && eyeOf(line, width()).contains(event->position()))
      return m_list.turnHidden(line);
    if (event->button() == Qt::LeftButton && m_list.m_current >= 0)
      m_held = Held{event->position(), m_list.m_body, m_list.m_current};
  }
  /// A line that is dragged is drawn where it is let go.
  void mouseMoveEvent(QMouseEvent* event) override {
    if (!m_held) return;
    const bool far = std::abs(event->position().y() - m_held->at.y()) >= QApplication::startDragDistance();
    if (!far && m_drop < 0) return;
    m_drop = std::clamp(lineAt(event->position()), 0, static_cast<int>(m_list.m_lines.size()) - 1);
    update();
  }
  void mouseReleaseEvent(QMouseEvent*) override {
    const std::optional<Held> held = m_held;
    const int drop = m_drop;
    letGo();
    if (held && drop >= 0 && drop != held->line)
      m_list.m_edits->move(held->body, static_cast<size_t>(held->line), static_cast<size_t>(drop));
  }
  void contextMenuEvent(QContextMenuEvent* event) override {
    const bool byKey = event->reason() == QContextMenuEvent::Keyboard;
    if (!byKey) m_list.setCurrent(event->pos().y() / kRow);
    if (m_list.m_current < 0) return;
    QMenu* menu = m_list.menuOf(m_list.m_current);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->popup(byKey ? mapToGlobal(QPoint(36, (m_list.m_current + 1) * kRow)) : event->globalPos());
  }
  bool event(QEvent* event) override {
    if (event->type() == QEvent::ShortcutOverride && isOwn(*static_cast<QKeyEvent*>(event))) {
      event->accept();
      return true;
    }
    return QWidget::event(event);
  }
  void keyPressEvent(QKeyEvent* event) override {
    if (!isOwn(*event) || !m_list.act(*event)) QWidget::keyPressEvent(event);
  }

 private:
  static int lineAt(const QPointF& place) { return static_cast<int>(std::floor(place.y() / kRow)); }
  static bool isOwn(const QKeyEvent& event) {
    const bool plain = event.modifiers() == Qt::NoModifier || event.modifiers() == Qt::KeypadModifier;
    const int key = event.key();
    if (key == Qt::Key_Up || key == Qt::Key_Down) return plain || event.modifiers() == Qt::AltModifier;
    return plain && (key == Qt::Key_Home || key == Qt::Key_End || key == Qt::Key_Delete);
  }
  void paintLine(QPainter& painter, int index) const {
    const Theme& theme = Theme::current();
    const Line& line = m_list.m_lines[static_cast<size_t>(index)];
    const QRectF row(0, index * kRow, width(), kRow);
    const bool current = index == m_list.m_current;
    if (current) painter.fillRect(row, theme[Token::Selection]);
    const QColor ink = theme[line.hidden ? Token::Disabled : Token::Text];
    paintIcon(painter, QRectF(12, row.center().y() - 8, 16, 16), line.icon, line.hidden ? ink : theme[Token::Text2]);
    const QRectF eye = eyeOf(index, width());
    paintIcon(painter, eye.adjusted(2, 2, -2, -2), line.hidden ? QStringLiteral("eye-off") : QStringLiteral("eye"),
              line.hidden ? ink : theme[current ? Token::Text2 : Token::Muted]);
    double right = eye.left() - 4;
    if (line.colour.isValid())
      paintBox(painter, QRectF(right - 11, row.center().y() - 5.5, 11, 11), line.colour, theme[Token::Line2], 5.5);
    right -= 19;
    const QFont small = Theme::font(TextRole::Small);
    const double wide = textWidth(line.length, small) + 1;
    paintText(painter, QRectF(right - wide, row.top(), wide, kRow), Qt::AlignVCenter | Qt::AlignRight, line.length,
              small, line.hidden ? ink : theme[current ? Token::Text2 : Token::Muted]);
    paintText(painter, QRectF(36, row.top(), right - wide - 44, kRow), Qt::AlignVCenter, line.name,
              Theme::font(TextRole::Normal), ink);
  }

  StrokesList& m_list;
  struct Held {
    QPointF at;
    std::string body;
    int line = 0;
  };
  std::optional<Held> m_held;
  int m_drop = -1;  ///< the line in whose place it is let go; -1: it is not dragged yet
};

StrokesList::StrokesList(Session& session, Toolbox& tools, QWidget* parent)
    : QWidget(parent),
      m_document(session.document()),
      m_tools(tools),
      m_selection(tools.selection()),
      m_edits(new StrokeListEdits(session, this)),
      m_heading(new GroupHeading(QStringLiteral("Strokes"))),
      m_rows(new Rows(*this)) {
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(m_rows);
  m_scroll = scroll;
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(m_heading);
  column->addWidget(scroll);
  connect(m_heading, &GroupHeading::foldedChanged, m_scroll, [this](bool folded) { m_scroll->setVisible(!folded); });
  connect(&m_selection, &Selection::changed, this, [this] {
    m_current = -1;  // the body as a whole
    m_anew.reset();
    refresh();
  });
  connect(&tools, &Toolbox::strokeMoved, this,
          [this](const ChosenStroke& stroke, const Vector3& way) { m_edits->carry(stroke.body, stroke.index, way); });
  connect(&tools, &Toolbox::toolChanged, this, [this] {
    m_anew.reset();
    refreshHeading();
  });
  connect(&m_document, &Document::changed, this, [this](const ChangeEvent& event) {
    if (const auto* stroke = std::get_if<StrokeChanged>(&event)) {
      onStroke(*stroke);
    } else if (std::holds_alternative<ProjectOpened>(event)) {
      m_drawn.clear();
      m_anew.reset();
    } else if (const auto* body = std::get_if<BodyChanged>(&event)) {
      if (m_anew && body->id == m_anew->body) m_anew.reset();
    } else if (!std::holds_alternative<MaterialsChanged>(event)) {
      return;
    }
    refresh();
  });
  connect(m_edits, &StrokeListEdits::busyChanged, this, &StrokesList::refresh);
  connect(m_edits, &StrokeListEdits::edited, this, [this](size_t stroke) { setCurrent(static_cast<int>(stroke)); });
  refresh();
}

void StrokesList::onStroke(const StrokeChanged& event) {
  const StrokeRecord& stroke = *event.stroke;
  if (!event.live) m_anew.reset();  // its number may be another one's now
  if (stroke.body.empty()) return;
  m_drawn = stroke.body;
  if (!m_anew || !stroke.material.empty() || stroke.erase || !stroke.deed.empty()) return;
  // Once the step that drew it stands: it is taken back, and what takes its place is the only one.
  QTimer::singleShot(0, this, [this, body = stroke.body, before = m_document.undoStack().position()] {
    takeAnew(body, m_document.undoStack().position() == before + 1);
  });
}

/// Where the place cannot be taken, what was drawn stays by itself; so it does where another hand has made a step
/// since.
void StrokesList::takeAnew(const std::string& body, bool isLast) {
  const std::optional<ChosenStroke> place = std::exchange(m_anew, std::nullopt);
  refreshHeading();
  const VoxelShape *drawn = sketch(body), *own = place ? sketch(place->body) : nullptr;
  if (!isLast || !drawn || !own || !m_edits->isPossible(place->body, place->index)) return;
  VoxelShape::Stroke stroke = drawn->strokes.back();
  if (drawn != own) {
    const RigidMove way = gridOf(*own).pose.inverse();
    const RigidMove from = gridOf(*drawn).pose;
    for (auto& sample : stroke.samples) {
      const Vector3 at = way.of(from.of(Vector3(sample[0], sample[1], sample[2])));
      for (int k = 0; k < 3; ++k) sample[static_cast<size_t>(k)] = at[k];
    }
    stroke.up = way.turn * (from.turn * stroke.up);
  }
  m_document.undoStack().undo();
  m_drawn = place->body;  // what was drawn is part of it now
  refresh();
  m_edits->replace(place->body, place->index, std::move(stroke));
}

void StrokesList::drawAnew(int line) {
  const VoxelShape* shape = sketch(m_body);
  if (!shape || line < 0 || line >= static_cast<int>(m_lines.size())) return;
  const VoxelShape::Stroke& stroke = shape->strokes[static_cast<size_t>(line)];
  m_tools.activate(kBrushTool);
  m_tools.takeBrush(stroke.brush);
  BrushSettings brush = m_tools.brush();
  brush.radius = stroke.radius;
  brush.parameters[stroke.brush] = stroke.parameters;
  brush.material = shape->palette[static_cast<size_t>(stroke.palette)].material;
  brush.temperature = shape->palette[static_cast<size_t>(stroke.palette)].temperature;
  brush.symmetry = stroke.symmetry.value_or(VoxelShape::Symmetry{});
  m_selection.setMaterial(brush.material);
  m_tools.setBrush(brush);
  m_anew = ChosenStroke{m_body, static_cast<size_t>(line)};
  refreshHeading();
}

void StrokesList::turnHidden(int line) {
  if (line < 0 || line >= static_cast<int>(m_lines.size())) return;
  const auto at = static_cast<size_t>(line);
  m_edits->setHidden(m_body, at, !m_lines[at].hidden);
}

void StrokesList::choose() {
  const bool any = m_current >= 0 && !m_body.empty();
  m_tools.choose(any ? std::optional(ChosenStroke{m_body, static_cast<size_t>(m_current)}) : std::nullopt);
}

bool StrokesList::act(const QKeyEvent& event) {
  const int last = static_cast<int>(m_lines.size()) - 1, step = event.key() == Qt::Key_Up ? -1 : 1;
  switch (event.key()) {
    case Qt::Key_Home:
      setCurrent(0);
      return true;
    case Qt::Key_End:
      setCurrent(last);
      return true;
    case Qt::Key_Delete:
      if (m_current >= 0) m_edits->remove(m_body, static_cast<size_t>(m_current));
      return true;
    default:
      const int to = std::clamp(m_current + step, 0, std::max(0, last));
      if (event.modifiers() != Qt::AltModifier)
        setCurrent(to);
      else if (m_current >= 0)
        m_edits->move(m_body, static_cast<size_t>(m_current), static_cast<size_t>(to));
      return true;
  }
}

QMenu* StrokesList::menuOf(int line) {
  auto* menu = new QMenu(this);
  const auto at = static_cast<size_t>(line);
  const auto add = [&](QMenu* to, const QString& text, auto&& what) {
    QAction* action = to->addAction(text);
    connect(action, &QAction::triggered, this, what);
    return action;
  };
  add(menu, QStringLiteral("Remove\tDel"), [this, at] { m_edits->remove(m_body, at); });
  add(menu, QStringLiteral("Draw earlier\tAlt+Up"), [this, at] {
    m_edits->move(m_body, at, at - 1);
  })->setEnabled(line > 0);
  add(menu, QStringLiteral("Draw later\tAlt+Down"), [this, at] {
    m_edits->move(m_body, at, at + 1);
  })->setEnabled(at + 1 < m_lines.size());
  const bool leavesMatter = m_lines[at].colour.isValid();
  add(menu, QStringLiteral("Move\tW"), [this, line] {
    setCurrent(line);
    m_tools.activate("move");
  });
  add(menu, QStringLiteral("Draw anew"), [this, line] { drawAnew(line); })->setEnabled(leavesMatter);
  add(menu, m_lines[at].hidden ? QStringLiteral("Show") : QStringLiteral("Hide"), [this, line] { turnHidden(line); });
  QMenu* materials = menu->addMenu(QStringLiteral("Material"));
  materials->setEnabled(leavesMatter);
  for (const SceneMaterial& material : m_document.project().materials)
    add(materials, QString::fromStdString(shownName(material)),
        [this, at, id = material.id] { m_edits->setMaterial(m_body, at, id); });
  return menu;
}

const VoxelShape* StrokesList::sketch(const std::string& id) const {
  const Body* body = m_document.body(id);
  const auto* shape = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
  return shape && !shape->strokes.empty() ? shape : nullptr;
}

void StrokesList::refresh() {
  m_rows->letGo();
  const std::string selected = m_selection.body();
  const std::string body = sketch(selected) ? selected : selected.empty() && sketch(m_drawn) ? m_drawn : "";
  if (body != m_body) m_current = -1;
  m_body = body;
  m_lines.clear();
  const PluginRegistry* plugins = m_document.plugins();
  if (const VoxelShape* shape = sketch(body)) {
    for (const VoxelShape::Stroke& stroke : shape->strokes) {
      const QString brush = QString::fromStdString(stroke.brush);
      const double length = lengthOf(stroke);
      m_lines.push_back({stroke.erase                  ? QStringLiteral("erase")
                         : iconNames().contains(brush) ? brush
                                                       : QStringLiteral("brush"),
                         nameOf(stroke, plugins), length > 0 ? lengthText(length) : QString(),
                         matterOf(stroke, *shape, m_document), stroke.hidden});
    }
  }
  m_current = std::min(m_current, static_cast<int>(m_lines.size()) - 1);
  refreshHeading();
  choose();
  const int shown = std::clamp(static_cast<int>(m_lines.size()), 1, kMostShown);
  m_scroll->setFixedHeight(shown * kRow + 4);
  m_rows->updateGeometry();
  m_rows->update();
}

void StrokesList::refreshHeading() {
  const Body* body = m_document.body(m_body);
  m_heading->setCount(
      m_lines.empty()   ? QString()
      : m_edits->busy() ? QStringLiteral("drawing again …")
      : m_anew && m_anew->body == m_body
          ? QStringLiteral("draw stroke %1 now …").arg(m_anew->index + 1)
          : QStringLiteral("%1 of %2").arg(m_lines.size()).arg(body ? QString::fromStdString(body->name) : QString()));
}

void StrokesList::setCurrent(int line) {
  m_current = line >= 0 && line < static_cast<int>(m_lines.size()) ? line : -1;
  if (m_current >= 0) {
    const Line& now = m_lines[static_cast<size_t>(m_current)];
    m_rows->setAccessibleDescription(QStringLiteral("%1, %2").arg(now.name, now.length) +
                                     (now.hidden ? QStringLiteral(", hidden") : QString()));
    static_cast<QScrollArea*>(m_scroll)->ensureVisible(0, m_current * kRow + kRow / 2, 0, kRow / 2);
  }
  choose();
  m_rows->update();
}

}  // namespace ps
