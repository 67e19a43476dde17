// SPDX-License-Identifier: Apache-2.0
#include "ui/window/meshqueue.h"

#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <QtCore/QFileInfo>

#include <utility>

namespace ps {
namespace {

constexpr int kPatience = 300;  ///< ms until reading is told of, and until that is told anew

QString topic() { return QString::fromLatin1(MeshQueue::kTopic); }

}  // namespace

QString MeshQueue::File::name() const { return QFileInfo(path).fileName(); }

MeshQueue::MeshQueue(Session& session, Notices& notices, QObject* parent)
    : QObject(parent), m_session(session), m_notices(notices) {
  m_clock.setInterval(kPatience);
  connect(&m_clock, &QTimer::timeout, this, &MeshQueue::showReading);
  connect(&session, &Session::projectShown, this, &MeshQueue::open);
  connect(&session.files(), &DocumentFiles::openFailed, this, &MeshQueue::open);
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    // They were meant for the scene before.
    if (m_isOpen && std::holds_alternative<ProjectOpened>(event)) cancel();
  });
}

MeshQueue::~MeshQueue() {
  if (m_reading) m_reading->cancel();
}

void MeshQueue::add(const QStringList& paths, MeshUse use) {
  if (!m_reading && m_waiting.empty()) m_outcome = {};
  for (const QString& path : paths) m_waiting.push_back({path, use});
  m_outcome.wanted += static_cast<int>(paths.size());
  m_outcome.use = use;
  if (m_isOpen) return next();
  const QString what = m_outcome.wanted == 1 ? QStringLiteral("“%1” waits.").arg(m_waiting.front().name())
                                             : QStringLiteral("%1 meshes wait.").arg(m_outcome.wanted);
  m_notices.bar().show(topic(), MessageLevel::Info, what,
                       QStringLiteral("The program is still starting; then they come into the scene."),
                       {NoticeBar::cancelButton([this] { cancel(); })});
}

void MeshQueue::open() {
  if (!std::exchange(m_isOpen, true) && !m_waiting.empty()) m_notices.bar().close(topic());
  next();
}

void MeshQueue::next() {
  if (m_reading || m_waiting.empty()) return;
  m_file = std::move(m_waiting.front());
  m_waiting.pop_front();
  m_reading = std::make_shared<Progress>();
  m_reading->expect(1);
  m_since.start();
  m_clock.start();
  m_worker.run([this, path = m_file.path.toStdString(), reading = m_reading] {
    const ProgressScope scope(reading.get());
    auto imported = std::make_shared<ImportedMesh>();
    QString problem;
    try {
      *imported = importMesh(path);
    } catch (const Cancelled&) {
      return;
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, reading, imported, problem] {
      if (reading == m_reading) onRead(imported, problem);
    });
  });
}

void MeshQueue::onRead(const std::shared_ptr<ImportedMesh>& imported, const QString& problem) {
  stop();
  m_notices.bar().close(topic());
  const File file = m_file;
  if (problem.isEmpty()) {
    Q_EMIT read(file, imported);
  } else {
    const QString why = QString(problem).remove(file.path + QStringLiteral(": ")) + QLatin1Char('.');
    m_outcome.unread.emplace_back(file.name(), why);
    Q_EMIT failed(file, problem);
  }
  if (m_waiting.empty() && !m_reading) Q_EMIT ended();
  next();
}

/// ", 2 of 5"
QString MeshQueue::place() const {
  if (m_outcome.wanted < 2) return {};
  return QStringLiteral(", %1 of %2").arg(m_outcome.wanted - static_cast<int>(m_waiting.size())).arg(m_outcome.wanted);
}

void MeshQueue::showReading() {
  const Progress::State state = m_reading->state();
  const QString stage = QString::fromUtf8(state.stage ? state.stage : "Beginning");
  const double left = secondsLeft(static_cast<double>(m_since.elapsed()) / 1000, state.done);
  const QString text = stage + QStringLiteral(", ") + progressText(state.done, left);
  if (std::exchange(m_tells, true)) {
    m_notices.bar().setText(topic(), text);
  } else {
    m_notices.bar().show(topic(), MessageLevel::Info, QStringLiteral("Reading “%1”%2.").arg(m_file.name(), place()),
                         text, {NoticeBar::cancelButton([this] { cancel(); })});
  }
  Q_EMIT reading(stage, static_cast<int>(100 * state.done));
}

void MeshQueue::stop() {
  if (m_reading) m_reading->cancel();
  m_reading.reset();
  m_clock.stop();
  if (std::exchange(m_tells, false)) Q_EMIT reading({}, -1);
}

bool MeshQueue::cancel() {
  if (!m_reading && m_waiting.empty()) return false;
  const QString name = m_reading ? m_file.name() : m_waiting.front().name();
  const auto left = static_cast<int>(m_waiting.size()) + (m_reading ? 1 : 0);
  stop();
  m_waiting.clear();
  const QString what = left == 1 ? QStringLiteral("Reading “%1” was given up.").arg(name)
                                 : QStringLiteral("Reading “%1” and %2 more was given up.").arg(name).arg(left - 1);
  const int come = m_outcome.wanted - left - static_cast<int>(m_outcome.unread.size());
  QString text =
      come == 0 ? QStringLiteral("The scene is as it was.") : QStringLiteral("Those that were read before are in it.");
  for (const auto& [file, why] : m_outcome.unread) text += QStringLiteral(" “%1”: %2").arg(file, why);
  m_notices.bar().show(topic(), MessageLevel::Info, what, text);
  return true;
}

}  // namespace ps
