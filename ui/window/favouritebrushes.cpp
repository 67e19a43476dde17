// SPDX-License-Identifier: Apache-2.0
#include "ui/window/favouritebrushes.h"

#include "core/plugin_host/registry.h"
#include "ui/document/document.h"
#include "ui/session/preferences.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/icon.h"
#include "ui/theme/plaintext.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/window/actions.h"
#include "ui/window/dialogrow.h"
#include "ui/window/filenames.h"
#include "ui/window/notices.h"

#include <QtCore/QDir>
#include <QtCore/QEvent>
#include <QtCore/QJsonDocument>
#include <QtCore/QSaveFile>
#include <QtGui/QAction>
#include <QtGui/QShortcut>
#include <QtWidgets/QDialog>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <functional>
#include <utility>

namespace ps {
namespace {
const QString kWhere = QStringLiteral("Favourite brushes");
const QString kFiles = QStringLiteral("Brushes (*.json)");
constexpr qint64 kLargest = 4 << 20;  // bytes of a file of brushes, thousands of them
constexpr int kEdge = 16, kGap = 6;

QIcon iconOf(const std::string& shape) {
  const QString name = QString::fromStdString(shape);
  return icon(iconNames().contains(name) ? name : QStringLiteral("brush"));
}

QString keptText(const QString& name) {
  return QStringLiteral("“%1” is kept here and behind the star, for all projects.").arg(name);
}

/// Their names in a list, and what is done with those that are chosen.
class BrushForm : public QDialog {
 public:
  BrushForm(FavouriteBrushes& brushes, Session& session, QWidget* window);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  QPushButton* add(QBoxLayout& row, const QString& text, const QString& tip, const std::function<void()>& act);
  void makeButtons(QVBoxLayout& column);
  void fill();
  void showButtons();
  std::vector<FavouriteBrush> chosen() const;
  void keep();
  void takeName(QListWidgetItem& item);
  void remove();
  void bringBack();
  void chooseExport();
  void chooseImport();
  void tell(const QString& problem, const QString& done = {});

  FavouriteBrushes& m_brushes;
  Session& m_session;
  std::vector<FavouriteBrush> m_shown, m_gone;
  QListWidget* m_list;
  QLabel *m_problem, *m_done;
  QPushButton *m_take = nullptr, *m_rename = nullptr, *m_remove = nullptr, *m_back = nullptr, *m_export = nullptr;
};

BrushForm::BrushForm(FavouriteBrushes& brushes, Session& session, QWidget* window)
    : QDialog(window),
      m_brushes(brushes),
      m_session(session),
      m_list(new QListWidget),
      m_problem(new QLabel),
      m_done(new QLabel) {
  setWindowTitle(kWhere);
  setAttribute(Qt::WA_DeleteOnClose);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kEdge, kEdge, kEdge, kEdge);
  column->setSpacing(kGap);
  m_list->setAccessibleName(kWhere);
  m_list->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_list->setEditTriggers(QAbstractItemView::EditKeyPressed);
  column->addWidget(m_list, 1);
  for (const auto& [label, role] : {std::pair{m_problem, "error"}, {m_done, "muted"}}) {
    label->setTextFormat(Qt::PlainText);
    label->setProperty("role", role);
    label->setWordWrap(true);
    label->hide();
    column->addWidget(label);
  }
  m_done->setObjectName(QStringLiteral("psDone"));
  makeButtons(*column);
  connect(m_list, &QListWidget::itemSelectionChanged, this, &BrushForm::showButtons);
  connect(m_list, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) { takeName(*item); });
  connect(m_list, &QListWidget::itemActivated, m_take, &QPushButton::click);
  connect(new QShortcut(QKeySequence(Qt::Key_Delete), m_list, nullptr, nullptr, Qt::WidgetShortcut),
          &QShortcut::activated, this, &BrushForm::remove);
  fill();
  resize(420, 380);
}

