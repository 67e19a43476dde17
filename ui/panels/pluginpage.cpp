// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/pluginpage.h"

#include "core/plugin_host/pluginpaths.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/enginethread.h"
#include "ui/document/document.h"
#include "ui/rows/filterfield.h"
#include "ui/session/messagelog.h"
#include "ui/session/session.h"
#include "ui/session/worker.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

#include <QtCore/QDir>
#include <QtCore/QEvent>
#include <QtCore/QPointer>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtGui/QPainter>
#include <QtGui/QStandardItemModel>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QTreeView>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kId = Qt::UserRole + 1;

QString kindText(PluginKind kind) {
  const QString name = QString::fromLatin1(pluginKindName(kind));
  return name.left(1).toUpper() + name.mid(1);
}

QString nameOf(const PluginInfo& plugin) {
  if (!plugin.label.empty()) return QString::fromStdString(plugin.label);
  if (!plugin.id.empty()) return QString::fromStdString(plugin.id);
  return QDir(QString::fromStdString(plugin.path)).dirName();
}

QString stateText(const PluginInfo& plugin) {
  switch (plugin.state) {
    case PluginInfo::State::Loaded:
      return QStringLiteral("Loaded");
    case PluginInfo::State::Refused:
      return QStringLiteral("Not loaded");
    case PluginInfo::State::Quarantined:
      return QStringLiteral("In quarantine");
  }
  return {};
}

}  // namespace

PluginPage::PluginPage(Session& session, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_model(new QStandardItemModel(this)),
      m_view(new QTreeView),
      m_summary(new QLabel),
      m_details(new QLabel),
      m_filter(new QLineEdit),
      m_nothing(new NothingFound(*m_filter)),
      m_again(new QPushButton),
      m_folder(new QPushButton(QStringLiteral("Look in a folder…"))) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);  // no page makes the window wider while another shows
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 12, 16, 12);
  column->setSpacing(10);
  column->addLayout(makeHead());
  m_view->setModel(m_model);
  m_view->setRootIsDecorated(false);
  m_view->setUniformRowHeights(true);
  m_view->setAllColumnsShowFocus(true);
  m_view->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_view->setAccessibleName(QStringLiteral("Plugins"));
  column->addWidget(m_view, 1);
  column->addWidget(m_nothing, 1);
  column->addLayout(makeFoot());
  connect(m_view->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &PluginPage::showDetails);
  connect(&session, &Session::ready, this, [this, &session] {
    m_registry = session.plugins();
    refresh();
  });
  connect(&session, &Session::happened, this, [this](const EngineEvent& event) {
    if (event.flags & static_cast<StepFlags>(StepFlag::PluginFault)) refresh();
  });
}

QHBoxLayout* PluginPage::makeHead() {
  auto* head = new QHBoxLayout;
  auto* title = new QLabel(QStringLiteral("Plugins"));
  title->setFont(Theme::font(TextRole::Title));
  m_summary->setProperty("role", "text2");
  m_filter->setObjectName(QStringLiteral("psFilter"));
  m_filter->setPlaceholderText(QStringLiteral("Name, kind, author"));
  m_filter->setMinimumWidth(60);
  m_filter->setMaximumWidth(170);
  m_filter->setAccessibleName(QStringLiteral("Filter plugins"));
  connect(m_filter, &QLineEdit::textChanged, this, &PluginPage::filter);
  auto* copy = new QPushButton(QStringLiteral("Copy list"));
  auto* back = new QPushButton(QStringLiteral("Back to the scene"));
  connect(copy, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(lines().join(QLatin1Char('\n'))); });
  connect(back, &QPushButton::clicked, this, &PluginPage::closeRequested);
  head->addWidget(title);
  head->addSpacing(8);
  head->addWidget(m_summary);
  head->addStretch(1);
  head->addWidget(m_filter, 2);
  head->addWidget(copy);
  head->addWidget(back);
  return head;
}

/// What is said of the row that is chosen, and what can be done about it.
QHBoxLayout* PluginPage::makeFoot() {
  m_details->setWordWrap(true);
  m_details->setTextFormat(Qt::RichText);
  m_details->setTextInteractionFlags(Qt::TextSelectableByMouse);
  m_details->setMinimumHeight(110);
  m_details->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  auto* foot = new QHBoxLayout;
  foot->setSpacing(16);
  foot->addWidget(m_details, 1);
  foot->addWidget(m_again, 0, Qt::AlignTop);
  foot->addWidget(m_folder, 0, Qt::AlignTop);
  m_again->setToolTip(QStringLiteral("Loads it in a process of its own, which it may take down, and allows it again"));
  m_again->hide();
  m_folder->setToolTip(QStringLiteral("Installs it from a folder that it was downloaded to or built in"));
  m_folder->hide();
  connect(m_folder, &QPushButton::clicked, this, [this] {
    if (const MissingPlugin* missing = missingAt(m_view->currentIndex())) Q_EMIT folderWanted(missing->id);
  });
  connect(m_again, &QPushButton::clicked, this, [this] {
    if (const PluginInfo* shown = pluginAt(m_view->currentIndex())) tryAgain(std::string(shown->id));
  });
  return foot;
}

