// SPDX-License-Identifier: Apache-2.0
#include "ui/welcome/gallery.h"

#include "ui/film/thumbnail.h"
#include "ui/session/documentfiles.h"
#include "ui/session/worker.h"
#include "ui/welcome/thumbnails.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QLocale>

// Q_INIT_RESOURCE cannot stand in a namespace; the call keeps the linker from dropping a static library's resources.
static void initGalleryResources() { Q_INIT_RESOURCE(gallery); }

namespace ps {
namespace {

constexpr qint64 kMostBytes = 4 << 20;  // of a file that is read for its words alone

struct Words {
  QString title, toTry;
  std::string thumbnail;  ///< "" where the project has no picture of its own
};

/// Empty where the file cannot be read, is none of ours, or is too large to be looked into.
Words wordsIn(const QString& path) {
  QFile file(path);
  if (file.size() > kMostBytes || !file.open(QIODevice::ReadOnly)) return {};
  const QJsonObject project = QJsonDocument::fromJson(file.readAll()).object();
  return {project[QLatin1String("title")].toString(), project[QLatin1String("toTry")].toString(),
          project[QLatin1String("thumbnail")].toString().toStdString()};
}

std::vector<Sample> readList(const QJsonArray& list, const QString& folder) {
  std::vector<Sample> samples;
  for (const QJsonValue& value : list) {
    const QJsonObject entry = value.toObject();
    const QString name = entry[QLatin1String("file")].toString();
    Sample sample;
    sample.path = folder + QLatin1Char('/') + name + QStringLiteral(".json");
    const Words words = wordsIn(sample.path);
    sample.title = words.title;
    if (sample.title.isEmpty()) continue;  // not installed
    sample.summary = entry[QLatin1String("summary")].toString();
    sample.toTry = entry[QLatin1String("toTry")].toString(words.toTry);
    for (const QJsonValue& tag : entry[QLatin1String("tags")].toArray()) sample.tags << tag.toString();
    sample.picture = QImage(QStringLiteral(":/gallery/%1.jpg").arg(QFileInfo(name).fileName()));
    samples.push_back(std::move(sample));
  }
  return samples;
}

}  // namespace

QString dayText(const QDateTime& time, const QDateTime& now) {
  const QString clock = QStringLiteral(", ") + time.toString(QStringLiteral("HH:mm"));
  const qint64 days = time.date().daysTo(now.date());
  if (days == 0) return QStringLiteral("Today") + clock;
  if (days == 1) return QStringLiteral("Yesterday") + clock;
  const bool sameYear = time.date().year() == now.date().year();
  return QLocale::c().toString(time.date(), sameYear ? QStringLiteral("d MMMM") : QStringLiteral("d MMMM yyyy"));
}

Gallery::Gallery(const QString& folder, Worker& worker, QObject* parent)
    : QObject(parent), m_folder(folder), m_worker(worker) {
  if (folder.isEmpty()) return;
  worker.run([this, folder] {
    initGalleryResources();
    QFile file(QStringLiteral(":/gallery/gallery.json"));
    if (!file.open(QIODevice::ReadOnly)) return;
    const QJsonObject index = QJsonDocument::fromJson(file.readAll()).object();
    auto samples = readList(index[QLatin1String("samples")].toArray(), folder);
    auto templates = readList(index[QLatin1String("templates")].toArray(), folder + QStringLiteral("/templates"));
    QMetaObject::invokeMethod(this, [this, samples = std::move(samples), templates = std::move(templates)]() mutable {
      m_samples = std::move(samples);
      m_templates = std::move(templates);
      Q_EMIT loaded();
    });
  });
}

QStringList Gallery::tags() const {
  QStringList tags;
  for (const Sample& sample : m_samples) tags += sample.tags;
  tags.removeDuplicates();
  return tags;
}

void Gallery::readRecent(std::function<void(std::vector<RecentProject>)> then) {
  m_worker.run([this, folder = m_folder, then = std::move(then)] {
    std::vector<RecentProject> recent;
    for (const QString& path : DocumentFiles::everRecent()) {
      if (!folder.isEmpty() && path.startsWith(folder + QLatin1Char('/'))) continue;
      const QFileInfo info(path);
      if (!info.isFile()) {
        recent.push_back({path, info.completeBaseName(), {}, {}, {}, true});
        continue;
      }
      const Words words = wordsIn(path);
      const QImage own = pictureOf(words.thumbnail);
      recent.push_back({path, words.title.isEmpty() ? info.completeBaseName() : words.title, words.toTry,
                        info.lastModified(), own.isNull() ? QImage(thumbnailPath(path)) : own});
    }
    QMetaObject::invokeMethod(this, [then, recent = std::move(recent)]() mutable { then(std::move(recent)); });
  });
}

}  // namespace ps
