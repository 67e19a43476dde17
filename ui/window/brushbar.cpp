// SPDX-License-Identifier: Apache-2.0
#include "ui/window/brushbar.h"

#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/materialspanel.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/swatches.h"
#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/viewport/viewport.h"
#include "ui/window/sketchactions.h"
#include "ui/window/workspacekeys.h"

#include <QtGui/QAction>
#include <QtGui/QPainter>
#include <QtWidgets/QButtonGroup>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

#include <functional>
#include <utility>

namespace ps {
namespace {

constexpr int kIcon = 20, kGap = 2, kBall = 26;  // px
constexpr const char* kShape = "shape";          // property of a button: id of its brush
constexpr const char* kMaterial = "material";    // of its material

/// A picture, or where there is none the first letters of its name; and in its corner the key that does the same.
class BarButton : public QToolButton {
 public:
  BarButton(const QString& name, const QString& iconName) : m_name(name), m_icon(iconName) {
    setObjectName(QStringLiteral("psBarButton"));
    setFixedSize(BrushBar::kButton, BrushBar::kButton);
    setIconSize({kIcon, kIcon});
    if (!m_icon.isEmpty()) setIcon(ps::icon(m_icon));
    setCheckable(true);
    setFocusPolicy(Qt::TabFocus);
    setKey({});
  }
  void setKey(const QString& key) {
    m_key = key;
    const QString name = key.isEmpty() ? m_name : QStringLiteral("%1 (%2)").arg(m_name, key);
    setToolTip(m_help.isEmpty() ? name : name + QLatin1Char('\n') + m_help);
    setAccessibleName(name);
    update();
  }
  /// What its tip says below its name.
  void setHelp(const QString& help) {
    m_help = help;
    setKey(m_key);
  }
  void setPicture(std::function<void(QPainter&, const QRectF&)> picture) { m_picture = std::move(picture); }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QToolButton::paintEvent(event);
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Theme& theme = Theme::current();
    const QRectF all = rect();
    if (m_picture) {
      m_picture(painter, QRectF((width() - kBall) / 2.0, (height() - kBall) / 2.0, kBall, kBall));
    } else if (m_icon.isEmpty()) {
      paintText(painter, all, Qt::AlignCenter, m_name.left(2), Theme::font(TextRole::Heading), theme[Token::Text2]);
    }
    if (isChecked()) paintBox(painter, all.adjusted(0.5, 0.5, -0.5, -0.5), {}, theme[Token::Accent], 5);
    if (m_key.size() == 1)
      paintText(painter, all.adjusted(0, 0, -4, -1), Qt::AlignRight | Qt::AlignBottom, m_key,
                Theme::font(TextRole::Small), theme[isChecked() || underMouse() ? Token::Text2 : Token::Muted]);
  }

 private:
  QString m_name, m_icon, m_key, m_help;
  std::function<void(QPainter&, const QRectF&)> m_picture;
};

/// The key that an action of the menus has in Sketch; it may get it later than the bar gets its button.
void showKeyOf(const QString& action, BarButton* button) {
  QMetaObject::invokeMethod(
      button,
      [action, button] {
        const auto* found = button->window()->findChild<QAction*>(action);
        const QList<QKeySequence> keys = found ? keysIn(*found, KeysIn::Sketch) : QList<QKeySequence>();
        if (!keys.isEmpty()) button->setKey(keys.front().toString(QKeySequence::NativeText));
      },
      Qt::QueuedConnection);
}

/// As high as what it shows, where there is room.
class BrushList : public QScrollArea {
 public:
  QSize sizeHint() const override { return widget() ? widget()->sizeHint() : QScrollArea::sizeHint(); }

 protected:
  /// Buttons that are added while the bar is hidden count only when they are shown.
  bool eventFilter(QObject* object, QEvent* event) override {
    if (object == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return QScrollArea::eventFilter(object, event);
  }
};

}  // namespace

BrushBar::BrushBar(Session& session, Selection& selection, Toolbox& tools, Viewport* view, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_selection(selection),
      m_tools(tools),
      m_view(view),
      m_list(new QWidget),
      m_shapes(new QButtonGroup(this)),
      m_matter(new QButtonGroup(this)) {
  setFixedWidth(kWidth);
  auto* column = new QVBoxLayout(m_list);
  column->setContentsMargins(0, 6, 0, 0);
  column->setSpacing(4);
  m_draw = addGroup(QStringLiteral("Draw"), m_list);
  m_change = addGroup(QStringLiteral("Change"), m_list);
  m_touch = addGroup(QStringLiteral("Touch"), m_list);
  auto* scroll = new BrushList;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(m_list);
  scroll->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 4);
  all->setSpacing(4);
  all->addWidget(scroll);
  m_materials = addGroup(QStringLiteral("Material"), this);
  all->addStretch(1);
  addCommon();
  for (QButtonGroup* group : {m_shapes, m_matter})
    connect(group, &QButtonGroup::buttonClicked, this, &BrushBar::clicked);
  connect(&session, &Session::ready, this, &BrushBar::addBrushes);
  connect(&session.swatches(), &Swatches::arrived, this, qOverload<>(&QWidget::update));
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event) || std::holds_alternative<MaterialsChanged>(event)) addMaterials();
  });
  connect(&selection, &Selection::materialChanged, this, &BrushBar::showMaterial);
  connect(&tools, &Toolbox::toolChanged, this, &BrushBar::showBrush);
  connect(&tools, &Toolbox::brushChanged, this, &BrushBar::showBrush);
  addMaterials();
  showBrush();
}

