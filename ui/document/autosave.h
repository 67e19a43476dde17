// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QDateTime>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <memory>
#include <vector>

class QLockFile;

namespace ps {

class Document;
class Worker;

/// A copy that an earlier session left behind.
struct AutosavedSession {
  QString stem;  ///< files are `stem`.json (the project, when it had unsaved changes), .note and .lock
  QString copy;  ///< the project's copy; "" when everything was saved
  QString path;  ///< the file it belongs to; "" when it was never saved
  QString title;
  QDateTime time;
  bool closed = false;  ///< ended in order: reopen without a question
};

/// Keeps a copy of unsaved work in the user's state directory: every 30 s and at close. Closing therefore asks nothing,
/// and a crash loses half a minute at most.
class Autosave : public QObject {
  Q_OBJECT
 public:
  static constexpr int kInterval = 30000;  ///< ms
  /// `directory`: created when missing. `worker` must end before this object does.
  Autosave(Document& document, Worker& worker, const QString& directory, QObject* parent = nullptr);
  ~Autosave() override;
  static QString standardDirectory();

  /// Sessions of programs that no longer run, newest first.
  static std::vector<AutosavedSession> leftBehind(const QString& directory);
  static void discard(const AutosavedSession& session);

  void start();    ///< the timer
  void saveNow();  ///< when something changed since the last copy
  void close();    ///< last copy, with the note that the session ended in order; blocks until it is written

 Q_SIGNALS:
  void autosaved(const QDateTime& time);
  void failed(const QString& problem);

 private:
  void write(bool closed);
  Document& m_document;
  Worker& m_worker;
  QString m_stem;
  std::unique_ptr<QLockFile> m_lock;
  QTimer m_timer;
  uint64_t m_written = 0;
};

}  // namespace ps
