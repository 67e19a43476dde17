// SPDX-License-Identifier: Apache-2.0
#include "ui/window/fileguard.h"

#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/filewatch.h"
#include "ui/session/savejob.h"
#include "ui/session/session.h"
#include "ui/session/versions.h"
#include "ui/session/wording.h"
#include "ui/window/actions.h"
#include "ui/window/filenames.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"
#include "ui/window/restoreoffer.h"

#include <QtCore/QFileInfo>
#include <QtCore/QLocale>
#include <QtGui/QAction>
#include <QtWidgets/QMenu>

#include <utility>

namespace ps {
namespace {

const QString kLock = QStringLiteral("lock"), kSave = QStringLiteral("save"),
              kOutside = QStringLiteral("outside");  // topics

NoticeBar::Button saveElsewhere(const Actions& actions) {
  return {QStringLiteral("Save elsewhere…"), [&actions] { actions.find(QStringLiteral("file.saveAs"))->trigger(); }};
}

NoticeBar::Button openFromDisk(Session& session, const QString& path) {
  return {QStringLiteral("Open what is on disk"), [&session, path] { session.files().open(path); }};
}

}  // namespace

FileGuard::FileGuard(Session& session, const Actions& actions, Notices& notices, RestoreOffer& restore, QObject* parent)
    : QObject(parent), m_session(session), m_actions(actions), m_notices(notices), m_restore(restore) {
  DocumentFiles& files = session.files();
  new FileWatch(session.document(), files, this);
  connect(&files, &DocumentFiles::saveRefused, this, &FileGuard::onRefused);
  connect(&files, &DocumentFiles::openElsewhere, this, &FileGuard::onElsewhere);
  connect(&files, &DocumentFiles::changedOutside, this, &FileGuard::onOutside);
  connect(&files, &DocumentFiles::tookOver, this, &FileGuard::onTookOver);
  connect(&files, &DocumentFiles::opened, this, [this] {
    m_saveTo.clear();
    m_notices.bar().close(kLock);
    m_notices.bar().close(kOutside);
  });
  connect(&files, &DocumentFiles::saved, this, [this](const QString&, bool present) {
    if (!present) return;
    m_notices.bar().close(kLock);
    m_notices.bar().close(kOutside);
  });
  connect(&files, &DocumentFiles::versionNotKept, this, [this](const QString& path, const QString& problem) {
    m_session.log().add(MessageLevel::Warning, nameOf(path),
                        QStringLiteral("What the file held before was not kept: %1").arg(sentence(problem)));
  });
}

void FileGuard::addVersionsMenu(QMenu* menu) {
  m_versions = menu->addMenu(QStringLiteral("Earlier versions"));
  m_versions->menuAction()->setToolTip(QStringLiteral(
      "What the file held before each of the last five saves. One that is opened is an unsaved change."));
  connect(m_versions, &QMenu::aboutToShow, this, &FileGuard::fillVersions);
}

void FileGuard::fillVersions() {
  m_versions->clear();
  for (const versions::Version& version : versions::of(m_session.document().path())) {
    const QString text = version.time.toString(QStringLiteral("d MMMM yyyy, HH:mm:ss")) + QStringLiteral("  ·  ") +
                         QLocale::c().formattedDataSize(version.size, 1, QLocale::DataSizeSIFormat);
    m_versions->addAction(text, this, [this, file = version.file] { m_session.files().openVersion(file); });
  }
  if (m_versions->isEmpty()) m_versions->addAction(QStringLiteral("No earlier versions"))->setEnabled(false);
}

void FileGuard::onRefused(const QString& path, SaveRefusal refusal, const QString& problem, bool present) {
  m_session.log().add(MessageLevel::Error, nameOf(path), QStringLiteral("Not saved: %1").arg(sentence(problem)));
  if (!present) {
    m_restore.showReplaced(QStringLiteral("“%1” was not saved: %2").arg(nameOf(path), sentence(problem)));
    return;
  }
  std::vector<NoticeBar::Button> buttons{saveElsewhere(m_actions)};
  if (refusal == SaveRefusal::Changed) {
    m_notices.bar().close(kOutside);  // the same, less to the point
    buttons.insert(buttons.begin(),
                   {QStringLiteral("Save anyway"), [this, path] { m_session.files().save(path, true); }});
    buttons.push_back(openFromDisk(m_session, path));
  } else if (path == m_session.document().path()) {
    buttons.push_back({QStringLiteral("Take over and save"), [this, path] { takeOver(path, true); }});
  }
  m_notices.bar().show(
      kSave, MessageLevel::Error, QStringLiteral("“%1” was not saved.").arg(nameOf(path)),
      sentence(problem).replace(0, 1, problem.left(1).toUpper()) + QStringLiteral(" Your work is kept in memory."),
      std::move(buttons));
}

void FileGuard::onOutside(const QString& path, OutsideChange change) {
  if (change == OutsideChange::None) {
    m_notices.bar().close(kOutside);
    return;
  }
  const bool gone = change == OutsideChange::Gone;
  const QString title =
      (gone ? QStringLiteral("“%1” is not there any more.") : QStringLiteral("Another program has changed “%1”."))
          .arg(nameOf(path));
  m_session.log().add(MessageLevel::Warning, nameOf(path), title);
  if (gone) {
    m_notices.bar().show(
        kOutside, MessageLevel::Warning, title,
        QStringLiteral("Another program has removed, renamed or moved it. Your work is kept in memory."),
        {{QStringLiteral("Save it again"), [this, path] { m_session.files().save(path); }}, saveElsewhere(m_actions)});
    return;
  }
  m_notices.bar().show(
      kOutside, MessageLevel::Warning, title,
      QStringLiteral("Here the scene is as it was before. If you keep it, the next save replaces the file, and what it "
                     "holds now stays an earlier version."),
      {openFromDisk(m_session, path), {QStringLiteral("Keep mine"), [this] {
                                         m_session.files().keepOurs();
                                         m_notices.bar().close(kOutside);
                                       }}});
}

void FileGuard::onElsewhere(const QString& path, const QString& who) {
  const QString title = who.isEmpty() ? QStringLiteral("“%1” is open in another window.").arg(nameOf(path))
                                      : QStringLiteral("“%1” is open in another window, of %2.").arg(nameOf(path), who);
  m_session.log().add(MessageLevel::Warning, nameOf(path), title);
  m_notices.bar().show(
      kLock, MessageLevel::Warning, title,
      QStringLiteral("Here you can look at it and try things; saving asks for another name. Taken over, "
                     "it is the other window that cannot save."),
      {{QStringLiteral("Take over"), [this, path] { takeOver(path, false); }}, saveElsewhere(m_actions)});
}

void FileGuard::takeOver(const QString& path, bool save) {
  m_saveTo = save ? path : QString();
  m_session.files().takeOver();
}

void FileGuard::onTookOver(const QString& path, bool done) {
  const QString saveTo = std::exchange(m_saveTo, {});
  if (!done) {
    m_notices.message(MessageLevel::Error, nameOf(path),
                      QStringLiteral("It could not be taken over: no permission in its folder. Save elsewhere."));
    return;
  }
  m_notices.bar().close(kLock);
  m_session.log().add(MessageLevel::Ok, nameOf(path), QStringLiteral("Taken over from the other window."));
  if (!saveTo.isEmpty()) m_session.files().save(saveTo);
}

}  // namespace ps
