// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/outlinermodel.h"

#include "core/simulation/graphsource.h"
#include "ui/panels/outliner.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/sourcemime.h"

#include <QtCore/QDataStream>
#include <QtCore/QIODevice>
#include <QtCore/QMimeData>

namespace ps {
namespace {
constexpr char kRowsMime[] = "application/x-phasesketch-outliner-rows";

bool isBody(const QModelIndex& row) {
  return row.isValid() && row.data(outline::kKind).toInt() == static_cast<int>(OutlineKind::Body);
}

}  // namespace

QStringList OutlinerModel::mimeTypes() const {
  return {QLatin1String(kRowsMime), QLatin1String(kSourceMime), QLatin1String(kMaterialMime),
          QLatin1String(kInstalledMime), QLatin1String(kPresetMime)};
}

QMimeData* OutlinerModel::mimeData(const QModelIndexList& indexes) const {
  if (indexes.isEmpty()) return nullptr;
  auto* data = new QMimeData;
  QByteArray rows;
  QDataStream stream(&rows, QIODevice::WriteOnly);
  for (const QModelIndex& index : indexes)
    stream << index.data(outline::kKind).toInt() << index.data(outline::kId).toString();
  data->setData(QLatin1String(kRowsMime), rows);
  const QModelIndex& first = indexes.front();
  if (first.data(outline::kKind).toInt() == static_cast<int>(OutlineKind::Probe))
    data->setData(QLatin1String(kSourceMime),
                  QByteArray::fromStdString(probeSource(first.data(outline::kId).toString().toStdString())));
  if (const QString material = first.data(outline::kMaterial).toString(); !material.isEmpty())
    data->setData(QLatin1String(kMaterialMime), material.toUtf8());
  return data;
}

bool OutlinerModel::canDropMimeData(const QMimeData* data, Qt::DropAction, int, int, const QModelIndex& parent) const {
  if (data->hasFormat(QLatin1String(kRowsMime))) return parent.isValid();
  return isBody(parent) && !parent.data(outline::kLocked).toBool() && carriesMaterial(*data);
}

/// The document moves them, and the rows are made anew: nothing is left for the view to do.
bool OutlinerModel::dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                                 const QModelIndex& parent) {
  if (!canDropMimeData(data, action, row, column, parent)) return false;
  if (!data->hasFormat(QLatin1String(kRowsMime))) {
    Q_EMIT materialDropped(*data, parent.data(outline::kId).toString().toStdString());
    return false;
  }
  QByteArray bytes = data->data(QLatin1String(kRowsMime));
  QDataStream stream(&bytes, QIODevice::ReadOnly);
  std::vector<SelectedItem> rows;
  while (!stream.atEnd()) {
    int kind = 0;
    QString id;
    stream >> kind >> id;
    rows.push_back({static_cast<OutlineKind>(kind), id.toStdString()});
  }
  // A body holds no rows: what is dropped on it comes to stand before it.
  if (isBody(parent)) {
    Q_EMIT dropped(rows, parent.parent(), parent.row());
  } else {
    Q_EMIT dropped(rows, parent, row);
  }
  return false;
}

}  // namespace ps
