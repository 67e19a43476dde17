// SPDX-License-Identifier: Apache-2.0
#include "ui/window/help.h"

#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/help/helpwindow.h"
#include "ui/help/parameterhelp.h"
#include "ui/panels/rowmodels.h"
#include "ui/rows/parameterrow.h"
#include "ui/tools/navigation.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/dock.h"
#include "ui/window/mainwindow.h"
#include "ui/window/paneltable.h"
#include "ui/window/shortcutswindow.h"
#include "ui/window/viewportpane.h"
#include "ui/window/welcome.h"

#include <QtGui/QAction>
#include <QtGui/QCursor>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMenu>

namespace ps {
namespace {

const QString kParameter = QStringLiteral("parameter/"), kTool = QStringLiteral("tool/"),
              kValues = QStringLiteral("values");
constexpr const char* kUsualPage = "first-steps";

/// The nearest of this kind among a widget and what it stands in.
template <class Widget>
Widget* around(QWidget* widget) {
  for (; widget; widget = widget->parentWidget()) {
    if (auto* found = qobject_cast<Widget*>(widget)) return found;
  }
  return nullptr;
}

const char* pageOf(const Dock& dock) {
  for (const PanelRow& row : panelTable()) {
    if (dock.objectName() == QLatin1String(row.dock) && dock.currentPage() == QLatin1String(row.title)) return row.help;
  }
  return kUsualPage;
}

/// Where a page tells of a brush, if it does: "sketching#fill".
QString placeOf(const QString& page, const std::string& brush) {
  const QString section = QString::fromStdString(brush);
  for (const HelpPage& written : writtenHelp()) {
    if (written.id == page && written.sections.contains(section)) return page + QLatin1Char('#') + section;
  }
  return page;
}

/// Pages name the drags that move a view as {look} and {turn}, and that of the brush's size {size}: which those are is
/// a preference.
HelpPage withMouse(HelpPage page, MousePreset preset) {
  page.text.replace(QStringLiteral("{look}"), howToLook(preset));
  page.text.replace(QStringLiteral("{turn}"), turningKeys(preset));
  page.text.replace(QStringLiteral("{size}"), sizeDrag(preset).text());
  return page;
}

}  // namespace

Help::Help(MainWindow& window, const Actions& actions) : QObject(&window), m_window(window), m_actions(actions) {}

void Help::makeMenu(QMenu* menu) {
  m_actions.add(menu, QStringLiteral("help.here"), QStringLiteral("Explain what is under the pointer"),
                {QKeySequence(QStringLiteral("F1"))}, [this] { openHere(); });
  QMenu* pages = menu->addMenu(QStringLiteral("Pages"));
  for (const HelpPage& written : writtenHelp()) {
    QAction* action = m_actions.add(pages, QStringLiteral("help.") + written.id, written.title, {},
                                    [this, id = written.id] { open(id); });
    action->setProperty(kWords, withMouse(written, MousePreset::PhaseSketch).text);
  }
  m_actions.add(pages, QStringLiteral("help.") + kValues, QStringLiteral("All values of this scene"), {},
                [this] { open(kValues); });
}

HelpWindow* Help::dialog() const { return m_window.findChild<HelpWindow*>(); }

void Help::open(const QString& id) {
  HelpWindow* dialog = this->dialog();
  if (!dialog) {
    dialog = new HelpWindow([this](const QString& wanted) { return page(wanted); }, &m_window);
    connect(dialog, &HelpWindow::actionWanted, this, [this](const QString& name) {
      if (QAction* action = m_actions.find(name)) action->trigger();
    });
    connect(&m_window.tools(), &Toolbox::mouseChanged, dialog, &HelpWindow::refresh);
  }
  dialog->open(id);
  dialog->show();
  dialog->raise();
}

void Help::openHere() { open(idHere()); }

std::string Help::brushInHand() const {
  return m_window.tools().active() == kEraseTool ? kEraseTool : m_window.tools().brush().shape;
}

/// Of brushes that work on what is there one asks what they do; of those that draw, with which keys.
QString Help::ofTool() const {
  const Toolbox& tools = m_window.tools();
  const bool works = tools.active() == kBrushTool && (tools.touchesMatter() || tools.reworks());
  const QString sketching = QStringLiteral("sketching"), place = placeOf(sketching, brushInHand());
  return works && place != sketching ? place : kTool + QString::fromStdString(tools.active());
}

QString Help::idHere() const {
  QWidget* pointed = QApplication::widgetAt(QCursor::pos());
  if (pointed && pointed->window() != &m_window) pointed = nullptr;
  QWidget* focused = m_window.focusWidget();
  for (QWidget* widget : {pointed, focused}) {
    if (const auto* row = around<ParameterRow>(widget)) return kParameter + row->key();
  }
  for (QWidget* widget : {pointed, focused}) {
    if (around<Viewport>(widget) || around<ViewportPane>(widget)) return ofTool();
    const auto* button = around<QAbstractButton>(widget);
    const std::string shape = button ? button->property("shape").toString().toStdString() : std::string();
    if (const auto* dock = around<Dock>(widget))
      return placeOf(QString::fromLatin1(pageOf(*dock)), shape.empty() ? brushInHand() : shape);
  }
  return QString::fromLatin1(kUsualPage);
}

std::optional<HelpPage> Help::page(const QString& id) const {
  for (const HelpPage& written : writtenHelp()) {
    if (written.id == id) return withMouse(written, m_window.tools().mouse());
  }
  if (id == kValues) return valuesPage();
  if (id.startsWith(kTool)) return toolPage(id.mid(kTool.size()));
  if (!id.startsWith(kParameter)) return std::nullopt;
  const Document& document = m_window.session().document();
  const QString key = id.mid(kParameter.size());
  // A row that is there knows most: at which temperature it is read, and where its default comes from.
  for (const ParameterRow* row : m_window.findChildren<ParameterRow*>()) {
    if (row->key() == key) return parameterHelp(row->model(), document);
  }
  const auto address = Address::parse(key.toStdString());
  const auto row = address ? rowModelOf(document, *address) : std::nullopt;
  return row ? std::optional(parameterHelp(*row, document)) : std::nullopt;
}

/// What the mouse and its keys do with it.
HelpPage Help::toolPage(const QString& id) const {
  const ToolRow* row = toolRow(id.toStdString());
  if (!row) return writtenHelp().front();
  const Tool& tool = m_window.tools().tool(row->id);
  QString html = QStringLiteral("<h1>%1</h1><p>%2. Its key is %3.</p><table>")
                     .arg(QString::fromLatin1(row->name).toHtmlEscaped(), QString::fromLatin1(row->tip).toHtmlEscaped(),
                          QString::fromLatin1(row->key));
  const auto add = [&html](const std::vector<Gesture>& gestures) {
    for (const Gesture& gesture : gestures) {
      html += QStringLiteral("<tr><td class='name'>%1&nbsp;&nbsp;</td><td>%2</td></tr>")
                  .arg(QString(gesture.keys).toHtmlEscaped(), QString(gesture.does).toHtmlEscaped());
    }
  };
  add(tool.gestures());
  add(viewGestures(tool));
  const QString sketching = QStringLiteral("sketching");
  html += QStringLiteral(
              "</table><p>More: <a href='help:%1'>Sketching</a>, "
              "<a href='help:first-steps'>First steps</a>.</p>")
              .arg(tool.usesBrush() ? placeOf(sketching, brushInHand()) : sketching);
  return {kTool + id, QString::fromLatin1(row->name), html, true};
}

/// One line each, by whom they belong to.
HelpPage Help::valuesPage() const {
  const Document& document = m_window.session().document();
  const QString title = QStringLiteral("All values of this scene");
  QString html = QStringLiteral("<h1>%1</h1>").arg(title), owner;
  for (const Address& address : allAddresses(document.project(), document.plugins())) {
    const api::ParameterDeclaration* declaration = document.declaration(address);
    if (!declaration) continue;
    const QString whose = ownerLabel(document.project(), address);
    if (whose != owner) html += QStringLiteral("<h3>%1</h3>").arg(whose.toHtmlEscaped());
    owner = whose;
    html += QStringLiteral("<p><a href='help:%1'>%2</a><br>%3</p>")
                .arg(kParameter + QString::fromStdString(address.text()).toHtmlEscaped(),
                     QString::fromUtf8(declaration->label).toHtmlEscaped(),
                     QString::fromUtf8(declaration->help).toHtmlEscaped());
  }
  return {kValues, title, html, true};
}

}  // namespace ps
