// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"
#include "ui/document/placement.h"
#include "ui/document/port.h"
#include "ui/session/selection.h"

#include <QtCore/QStringList>
#include <QtWidgets/QWidget>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

class QDragMoveEvent;
class QLabel;
class QLayout;
class QModelIndex;
class QStandardItem;
class QTreeView;

namespace ps {

class Document;
class FilterField;
class NothingFound;
class OutlinerModel;
class Session;

/// Roles of the outliner's items.
namespace outline {
inline constexpr int kKind = Qt::UserRole + 1, kId = Qt::UserRole + 2, kIcon = Qt::UserRole + 3,
                     kDetail = Qt::UserRole + 4, kSwatch = Qt::UserRole + 5, kVisible = Qt::UserRole + 6,
                     kLocked = Qt::UserRole + 7, kPlaceholder = Qt::UserRole + 8, kMaterial = Qt::UserRole + 9;
}

/// Groups, bodies with their pins, taps, drains, walls, probes and air as a tree: icon, name, count, swatch, lock, eye.
/// F2 renames, a drag puts in another place or group, the field on top searches; the menu of what is selected is the
/// window's.
class Outliner : public QWidget {
  Q_OBJECT
 public:
  Outliner(Session& session, Selection& selection, QWidget* parent = nullptr);
  void rebuild();
  std::pair<OutlineKind, std::string> selected() const;  ///< the row that shows as selected
  void renameSelected();
  void toggleVisible();  ///< of all that is selected, to what the last one is not
  void toggleLocked();
  /// Which rows somebody has folded, after the file of the project that they are of.
  QStringList folded() const;
  void fold(const QStringList& left);  ///< what folded() was; nothing where another project is open
  QTreeView* view() const { return m_view; }
  QSize sizeHint() const override { return {204, 300}; }
  bool eventFilter(QObject* watched, QEvent* event) override;

 Q_SIGNALS:
  void menuRequested(const QPoint& global);  ///< of what is selected

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QStandardItem* add(QStandardItem* parent, OutlineKind kind, const std::string& id, const QString& name,
                     const QString& icon);
  void addGroups(QStandardItem* scene);
  void addBodies(QStandardItem* scene);
  void addPins(QStandardItem* row, const Body& body);
  void showKind(QStandardItem* row, const Body& body) const;
  void addPorts(QStandardItem* scene);
  void addProbes(QStandardItem* scene);
  static void mark(QStandardItem* item, bool visible, bool locked);
  QStandardItem* parentOf(QStandardItem* scene, Owner owner, const std::string& id) const;
  void onChanged(const ChangeEvent& event);
  void noteFolded(const QModelIndex& row, bool folded);
  void foldAgain(const QModelIndex& under = {});
  void showSelection();
  void takeSelection();
  SelectedItem itemOf(const QModelIndex& index) const;
  std::vector<Address> thingsOf(int kind, const std::string& id) const;
  std::vector<Address> selectedThings() const;
  void rename(int kind, const std::string& id, const QString& name);
  bool holdsAll(const SceneGroup& group) const;
  QLayout* makeSearch();
  void filter();
  void moveRows(std::vector<SelectedItem> rows, const QModelIndex& parent, int row);
  static void moveGroup(SceneOrder& order, const std::string& id, const std::string& before);
  void tellDrop(const QDragMoveEvent& event) const;
  void readValues();  ///< counts, probe values
  void refreshSurroundings();
  void countMatter();
  void refreshCounts();
  QStandardItem* find(OutlineKind kind, const std::string& id) const;

  Session& m_session;
  Document& m_document;
  Selection& m_selection;
  OutlinerModel* m_model;
  QTreeView* m_view;
  FilterField* m_filter;
  QLabel* m_bare;  ///< what to do where there is no matter
  NothingFound* m_nothing;
  std::vector<SceneGroup> m_groups;
  SnapshotPtr m_snapshot;
  std::map<std::string, size_t> m_counts;          ///< particles of it, by body and tap
  std::set<std::pair<int, std::string>> m_folded;  ///< OutlineKind and id of rows
  bool m_building = false;
};

}  // namespace ps
