// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/progress.h"
#include "core/io/meshimport.h"
#include "ui/session/worker.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QTimer>

#include <cstdint>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

namespace ps {

class Notices;
class Session;

/// What a mesh comes in as: matter that fills it, or a wall of its shape, which is a fixed body of its surface alone
/// that lets no heat through.
enum class MeshUse : uint8_t { Matter, Wall };

/// Meshes that are to come into the scene: read in the background, one after the other, once there is a scene. How far
/// that is stands over the view, with a way to give up all that is left.
class MeshQueue : public QObject {
  Q_OBJECT
 public:
  static constexpr const char* kTopic = "mesh";  ///< of its notices

  struct File {
    QString path;
    MeshUse use = MeshUse::Matter;
    QString name() const;
  };
  /// What became of those that were asked for until none was left.
  struct Outcome {
    int wanted = 0;
    MeshUse use = MeshUse::Matter;                    ///< of the last one
    std::vector<std::pair<QString, QString>> unread;  ///< name, and a sentence that says why
    QStringList guessed;                              ///< names of those that say no unit
  };

  MeshQueue(Session& session, Notices& notices, QObject* parent = nullptr);
  ~MeshQueue() override;
  void add(const QStringList& paths, MeshUse use);
  const Outcome& outcome() const { return m_outcome; }
  void noteGuess(const QString& name) { m_outcome.guessed << name; }
  /// Gives up what is being read, and what waits. False where nothing is.
  bool cancel();

 Q_SIGNALS:
  void read(const ps::MeshQueue::File& file, const std::shared_ptr<ps::ImportedMesh>& imported);
  void failed(const ps::MeshQueue::File& file, const QString& problem);
  void ended();  ///< none is left
  /// Of the one that is read, for a while already; often. -1 per cent: no more.
  void reading(const QString& stage, int percent);

 private:
  void open();
  void next();
  void onRead(const std::shared_ptr<ImportedMesh>& imported, const QString& problem);
  void showReading();
  void stop();
  QString place() const;

  Session& m_session;
  Notices& m_notices;
  bool m_isOpen = false;  ///< there is a scene
  std::deque<File> m_waiting;
  File m_file;                          ///< that is being read
  std::shared_ptr<Progress> m_reading;  ///< of it; nullptr: none is
  Outcome m_outcome;
  QElapsedTimer m_since;  ///< it is being read
  QTimer m_clock;         ///< tells how far it is
  bool m_tells = false;   ///< that has begun
  Worker m_worker;        ///< ends first
};

}  // namespace ps