void BrushForm::makeButtons(QVBoxLayout& column) {
  auto *first = new QHBoxLayout, *second = new QHBoxLayout;
  add(*first, QStringLiteral("Keep this brush"), QStringLiteral("The one in hand, under a name that you then type"),
      [this] { keep(); });
  m_take = add(*first, QStringLiteral("Take"), QStringLiteral("Takes it in hand (Enter)"),
               [this] { m_brushes.take(chosen().front()); });
  m_rename = add(*first, QStringLiteral("Rename"), QStringLiteral("Another name for it (F2)"),
                 [this] { m_list->editItem(m_list->selectedItems().front()); });
  m_remove = add(*first, QStringLiteral("Forget"), QStringLiteral("Those that are chosen (Del)"), [this] { remove(); });
  m_back = add(*second, QStringLiteral("Bring back"), QStringLiteral("Those that were forgotten here"),
               [this] { bringBack(); });
  add(*second, QStringLiteral("Import…"), QStringLiteral("Brushes out of a file, beside those that are here"),
      [this] { chooseImport(); });
  m_export = add(*second, QStringLiteral("Export…"),
                 QStringLiteral("Those that are chosen, or all (Ctrl+A), into a file"), [this] { chooseExport(); });
  column.addLayout(first);
  column.addLayout(second);
}

QPushButton* BrushForm::add(QBoxLayout& row, const QString& text, const QString& tip,
                            const std::function<void()>& act) {
  auto* button = new QPushButton(text);
  button->setAutoDefault(false);  // Enter is the list's
  button->setToolTip(tip);
  connect(button, &QPushButton::clicked, this, [this, act] {
    tell({});
    act();
  });
  row.addWidget(button);
  return button;
}

/// Another window may have kept some meanwhile, or the menu.
void BrushForm::changeEvent(QEvent* event) {
  QDialog::changeEvent(event);
  if (event->type() == QEvent::ActivationChange && m_shown != m_brushes.all()) fill();
}

/// One is chosen where there are any, so that the buttons have something to act on.
void BrushForm::fill() {
  m_shown = m_brushes.all();
  const QSignalBlocker silent(m_list);
  const int row = m_list->currentRow();
  m_list->clear();
  for (const FavouriteBrush& favourite : m_shown) {
    auto* item = new QListWidgetItem(iconOf(favourite.brush.shape), favourite.name, m_list);
    item->setFlags(item->flags() | Qt::ItemIsEditable);
  }
  m_list->setCurrentRow(std::min(std::max(row, 0), m_list->count() - 1));
  showButtons();
}

void BrushForm::showButtons() {
  const auto count = m_list->selectedItems().size();
  m_take->setEnabled(count == 1);
  m_rename->setEnabled(count == 1);
  m_remove->setEnabled(count > 0);
  m_back->setEnabled(!m_gone.empty());
  m_export->setEnabled(!m_shown.empty());
  const bool some = count > 0 && count < m_list->count();
  m_export->setText(some ? QStringLiteral("Export %1…").arg(count) : QStringLiteral("Export all…"));
}

std::vector<FavouriteBrush> BrushForm::chosen() const {
  std::vector<FavouriteBrush> some;
  for (int row = 0; row < m_list->count(); ++row) {
    if (m_list->item(row)->isSelected()) some.push_back(m_shown[static_cast<size_t>(row)]);
  }
  return some;
}

void BrushForm::keep() {
  if (!m_brushes.keep()) return tell(QStringLiteral("The brush in hand is kept already."));
  fill();
  m_list->setCurrentRow(m_list->count() - 1);
  tell({}, keptText(m_list->currentItem()->text()));
  m_list->editItem(m_list->currentItem());
}

void BrushForm::takeName(QListWidgetItem& item) {
  const FavouriteBrush& named = m_shown[static_cast<size_t>(m_list->row(&item))];
  const QString name = item.text().simplified();
  const QString problem = m_brushes.rename(named, name);
  const QSignalBlocker silent(m_list);
  item.setText(problem.isEmpty() ? name : named.name);
  m_shown = m_brushes.all();
  tell(problem, keptText(item.text()));
}

void BrushForm::remove() {
  for (const FavouriteBrush& favourite : chosen()) {
    m_brushes.forget(favourite);
    m_gone.push_back(favourite);
  }
  fill();
}

void BrushForm::bringBack() {
  for (const FavouriteBrush& favourite : std::exchange(m_gone, {})) m_brushes.restore(favourite);
  fill();
}

void BrushForm::chooseExport() {
  const std::vector<FavouriteBrush> some = chosen();
  const QString path = fileToWrite(this, QStringLiteral("Export brushes"),
                                   folderBeside(m_session) + QStringLiteral("/brushes.json"), kFiles);
  if (path.isEmpty()) return;
  const std::vector<FavouriteBrush>& all = some.empty() ? m_shown : some;
  const QString what =
      all.size() == 1 ? QStringLiteral("“%1” is").arg(all[0].name) : QStringLiteral("%1 brushes are").arg(all.size());
  tell(FavouriteBrushes::exportTo(all, path),
       QStringLiteral("%1 in the file %2.").arg(what, QDir::toNativeSeparators(path)));
}

