// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QDateTime>
#include <QtCore/QObject>
#include <QtCore/QString>

#include <vector>

namespace ps {

enum class MessageLevel { Ok, Info, Warning, Error };

/// A way out that a message offers: "Find plugin…" and what it leads to.
struct MessageLink {
  QString text, target;
};

struct Message {
  MessageLevel level = MessageLevel::Info;
  QDateTime time;
  QString where, text;
  int count = 1;  ///< the same again within the session
  std::vector<MessageLink> links{};
};

/// What happened, where, what to do: everything that a dock bar or the status line said, and the program's log.
class MessageLog : public QObject {
  Q_OBJECT
 public:
  explicit MessageLog(QObject* parent = nullptr);
  /// UI thread. The newest message again only raises its count.
  void add(MessageLevel level, const QString& where, const QString& text, std::vector<MessageLink> links = {});
  const std::vector<Message>& messages() const { return m_messages; }
  /// Warnings and errors since the list was last looked at.
  int unseen() const { return m_unseen; }
  void markSeen();
  QString allText() const;
  /// Sends the program's log here, from any thread, while this object lives.
  void takeLog();
  ~MessageLog() override;

 Q_SIGNALS:
  void changed();

 private:
  std::vector<Message> m_messages;
  int m_unseen = 0;
  bool m_hooked = false;
};

const char* messageIcon(MessageLevel level);

}  // namespace ps
