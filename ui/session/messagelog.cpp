// SPDX-License-Identifier: Apache-2.0
#include "ui/session/messagelog.h"

#include "core/base/log.h"

#include <QtCore/QStringList>

#include <utility>

namespace ps {
namespace {

constexpr size_t kMost = 2000;

MessageLevel levelOf(LogLevel level) {
  if (level == LogLevel::Error) return MessageLevel::Error;
  return level == LogLevel::Warning ? MessageLevel::Warning : MessageLevel::Info;
}

}  // namespace

const char* messageIcon(MessageLevel level) {
  switch (level) {
    case MessageLevel::Ok:
      return "check";
    case MessageLevel::Info:
      return "info";
    case MessageLevel::Warning:
      return "warning";
    case MessageLevel::Error:
      return "error";
  }
  return "info";
}

MessageLog::MessageLog(QObject* parent) : QObject(parent) {}

MessageLog::~MessageLog() {
  if (m_hooked) setLogHook({});
}

void MessageLog::takeLog() {
  m_hooked = true;
  setLogHook([this](LogLevel level, std::string_view text) {
    const QString message = QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
    QMetaObject::invokeMethod(this,
                              [this, level, message] { add(levelOf(level), QStringLiteral("Program"), message); });
  });
}

void MessageLog::add(MessageLevel level, const QString& where, const QString& text, std::vector<MessageLink> links) {
  if (!m_messages.empty() && m_messages.back().text == text && m_messages.back().where == where) {
    ++m_messages.back().count;
    m_messages.back().time = QDateTime::currentDateTime();
  } else {
    if (m_messages.size() >= kMost) m_messages.erase(m_messages.begin());
    m_messages.push_back({level, QDateTime::currentDateTime(), where, text, 1, std::move(links)});
    if (level == MessageLevel::Warning || level == MessageLevel::Error) ++m_unseen;
  }
  Q_EMIT changed();
}

void MessageLog::markSeen() {
  if (m_unseen == 0) return;
  m_unseen = 0;
  Q_EMIT changed();
}

QString MessageLog::allText() const {
  QStringList lines;
  for (const Message& m : m_messages) {
    lines << m.time.toString(Qt::ISODate) + QLatin1Char(' ') + m.where + QStringLiteral(": ") + m.text;
  }
  return lines.join(QLatin1Char('\n'));
}

}  // namespace ps