void BrushForm::chooseImport() {
  const QString path = fileToRead(this, QStringLiteral("Import brushes"), folderBeside(m_session),
                                  kFiles + QStringLiteral(";;All files (*)"));
  if (path.isEmpty()) return;
  const size_t before = m_shown.size();
  const QString problem = m_brushes.importFrom(path);
  fill();
  tell(problem, QStringLiteral("%1 new from the file %2.")
                    .arg(m_shown.size() > before ? QString::number(m_shown.size() - before) : QStringLiteral("Nothing"),
                         QDir::toNativeSeparators(path)));
}

/// What went wrong, or else what was done.
void BrushForm::tell(const QString& problem, const QString& done) {
  m_problem->setText(problem);
  m_problem->setVisible(!problem.isEmpty());
  m_done->setText(done);
  m_done->setVisible(problem.isEmpty() && !done.isEmpty());
}

}  // namespace

FavouriteBrushes::FavouriteBrushes(Session& session, Selection& selection, Toolbox& tools, const Actions& actions,
                                   Notices& notices, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_selection(selection),
      m_tools(tools),
      m_actions(actions),
      m_notices(notices) {}

void FavouriteBrushes::addTo(QMenu* menu) {
  QAction* keeps = m_actions.add(menu, QStringLiteral("sketch.keepBrush"), QStringLiteral("Keep this brush"), {},
                                 [this] { keep(); });
  keeps->setToolTip(QStringLiteral("Its shape, size, matter and guides, for all projects"));
  m_menu = menu->addMenu(kWhere);
  m_menu->setToolTipsVisible(true);
  m_ready = new QMenu(QStringLiteral("Ready brushes"), m_menu);
  m_ready->setToolTipsVisible(true);
  m_forget = new QMenu(QStringLiteral("Forget"), m_menu);
  QAction* form = m_actions.add(menu, QStringLiteral("sketch.brushes"), QStringLiteral("Manage favourite brushes…"), {},
                                [this] { openForm(); });
  form->setToolTip(QStringLiteral("Names them, forgets them, and gives them to others as a file"));
  connect(m_menu, &QMenu::aboutToShow, this, &FavouriteBrushes::fill);
}

std::vector<FavouriteBrush> FavouriteBrushes::all() const {
  const PluginRegistry* plugins = m_session.plugins();
  return plugins ? favouritesOf(preferences::favouriteBrushes(), *plugins) : std::vector<FavouriteBrush>{};
}

bool FavouriteBrushes::keep() {
  const PluginRegistry* plugins = m_session.plugins();
  if (!plugins) return false;
  FavouriteBrush favourite = favouriteOf(m_tools.brush(), *plugins, m_session.document().project());
  std::vector<FavouriteBrush> kept = all();
  const auto same = [&](const FavouriteBrush& one) { return one.brush == favourite.brush; };
  if (const auto found = std::find_if(kept.begin(), kept.end(), same); found != kept.end()) {
    m_notices.message(MessageLevel::Info, kWhere, QStringLiteral("“%1” is kept already.").arg(found->name));
    return false;
  }
  favourite.name = freeName(kept, favourite.name);  // they may differ in other values than those that name them
  kept.push_back(favourite);
  preferences::setFavouriteBrushes(textOf(kept));
  m_notices.message(MessageLevel::Info, kWhere, QStringLiteral("“%1” is kept.").arg(favourite.name));
  return true;
}

void FavouriteBrushes::take(const FavouriteBrush& favourite) {
  if (!m_session.plugins() || !m_session.plugins()->brush(favourite.brush.shape)) {
    m_notices.refuse(QStringLiteral("“%1” is not taken.").arg(favourite.name),
                     QStringLiteral("Its brush is not installed. See Plugins."));
    return;
  }
  takeInHand(taken(favourite, m_tools.brush(), m_session.document().project()));
}

void FavouriteBrushes::take(const ReadyBrush& ready) {
  takeInHand(taken(ready, m_tools.brush(), m_session.document().project()));
}

void FavouriteBrushes::takeInHand(const BrushSettings& brush) {
  if (!m_tools.tool().usesBrush()) m_tools.activate(kBrushTool);
  m_tools.takeBrush(brush.shape);
  m_tools.setBrush(brush);
  m_selection.setMaterial(m_tools.brush().material);
}

void FavouriteBrushes::forget(const FavouriteBrush& favourite) {
  std::vector<FavouriteBrush> kept = all();
  std::erase(kept, favourite);
  preferences::setFavouriteBrushes(textOf(kept));
}

void FavouriteBrushes::restore(const FavouriteBrush& favourite) {
  std::vector<FavouriteBrush> kept = all();
  const auto same = [&](const FavouriteBrush& one) {
    return one.brush == favourite.brush && one.asKept == favourite.asKept;
  };
  if (std::any_of(kept.begin(), kept.end(), same)) return;
  kept.push_back(renamed(favourite, freeName(kept, favourite.name)));
  preferences::setFavouriteBrushes(textOf(kept));
}

QString FavouriteBrushes::rename(const FavouriteBrush& favourite, const QString& name) {
  if (name.isEmpty()) return QStringLiteral("A brush has a name: it keeps the one that it has.");
  if (name == favourite.name) return {};
  std::vector<FavouriteBrush> kept = all();
  const auto found = std::find(kept.begin(), kept.end(), favourite);
  if (found == kept.end()) return QStringLiteral("“%1” is no favourite any more.").arg(favourite.name);
  if (freeName(kept, name) != name) return QStringLiteral("“%1” is the name of another one.").arg(name);
  *found = renamed(*found, name);
  preferences::setFavouriteBrushes(textOf(kept));
  return {};
}

QString FavouriteBrushes::exportTo(const std::vector<FavouriteBrush>& favourites, const QString& path) {
  QSaveFile file(path);
  const QByteArray text = QJsonDocument::fromJson(textOf(favourites)).toJson(QJsonDocument::Indented);
  if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit()) return {};
  return QStringLiteral("The brushes are not exported: %1.").arg(file.errorString());
}

