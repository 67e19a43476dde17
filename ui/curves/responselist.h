// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

class QLabel;
class QListWidget;
class QListWidgetItem;
class QToolButton;

namespace ps {

class CurveTarget;
class PanelHeader;
class Session;
struct OtherMaterial;

/// The responses of the current material, each with a small curve and its value where the material is; below, the
/// other materials whose curves may be drawn for comparison, to which any is added by a menu or dropped, and what has
/// keys over time, to edit those.
class ResponseList : public QWidget {
  Q_OBJECT
 public:
  ResponseList(Session& session, CurveTarget& target, QWidget* parent = nullptr);
  QListWidget* list() const { return m_list; }
  QListWidget* others() const { return m_others; }
  QListWidget* tracks() const { return m_tracks; }
  QToolButton* addButton() const { return m_add; }  ///< its menu has what is installed

 Q_SIGNALS:
  void chosen();  ///< by hand, a response or keys, which may have been chosen already

 protected:
  void showEvent(QShowEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void rebuild();
  void rebuildTracks();
  void showCompared();
  void addOther(const OtherMaterial& other);
  void makeAddMenu();
  void refresh();  ///< values, at the temperature that the material has now
  void onCompared(QListWidgetItem* item);
  Session& m_session;
  CurveTarget& m_target;
  PanelHeader* m_header;
  QLabel *m_heading, *m_keyed;
  QListWidget *m_list, *m_others, *m_tracks;
  QToolButton* m_add;
};

}  // namespace ps
