// SPDX-License-Identifier: Apache-2.0
#include "ui/window/welcome.h"

#include "ui/document/document.h"
#include "ui/film/hiddenbodies.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/session.h"
#include "ui/session/transitions.h"
#include "ui/theme/plaintext.h"
#include "ui/viewport/viewport.h"
#include "ui/welcome/cardgrid.h"
#include "ui/welcome/welcomepage.h"
#include "ui/window/actions.h"
#include "ui/window/fileactions.h"
#include "ui/window/filenames.h"
#include "ui/window/restoreoffer.h"
#include "ui/window/topbar.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtGui/QAction>
#include <QtWidgets/QMenu>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QTabBar>

namespace ps {
namespace {

const QString kProjectFilter = QStringLiteral("Projects (*.json);;All files (*)");

std::optional<SceneShot> shotOf(Session& session, const Viewport* view) {
  const SnapshotPtr snapshot = session.snapshot();
  if (!view || !snapshot || snapshot->position.empty()) return std::nullopt;
  return SceneShot{withoutBodies(snapshot, view->hiddenBodies()),
                   {session.surroundings()},
                   view->shownLook(),
                   view->navigator().camera()};
}

}  // namespace

Welcome::Welcome(const Parts& parts, const QString& samples, QObject* parent)
    : QObject(parent),
      m_parts(parts),
      m_gallery(samples, parts.session.worker()),
      m_thumbnails(parts.session, [&session = parts.session, view = parts.view] { return shotOf(session, view); }) {
  makePage();
  connectPage();
  connect(&m_gallery, &Gallery::loaded, this, &Welcome::fillMenu);
  connect(&m_gallery, &Gallery::loaded, this, [this] {
    if (shown()) focusFirst();
  });
}

void Welcome::makePage() {
  const auto action = [this](const char* name) { return m_parts.actions.find(QString::fromLatin1(name)); };
  m_page = new WelcomePage(m_gallery,
                           {{QStringLiteral("plus"), QStringLiteral("New scene"), action("file.new")},
                            {QStringLiteral("folder"), QStringLiteral("Open…"), action("file.open")},
                            {{}, QStringLiteral("Learn"), nullptr},
                            {QStringLiteral("play"), QStringLiteral("First steps"), action("help.first-steps")},
                            {QStringLiteral("brush"), QStringLiteral("Sketching"), action("help.sketching")},
                            {QStringLiteral("curve"), QStringLiteral("Tuning materials"), action("help.tuning")},
                            {QStringLiteral("info"), QStringLiteral("All keys"), action("help.shortcuts")}},
                           {{QStringLiteral("gear"), QStringLiteral("Preferences"), action("edit.preferences")},
                            {QStringLiteral("plugin"), QStringLiteral("Plugins"), action("help.plugins")}});
  m_page->setAtStart(preferences::welcomeAtStart());
  m_page->templates()->setEnabled(m_parts.session.isReady());
  m_parts.centre.addWidget(m_page);
}

void Welcome::connectPage() {
  Session& session = m_parts.session;
  connect(m_page, &WelcomePage::projectChosen, this, [this](const QString& path) {
    leave();
    m_parts.files.open(path);
  });
  connect(m_page, &WelcomePage::projectSought, this, &Welcome::locate);
  connect(m_page, &WelcomePage::templateChosen, this, [this](const QString& path) {
    leave();
    m_parts.session.files().openTemplate(path);
  });
  connect(m_page, &WelcomePage::closeRequested, this, &Welcome::leave);
  connect(m_page, &WelcomePage::atStartChanged, this, &preferences::setWelcomeAtStart);
  connect(&session, &Session::ready, this, [this] { m_page->templates()->setEnabled(true); });
  connect(&session.document(), &Document::changed, this,
          [this] { m_page->setPresent(m_parts.session.document().title()); });
  connect(&session.files(), &DocumentFiles::opened, this, [this] {
    if (!std::exchange(m_starting, false)) leave();
  });
  // What went wrong is said over the scene.
  connect(&session.files(), &DocumentFiles::openFailed, this, &Welcome::leave);
  connect(&session.files(), &DocumentFiles::saveFailed, this, &Welcome::leave);
  connect(&session, &Session::projectShown, this, [this] {
    if (m_parts.session.isBroken()) leave();
  });
  connect(&m_thumbnails, &Thumbnails::taken, this, [this] {
    if (shown()) m_page->readRecent();
  });
  connect(&m_parts.restore, &RestoreOffer::offerChanged, this, &Welcome::showOffer);
  connect(&m_parts.centre, &QStackedWidget::currentChanged, this, &Welcome::onPage);
}

/// Where it is now takes the place of where it was.
void Welcome::locate(const QString& path) {
  const QFileInfo was(path);
  const QString folder = was.dir().exists() ? was.path() : preferences::projectFolder();
  const QString now = fileToRead(m_page->window(), QStringLiteral("Where is “%1” now?").arg(was.completeBaseName()),
                                 folder, kProjectFilter);
  if (now.isEmpty()) return;
  DocumentFiles::forgetRecent(path);
  leave();
  m_parts.files.open(now);
}

/// One action for each sample and template: the menu and Ctrl+K have them.
void Welcome::fillMenu() {
  QMenu* menu = m_parts.files.samplesMenu();
  const auto add = [this, menu](const Sample& sample, bool asTemplate) {
    const QString name = QStringLiteral("sample.") + QFileInfo(sample.path).completeBaseName();
    QAction* action = m_parts.actions.add(menu, name, sample.title, {}, [this, path = sample.path, asTemplate] {
      Q_EMIT asTemplate ? m_page->templateChosen(path) : m_page->projectChosen(path);
    });
    action->setToolTip(sample.summary);
    action->setProperty(kReplaces, true);
    action->setProperty(kWords, sample.summary + QLatin1Char(' ') + sample.toTry + QLatin1Char(' ') +
                                    sample.tags.join(QLatin1Char(' ')));
  };
  for (const Sample& sample : m_gallery.samples()) add(sample, false);
  menu->addSeparator();
  for (const Sample& sample : m_gallery.templates()) add(sample, true);
}

bool Welcome::shown() const { return m_parts.centre.currentWidget() == m_page; }

void Welcome::show() {
  if (shown()) return;
  m_parts.centre.setCurrentWidget(m_page);
  focusFirst();
}

void Welcome::focusFirst() {
  if (const auto cards = m_page->samples()->cards(); !cards.empty()) cards.front()->setFocus(Qt::OtherFocusReason);
}

void Welcome::showAtStart() {
  if (preferences::isFirstStart() || !preferences::welcomeAtStart()) return;
  m_starting = true;
  show();
}

void Welcome::leave() {
  m_starting = false;
  if (!shown()) return;
  m_parts.centre.setCurrentWidget(&m_parts.scene);
  if (m_parts.view) m_parts.view->setFocus(Qt::OtherFocusReason);
}

/// Docks go with the scene.
void Welcome::onPage() {
  const bool bare = shown();
  if (bare == m_bare) return;
  m_bare = bare;
  m_parts.layout.setFullViewport(bare);
  m_parts.top.workspaces()->setVisible(!bare);
  m_parts.actions.find(QStringLiteral("window.full"))->setEnabled(!bare);
}

void Welcome::showOffer() {
  const RestoreOffer::Offer& offer = m_parts.restore.present();
  std::vector<WelcomePage::Choice> choices;
  for (const NoticeBar::Button& button : offer.buttons) {
    const bool opens = &button == &offer.buttons.front();
    choices.push_back({button.text, [this, act = button.act, opens] {
                         if (opens) leave();
                         act();
                       }});
  }
  m_page->setOffer(offer.title, offer.text, choices);
}

}  // namespace ps
