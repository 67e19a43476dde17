// SPDX-License-Identifier: Apache-2.0
#include "ui/session/settingsformat.h"

#include <QtCore/QDataStream>
#include <QtCore/QFileDevice>
#include <QtCore/QIODevice>
#include <QtCore/QSettings>

namespace ps {
namespace {

constexpr quint32 kMark = 0x50535345;  // "PSSE"
constexpr auto kStream = QDataStream::Qt_6_0;

bool read(QIODevice& device, QSettings::SettingsMap& values) {
  QDataStream in(&device);
  in.setVersion(kStream);
  quint32 mark = 0;
  in >> mark;
  if (mark == kMark) in >> values;
  return mark == kMark && in.status() == QDataStream::Ok;
}

/// Qt takes the file's place when this is true, and takes no notice of what its buffer could not write.
bool write(QIODevice& device, const QSettings::SettingsMap& values) {
  QDataStream out(&device);
  out.setVersion(kStream);
  out << kMark << values;
  auto* file = qobject_cast<QFileDevice*>(&device);
  return out.status() == QDataStream::Ok && file && file->flush();
}

}  // namespace

void keepSettingsWhole() {
  const QSettings before;
  QSettings::setDefaultFormat(QSettings::registerFormat(QStringLiteral("settings"), read, write));
  QSettings now;
  if (!now.allKeys().isEmpty()) return;
  for (const QString& key : before.allKeys()) now.setValue(key, before.value(key));
}

}  // namespace ps