QString PluginPage::summary() const {
  if (!m_registry) return QStringLiteral("Loading…");
  int loaded = 0, broken = 0;
  for (const PluginInfo& plugin : m_registry->plugins()) {
    ++(plugin.state == PluginInfo::State::Loaded ? loaded : broken);
  }
  return broken == 0 ? QStringLiteral("%1 loaded").arg(loaded)
                     : QStringLiteral("%1 loaded, %2 not").arg(loaded).arg(broken);
}

void PluginPage::refresh() {
  m_model->clear();
  m_model->setHorizontalHeaderLabels({QStringLiteral("Plugin"), QStringLiteral("Kind"), QStringLiteral("Version"),
                                      QStringLiteral("API"), QStringLiteral("Licence"), QStringLiteral("State"),
                                      QStringLiteral("Problem")});
  m_summary->setText(summary());
  if (!m_registry) return;
  const Theme& theme = Theme::current();
  const auto& plugins = m_registry->plugins();
  for (size_t i = 0; i < plugins.size(); ++i) {
    const PluginInfo& plugin = plugins[i];
    const bool good = plugin.state == PluginInfo::State::Loaded;
    QList<QStandardItem*> row;
    for (const QString& text : {nameOf(plugin), plugin.id.empty() ? QStringLiteral("—") : kindText(plugin.kind),
                                QString::fromStdString(plugin.version), QString::fromStdString(plugin.api),
                                QString::fromStdString(plugin.licence), stateText(plugin),
                                QString::fromStdString(good ? plugin.note : plugin.problem)}) {
      row << new QStandardItem(text);
      row.back()->setForeground(theme[Token::Text2]);
    }
    row[0]->setForeground(theme[Token::Text]);
    row[0]->setData(static_cast<int>(i), kId);
    row[0]->setIcon(QIcon(iconPixmap(good ? QStringLiteral("check") : QStringLiteral("warning"),
                                     theme[good ? Token::Ok : Token::Error], 16, devicePixelRatioF())));
    if (!good) {
      row[5]->setForeground(theme[Token::Error]);
      row[6]->setForeground(theme[Token::Error]);
    }
    row[6]->setToolTip(row[6]->text());
    // What needs attention stands on top.
    if (good) {
      m_model->appendRow(row);
    } else {
      m_model->insertRow(0, row);
    }
  }
  addMissing();
  const int widths[] = {200, 100, 70, 50, 100, 100};
  for (int c = 0; c < 6; ++c) m_view->setColumnWidth(c, widths[c]);
  filter(m_filter->text());
  if (m_model->rowCount() > 0) m_view->setCurrentIndex(m_model->index(0, 0));
}

/// On top of all: what the scene waits for.
void PluginPage::addMissing() {
  const Theme& theme = Theme::current();
  const auto& plugins = m_registry->plugins();
  const Project& project = m_session.document().project();
  m_missing = missingPlugins(project, *m_registry);
  std::erase_if(m_missing, [&](const MissingPlugin& missing) {  // of those that were not loaded there is a row already
    return std::any_of(plugins.begin(), plugins.end(), [&](const PluginInfo& info) { return info.id == missing.id; });
  });
  for (size_t k = m_missing.size(); k-- > 0;) {
    const MissingPlugin& missing = m_missing[k];
    QList<QStandardItem*> row;
    for (const QString& text : {QString::fromStdString(missing.id), kindText(missing.kind), QString(), QString(),
                                QString(), QStringLiteral("Missing"), missingText(missing, project, *m_registry)}) {
      row << new QStandardItem(text);
      row.back()->setForeground(theme[Token::Warning]);
    }
    row[0]->setForeground(theme[Token::Text]);
    row[0]->setData(-1 - static_cast<int>(k), kId);
    row[0]->setIcon(QIcon(iconPixmap(QStringLiteral("plugin"), theme[Token::Warning], 16, devicePixelRatioF())));
    row[6]->setToolTip(row[6]->text());
    m_model->insertRow(0, row);
  }
}

const MissingPlugin* PluginPage::missingAt(const QModelIndex& index) const {
  const QStandardItem* item = index.isValid() ? m_model->item(index.row()) : nullptr;
  const int place = item ? item->data(kId).toInt() : 0;
  const auto k = static_cast<size_t>(-1 - place);
  return place < 0 && k < m_missing.size() ? &m_missing[k] : nullptr;
}

std::string PluginPage::idAt(int row) const {
  const QModelIndex index = m_model->index(row, 0);
  if (const MissingPlugin* missing = missingAt(index)) return missing->id;
  const PluginInfo* info = pluginAt(index);
  return info ? info->id : std::string();
}

void PluginPage::select(const std::string& id) {
  for (int row = 0; m_registry && row < m_model->rowCount(); ++row) {
    if (idAt(row) == id) m_view->setCurrentIndex(m_model->index(row, 0));
  }
}

void PluginPage::find(const std::string& id) {
  m_filter->clear();
  refresh();
  select(id);
  m_view->scrollTo(m_view->currentIndex());
  m_view->setFocus(Qt::OtherFocusReason);
}

