// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/library/librarypage.h"

#include <QtCore/QObject>

class QMenu;
class QStackedWidget;

namespace ps {

class Actions;
class NoticeBar;
class Notices;
class Selection;
class Session;

/// The material library in the middle of the window, and the files that it reads and writes.
class LibraryActions : public QObject {
  Q_OBJECT
 public:
  /// `presets`: their folder; "": the user's. `scene`: what of `centre` shows without it.
  LibraryActions(Session& session, Selection& selection, const Actions& actions, Notices& notices,
                 QStackedWidget& centre, QWidget& scene, const QString& presets, QObject* parent = nullptr);
  void addTo(QMenu* menu);
  LibraryPage* page() const { return m_page; }
  MaterialLibrary& library() { return m_library; }

 private:
  /// Keys of two entries, "" for any. One form: what is open already takes them.
  void openMix(const QString& first, const QString& second);
  void openMixture(const std::string& material);  ///< of the scene, a form for each
  void offerWaiting(NoticeBar& bar);
  void chooseImport();
  void chooseExport(const LibraryEntry& entry);
  Session& m_session;
  Selection& m_selection;
  const Actions& m_actions;
  QStackedWidget& m_centre;
  MaterialLibrary m_library;
  LibraryPage* m_page;
};

}  // namespace ps