QString FavouriteBrushes::importFrom(const QString& path) {
  const PluginRegistry* plugins = m_session.plugins();
  QFile file(path);
  if (!plugins || !file.open(QIODevice::ReadOnly))
    return QStringLiteral("“%1” cannot be read: %2.").arg(nameOf(path), file.errorString());
  const QByteArray text = file.size() <= kLargest ? file.readAll() : QByteArray();
  const std::vector<FavouriteBrush> came = favouritesOf(text, *plugins);
  if (came.empty()) return QStringLiteral("“%1” holds no brushes.").arg(nameOf(path));
  const size_t before = all().size();
  for (const FavouriteBrush& favourite : came) restore(favourite);
  const size_t fresh = all().size() - before;
  m_notices.message(MessageLevel::Info, kWhere,
                    QStringLiteral("%1 of %2 brushes of “%3” are new.").arg(fresh).arg(came.size()).arg(nameOf(path)));
  return {};
}

void FavouriteBrushes::openForm() {
  QMainWindow& window = m_actions.window();
  bringUp(window, QStringLiteral("psBrushes"), [&] { return new BrushForm(*this, m_session, &window); });
}

std::vector<ReadyBrush> FavouriteBrushes::ready() const {
  const PluginRegistry* plugins = m_session.plugins();
  return plugins ? readyBrushes(*plugins) : std::vector<ReadyBrush>{};
}

void FavouriteBrushes::addReady() {
  m_ready->clear();
  for (const ReadyBrush& brush : ready()) {
    QAction* takes =
        m_ready->addAction(iconOf(brush.shape), asButtonText(brush.name), this, [this, brush] { take(brush); });
    takes->setToolTip(brush.about);
  }
  if (!m_ready->isEmpty()) m_menu->addMenu(m_ready);
}

void FavouriteBrushes::fill() {
  m_menu->clear();
  m_forget->clear();
  const std::vector<FavouriteBrush> kept = all();
  for (const FavouriteBrush& favourite : kept) {
    m_menu->addAction(iconOf(favourite.brush.shape), asButtonText(favourite.name), this,
                      [this, favourite] { take(favourite); });
  }
  if (kept.empty()) m_menu->addAction(QStringLiteral("None is kept yet"))->setEnabled(false);
  m_menu->addSeparator();
  addReady();
  m_menu->addSeparator();
  m_menu->addAction(m_actions.find(QStringLiteral("sketch.keepBrush")));
  m_menu->addAction(m_actions.find(QStringLiteral("sketch.brushes")));
  if (kept.empty()) return;
  m_menu->addMenu(m_forget);
  for (const FavouriteBrush& favourite : kept)
    m_forget->addAction(asButtonText(favourite.name), this, [this, favourite] { forget(favourite); });
}

}  // namespace ps