void PluginPage::showNews(const QString& text) { m_details->setText(text.toHtmlEscaped()); }

void PluginPage::showMissing(const MissingPlugin& missing) {
  const QString text = missingText(missing, m_session.document().project(), *m_registry);
  m_details->setText(
      QStringLiteral(
          "<b>%1</b><br>%2<br><span style='color:%3'>It is looked for in the folder of the user's plugins, %4, "
          "in the one that Preferences name, and in those of PHASESKETCH_PLUGIN_PATH.</span>")
          .arg(QString::fromStdString(missing.id).toHtmlEscaped(), text.toHtmlEscaped(),
               Theme::current()[Token::Muted].name(), QString::fromStdString(userPluginDirectory()).toHtmlEscaped()));
}

void PluginPage::showDetails() {
  const PluginInfo* shown = pluginAt(m_view->currentIndex());
  m_again->setVisible(shown && shown->state == PluginInfo::State::Quarantined);
  m_again->setEnabled(!m_trying);
  const MissingPlugin* missing = missingAt(m_view->currentIndex());
  m_folder->setVisible(missing != nullptr);
  m_again->setText(m_trying ? QStringLiteral("Trying…") : QStringLiteral("Try again"));
  if (missing) return showMissing(*missing);
  if (!shown) {
    m_details->clear();
    return;
  }
  const PluginInfo& plugin = *shown;
  const auto text = [](const std::string& s) { return QString::fromStdString(s).toHtmlEscaped(); };
  QString html = QStringLiteral("<b>%1</b>").arg(nameOf(plugin).toHtmlEscaped());
  if (!plugin.author.empty()) html += QStringLiteral(" · by ") + text(plugin.author);
  html += QStringLiteral("<br>");
  if (!plugin.problem.empty()) {
    html += QStringLiteral("<span style='color:%1'>%2</span><br>")
                .arg(Theme::current()[Token::Error].name(), text(plugin.problem));
  }
  if (!plugin.note.empty()) html += text(plugin.note) + QStringLiteral("<br>");
  html += text(plugin.help) + QStringLiteral("<br><span style='color:%1'>%2%3</span>")
                                  .arg(Theme::current()[Token::Muted].name(),
                                       plugin.id.empty() ? QString() : text(plugin.id) + QStringLiteral(" · "),
                                       text(plugin.path));
  m_details->setText(html);
}

const PluginInfo* PluginPage::pluginAt(const QModelIndex& index) const {
  const QStandardItem* item = index.isValid() ? m_model->item(index.row()) : nullptr;
  const int place = item ? item->data(kId).toInt() : -1;
  const auto i = static_cast<size_t>(place);
  return place >= 0 && m_registry && i < m_registry->plugins().size() ? &m_registry->plugins()[i] : nullptr;
}

/// It may take as long as a plugin may; the window goes on meanwhile, or may be gone.
void PluginPage::tryAgain(const std::string& id) {
  if (m_trying) return;
  m_trying = true;
  showDetails();
  m_session.worker().run([&session = m_session, page = QPointer<PluginPage>(this), id] {
    const QString problem = QString::fromStdString(session.plugins()->tryAgain(id).problem);
    QMetaObject::invokeMethod(&session, [&session, page, id, problem] {
      const QString name = QStringLiteral("Plugin ") + QString::fromStdString(id);
      if (problem.isEmpty())
        session.log().add(MessageLevel::Ok, name,
                          QStringLiteral("It came back: it is loaded when the program starts again."));
      else
        session.log().add(MessageLevel::Warning, name, problem);
      if (!page) return;
      page->m_trying = false;
      page->refresh();
      page->select(id);
      Q_EMIT page->tried(id, problem);
    });
  });
}

void PluginPage::filter(const QString& text) {
  const QString wanted = text.trimmed();
  bool any = false;
  for (int row = 0; row < m_model->rowCount(); ++row) {
    const PluginInfo* info = pluginAt(m_model->index(row, 0));
    QString all = QString::fromStdString((info ? info->author + " " : std::string()) + idAt(row));
    for (int c = 0; c < m_model->columnCount(); ++c) all += QLatin1Char(' ') + m_model->item(row, c)->text();
    const bool meant = all.contains(wanted, Qt::CaseInsensitive);
    m_view->setRowHidden(row, {}, !meant);
    any = any || meant;
  }
  m_nothing->standFor(*m_view, any);
}

QStringList PluginPage::lines() const {
  QStringList list;
  for (int row = 0; row < m_model->rowCount(); ++row) {
    QStringList cells;
    for (int c = 0; c < m_model->columnCount(); ++c) cells << m_model->item(row, c)->text();
    list << cells.join(QStringLiteral("\t"));
  }
  return list;
}

/// Scenes come and go while the page is out of sight.
void PluginPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  const std::string id = idAt(m_view->currentIndex().row());
  refresh();
  select(id);
}

void PluginPage::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Panel]);
}

void PluginPage::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) refresh();
}

}  // namespace ps
