// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QDateTime>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtGui/QImage>

#include <functional>
#include <vector>

namespace ps {

class Worker;

/// A project that comes with the program, as the gallery shows it.
struct Sample {
  QString path, title;
  QString summary;   ///< one line
  QString toTry;     ///< what to change first; "" of a template
  QStringList tags;  ///< words to choose by
  QImage picture;    ///< null: none was made yet
};

/// A project that was opened or saved lately.
struct RecentProject {
  QString path, title;
  QString toTry;      ///< what the project says; "": nothing
  QDateTime time;     ///< of its file
  QImage picture;     ///< null: none was made yet
  bool gone = false;  ///< it is not there any more; its title is what it was called
};

/// "Today, 18:41", "Yesterday, 18:41", "12 November".
QString dayText(const QDateTime& time, const QDateTime& now);

/// The samples and templates of a folder: words and pictures from resources/gallery, titles from the projects
/// themselves, which are read by `worker`. UI thread.
class Gallery : public QObject {
  Q_OBJECT
 public:
  /// `folder`: "" for none. `worker` must end before this object does.
  Gallery(const QString& folder, Worker& worker, QObject* parent = nullptr);
  const std::vector<Sample>& samples() const { return m_samples; }      ///< in the order in which they are shown
  const std::vector<Sample>& templates() const { return m_templates; }  ///< likewise
  QStringList tags() const;                                             ///< of the samples, in their order
  /// Calls `then` with what was opened lately, samples left out.
  void readRecent(std::function<void(std::vector<RecentProject>)> then);

 Q_SIGNALS:
  void loaded();

 private:
  QString m_folder;
  Worker& m_worker;
  std::vector<Sample> m_samples, m_templates;
};

}  // namespace ps
