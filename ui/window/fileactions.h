// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QByteArray>
#include <QtCore/QObject>
#include <QtCore/QString>

#include <functional>
#include <memory>

class QMenu;

namespace ps {

class Actions;
class ExportActions;
class FileGuard;
class GraphsPanel;
class Notices;
class RecordingActions;
class RestoreOffer;
class Session;
class ShareActions;
class Viewport;

/// The menu File: opening, saving, exporting, and what is said about it. No failure here touches the present scene.
class FileActions : public QObject {
  Q_OBJECT
 public:
  struct Options {
    QString project;                ///< to open first; "": the last session, else the sample
    QString sample;                 ///< path of the first sample; "": an empty scene
    QString samples;                ///< folder of all that nobody saves to; "": the first sample is the only one
    bool exitOnBadProject = false;  ///< startFailed() instead of a notice
  };
  FileActions(Session& session, const Actions& actions, Notices& notices, RestoreOffer& restore, const Options& options,
              QObject* parent = nullptr);
  ~FileActions() override;
  void makeMenu(QMenu* menu, Viewport* view);
  /// Before plugins are there, it becomes the project to begin with.
  void open(const QString& path);
  void saveTo(const QString& path);
  void exportCsv();
  void exportGraph(const GraphsPanel& graphs, const std::string& id, const QString& ending);  ///< "png", "svg", "csv"
  QMenu* samplesMenu() const { return m_samples; }
  void updateRestore();  ///< enabled while unsaved work waits
  void showNotSaved(const QString& problem, const QString& more);

 Q_SIGNALS:
  void startFailed(const QString& problem);

 private:
  void openFirst();
  void fillRecent();
  void explain(QMenu* menu) const;
  void setEnabled(bool on);  ///< what needs plugins
  void chooseOpen();
  QString folderToOpen() const;
  QString besideProject(const QString& name) const;
  void save();
  void chooseSave();
  QString chooseFile();       ///< to save to; "" when given up
  void saveWithState();       ///< matter as it stands, into the project and its file
  void updateStateActions();  ///< enabled where the project holds a state
  void exportPicture();
  void writeFile(const QString& path, std::function<QByteArray()> content, const QString& what);
  void onOpened(const QString& path, const QStringList& warnings, double seconds);
  void onOpenFailed(const QString& path, const QString& problem);
  void onOpeningGivenUp(const QString& path, bool first);
  void onSaved(const QString& path, bool present);
  void onStateLeftOut(const QString& path, const QString& why, bool present);
  void onSaveFailed(const QString& path, const QString& problem, bool present);

  Session& m_session;
  const Actions& m_actions;
  Notices& m_notices;
  RestoreOffer& m_restore;
  Options m_options;
  std::unique_ptr<FileGuard> m_guard;
  std::unique_ptr<RecordingActions> m_recordings;
  std::unique_ptr<ExportActions> m_exports;
  std::unique_ptr<ShareActions> m_sharing;
  Viewport* m_view = nullptr;
  QMenu *m_recent = nullptr, *m_samples = nullptr;
  QString m_stateTo;       ///< file that waits for the state; "": none
  bool m_leftOut = false;  ///< what is being saved had a state that did not fit
  bool m_first = true;
};

}  // namespace ps
