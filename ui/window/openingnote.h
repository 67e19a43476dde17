// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

namespace ps {

class DocumentFiles;
class StatusLine;

/// A project that takes a while to be read is named in the status line, and the pointer says that one waits. The scene
/// that is open goes on meanwhile.
class OpeningNote : public QObject {
  Q_OBJECT
 public:
  static constexpr int kWait = 300;  ///< ms: what comes sooner is not told
  OpeningNote(DocumentFiles& files, StatusLine& status, QObject* parent);
  ~OpeningNote() override;
  bool cancel();  ///< gives up what is told; false where nothing is

 private:
  void tell();
  void end();
  DocumentFiles& m_files;
  StatusLine& m_status;
  QString m_name, m_told;
  QTimer m_wait;
};

}  // namespace ps
