// SPDX-License-Identifier: Apache-2.0
#include "ui/film/thumbnail.h"

#include <QBuffer>
#include <QImage>
#include <QImageReader>

namespace ps {
namespace {

/// Who reads a part of a picture, or nothing, complains on standard error.
bool isWholePng(const QByteArray& bytes) {
  return bytes.startsWith("\x89PNG\r\n\x1a\n") && bytes.contains("IEND\xae\x42\x60\x82");
}

}  // namespace

std::string thumbnailOf(const QImage& picture) {
  constexpr int kWidth = 320, kHeight = 180;
  if (picture.isNull()) return {};
  const QImage filling = picture.scaled(kWidth, kHeight, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation);
  const QImage middle = filling.copy((filling.width() - kWidth) / 2, (filling.height() - kHeight) / 2, kWidth, kHeight);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  middle.convertToFormat(QImage::Format_RGB888).save(&buffer, "PNG");
  return bytes.toBase64().toStdString();
}

QImage pictureOf(const std::string& thumbnail) {
  constexpr int kMost = 1024;  // others may have written it
  QByteArray bytes = QByteArray::fromBase64(QByteArray::fromStdString(thumbnail));
  if (!isWholePng(bytes)) return {};
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::ReadOnly);
  QImageReader reader(&buffer, "PNG");
  reader.setAutoDetectImageFormat(false);
  const QSize size = reader.size();
  if (!size.isValid() || size.width() > kMost || size.height() > kMost) return {};
  return reader.read();
}

}  // namespace ps