BrushBar::Group BrushBar::addGroup(const QString& title, QWidget* into) {
  Group group{new QWidget, nullptr};
  group.grid = new QGridLayout(group.box);
  group.grid->setContentsMargins((kWidth - 2 * kButton - kGap) / 2, 0, 0, 4);
  group.grid->setSpacing(kGap);
  group.grid->setColumnStretch(2, 1);
  auto* heading = new QLabel(title);
  heading->setProperty("role", "muted");
  heading->setFixedWidth(2 * kButton + kGap);
  heading->setAlignment(Qt::AlignHCenter);
  group.grid->addWidget(heading, 0, 0, 1, 2);
  into->layout()->addWidget(group.box);
  return group;
}

void BrushBar::place(const Group& group, QAbstractButton* button) {
  const int place = group.grid->count() - 1;  // the heading is the first
  group.grid->addWidget(button, 1 + place / 2, place % 2);
}

void BrushBar::addCommon() {
  auto* erase = new BarButton(QStringLiteral("Erase matter"), QStringLiteral("erase"));
  auto* mirror = new BarButton(QStringLiteral("Mirror what is drawn"), QStringLiteral("mirror"));
  showKeyOf(QStringLiteral("sketch.") + QLatin1String(kEraseTool), erase);
  showKeyOf(QStringLiteral("sketch.mirror"), mirror);
  connect(erase, &QToolButton::clicked, this, [this] {
    m_tools.activate(m_tools.active() == kEraseTool ? kBrushTool : kEraseTool);
    clicked(m_erase);
  });
  connect(mirror, &QToolButton::clicked, this, [this] {
    BrushSettings brush = m_tools.brush();
    brush.symmetry.mirror = brush.symmetry.mirror == "none" ? "x" : "none";
    m_tools.setBrush(brush);
    clicked(m_mirror);
  });
  m_more = new BarButton(QStringLiteral("Material from the library"), QStringLiteral("plus"));
  m_more->setCheckable(false);  // it opens a page
  connect(m_more, &QToolButton::clicked, this, [this] {
    if (auto* library = window()->findChild<QAction*>(QStringLiteral("add.library"))) library->trigger();
  });
  place(m_change, m_erase = erase);
  place(m_change, m_mirror = mirror);
}

void BrushBar::addBrushes() {
  const PluginRegistry* plugins = m_session.plugins();
  const auto needs = [&](const std::string& id, const char* what) { return plugins->needs(id, what); };
  for (const std::string& id : idsByLabel(*plugins, PluginKind::Brush)) {
    const QString name = QString::fromStdString(id);
    auto* button = new BarButton(pluginLabel(plugins, id), iconNames().contains(name) ? name : QString());
    button->setProperty(kShape, name);
    const QString help = QString::fromUtf8(plugins->brush(id)->help());
    button->setHelp(help.section(QStringLiteral(". "), 0, 0));  // all of it is on the brush's page
    showKeyOf(QStringLiteral("sketch.shape.") + name, button);
    m_shapes->addButton(button);
    const bool changes =
        needs(id, api::kPaintsMatter) || needs(id, api::kColoursMatter) || needs(id, api::kSmoothsMatter);
    place(changes ? m_change : needs(id, api::kTouchesMatter) ? m_touch : m_draw, button);
  }
  addMaterials();
  showBrush();
}

/// Those of the scene that have keys; others are in the panel of materials.
void BrushBar::addMaterials() {
  for (QAbstractButton* button : m_matter->buttons()) {
    m_matter->removeButton(button);
    m_materials.grid->removeWidget(button);
    button->hide();
    button->deleteLater();  // it may be the one that was clicked
  }
  m_materials.grid->removeWidget(m_more);
  const Project& project = m_session.document().project();
  for (const SceneMaterial& material : project.materials) {
    const auto number = static_cast<int>(m_matter->buttons().size());
    if (number == kMaterialKeys) break;
    auto* button = new BarButton(QString::fromStdString(shownName(material)), {});
    showKeyOf(materialAction(number), button);
    button->setProperty(kMaterial, QString::fromStdString(material.id));
    // Asked for as it is painted: a slider may have given it another look.
    button->setPicture([this, id = material.id](QPainter& painter, const QRectF& square) {
      const Document& document = m_session.document();
      paintSwatch(painter, square, swatchOf(document.project(), document.plugins(), id), m_session.swatches());
    });
    m_matter->addButton(button);
    place(m_materials, button);
    button->show();
  }
  place(m_materials, m_more);
  showMaterial();
}

/// What a click takes in hand is for the view, and so are the keys that follow.
void BrushBar::clicked(const QAbstractButton* button) {
  if (m_view && !button->hasFocus()) m_view->setFocus(Qt::OtherFocusReason);
  const std::string shape = button->property(kShape).toString().toStdString();
  const std::string material = button->property(kMaterial).toString().toStdString();
  if (!shape.empty()) m_tools.takeBrush(shape);
  if (!material.empty()) m_selection.setMaterial(material);
  showBrush();
}

void BrushBar::showBrush() {
  const QString shape = QString::fromStdString(m_tools.brush().shape);
  for (QAbstractButton* button : m_shapes->buttons()) button->setChecked(button->property(kShape).toString() == shape);
  m_erase->setChecked(m_tools.active() == kEraseTool);
  m_mirror->setChecked(m_tools.brush().symmetry.mirror != "none");
}

void BrushBar::showMaterial() {
  const QString now = QString::fromStdString(m_selection.material());
  for (QAbstractButton* button : m_matter->buttons()) button->setChecked(button->property(kMaterial).toString() == now);
}

void BrushBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Panel]);
}

}  // namespace ps
