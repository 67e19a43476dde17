// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"
#include "ui/document/port.h"
#include "ui/session/selection.h"

#include <QtWidgets/QWidget>

#include <map>
#include <string>

class QStandardItem;
class QStandardItemModel;
class QTreeView;

namespace ps {

class Document;
class Session;

/// Roles of the outliner's items.
namespace outline {
inline constexpr int kKind = Qt::UserRole + 1, kId = Qt::UserRole + 2, kIcon = Qt::UserRole + 3,
                     kDetail = Qt::UserRole + 4, kSwatch = Qt::UserRole + 5, kVisible = Qt::UserRole + 6,
                     kLocked = Qt::UserRole + 7, kPlaceholder = Qt::UserRole + 8, kMaterial = Qt::UserRole + 9;
}

/// Bodies, walls, probes and air as a tree: icon, name, count, swatch, lock, eye. F2 renames a body, tap
/// or drain; their menu is the window's.
class Outliner : public QWidget {
  Q_OBJECT
 public:
  Outliner(Session& session, Selection& selection, QWidget* parent = nullptr);
  void rebuild();
  std::pair<OutlineKind, std::string> selected() const;  ///< the row that shows as selected
  void renameSelected();
  void toggleVisible();  ///< of the selected body
  void toggleLocked();
  QTreeView* view() const { return m_view; }
  QSize sizeHint() const override { return {204, 300}; }

 Q_SIGNALS:
  void menuRequested(const QPoint& global);  ///< of the selected body, tap or drain

 private:
  QStandardItem* add(QStandardItem* parent, OutlineKind kind, const std::string& id, const QString& name,
                     const QString& icon);
  void addBodies(QStandardItem* scene);
  void onChanged(const ChangeEvent& event);
  void showSelection();
  void readValues();  ///< counts, probe values
  void refreshSurroundings();
  void refreshCounts();
  QStandardItem* find(OutlineKind kind, const std::string& id) const;

  Session& m_session;
  Document& m_document;
  Selection& m_selection;
  QStandardItemModel* m_model;
  QTreeView* m_view;
  SnapshotPtr m_snapshot;
  bool m_building = false;
};

}  // namespace ps
