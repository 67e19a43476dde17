// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/selection.h"

#include <QtGui/QStandardItemModel>

#include <vector>

namespace ps {

/// The outliner's rows as they are dragged: within it to another place, a probe to a graph as the curve that it gives,
/// and what is made of a material to where one is wanted.
class OutlinerModel : public QStandardItemModel {
  Q_OBJECT
 public:
  using QStandardItemModel::QStandardItemModel;
  /// The document moves them: a view that thinks it has moved rows takes them away.
  Qt::DropActions supportedDropActions() const override { return Qt::CopyAction; }
  QStringList mimeTypes() const override;
  QMimeData* mimeData(const QModelIndexList& indexes) const override;
  bool canDropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                       const QModelIndex& parent) const override;
  bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                    const QModelIndex& parent) override;

 Q_SIGNALS:
  void materialDropped(const QMimeData& data, const std::string& body);
  void dropped(const std::vector<ps::SelectedItem>& rows, const QModelIndex& parent, int row);
};

}  // namespace ps
