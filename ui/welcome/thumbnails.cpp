// SPDX-License-Identifier: Apache-2.0
#include "ui/welcome/thumbnails.h"

#include "core/base/error.h"
#include "core/io/outputfile.h"
#include "ui/document/document.h"
#include "ui/film/thumbnail.h"
#include "ui/session/cachefolder.h"
#include "ui/session/documentfiles.h"
#include "ui/session/session.h"

#include <QtCore/QBuffer>
#include <QtCore/QCryptographicHash>
#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QStandardPaths>
#include <QtGui/QImage>

namespace ps {
namespace {

constexpr int kQuality = 85;
constexpr QSize kDrawnOwn{640, 360};  // twice as large as what is kept, which smooths its edges

/// A picture that cannot be drawn or kept is no loss: the list shows an icon instead.
bool keep(const SceneShot& shot, const QString& path) {
  try {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    drawShot(shot, Thumbnails::kSize).save(&buffer, "JPEG", kQuality);
    QDir().mkpath(QFileInfo(path).path());
    writeFileAtomically(path.toStdString(), {bytes.constData(), static_cast<size_t>(bytes.size())});
    return true;
  } catch (const Error&) {
    return false;
  }
}

QString thumbnailFolder() {
  return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + QStringLiteral("/thumbnails");
}

}  // namespace

QString thumbnailPath(const QString& project) {
  const QByteArray hash = QCryptographicHash::hash(project.toUtf8(), QCryptographicHash::Sha1).toHex();
  return thumbnailFolder() + QLatin1Char('/') + QString::fromLatin1(hash) + QStringLiteral(".jpg");
}

Thumbnails::Thumbnails(Session& session, std::function<std::optional<SceneShot>()> shot, QObject* parent)
    : QObject(parent), m_session(session), m_shot(std::move(shot)) {
  m_worker.run([folder = thumbnailFolder()] { tidyCache(folder); });
  m_settle.setSingleShot(true);
  m_settle.setInterval(kSettle);
  connect(&session, &Session::projectShown, &m_settle, qOverload<>(&QTimer::start));
  connect(&m_settle, &QTimer::timeout, this, [this] {
    const QString kept = thumbnailPath(m_session.document().path());
    if (!QFileInfo::exists(kept))
      take();
    else
      m_worker.run([kept] { useCached(kept); });
  });
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) ++m_asked;
  });
  connect(&session.files(), &DocumentFiles::saved, this, [this](const QString&, bool present) {
    if (present) take();
  });
}

void Thumbnails::take() {
  const QString project = m_session.document().path();
  if (project.isEmpty() || m_session.files().isSample(project)) return;
  std::optional<SceneShot> shot = m_shot();
  if (!shot) return;
  m_worker.run([this, project, shot = std::move(*shot)] {
    if (!keep(shot, thumbnailPath(project))) return;
    QMetaObject::invokeMethod(this, [this, project] { Q_EMIT taken(project); });
  });
}

void Thumbnails::takeOwn() {
  std::optional<SceneShot> shot = m_shot();
  if (!shot) {
    Q_EMIT ownTaken(QStringLiteral("The view shows no matter."));
    return;
  }
  m_worker.run([this, asked = ++m_asked, shot = std::move(*shot)] {
    std::string picture;
    QString problem;
    try {
      picture = thumbnailOf(drawShot(shot, kDrawnOwn));
    } catch (const Error& error) {
      problem = QStringLiteral("No picture could be drawn: %1.").arg(QString::fromUtf8(error.what()));
    }
    QMetaObject::invokeMethod(this, [this, asked, picture = std::move(picture), problem] {
      if (asked != m_asked) return;
      ProjectAbout about = m_session.document().about();
      about.thumbnail = picture;
      if (problem.isEmpty()) m_session.document().setAbout(about, QStringLiteral("picture"));
      Q_EMIT ownTaken(problem);
    });
  });
}

}  // namespace ps
