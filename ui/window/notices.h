// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/messagelog.h"

#include <QtCore/QObject>

#include <string>

#include <cstdint>
#include <optional>

namespace ps {

class Actions;
class NoticeBar;
class Session;
struct Address;
struct EngineEvent;
struct FailureText;

/// What the engine and refused edits have to say, as notices over the view and in the log.
class Notices : public QObject {
  Q_OBJECT
 public:
  Notices(Session& session, NoticeBar& bar, const Actions& actions, QObject* parent = nullptr);
  NoticeBar& bar() const { return m_bar; }
  /// With "" for `why` the last one goes.
  void refuse(const QString& title, const QString& why);
  /// Of what a tool was to do: goes with toolChanged(), before which it holds.
  void refuseTool(const QString& title, const QString& why);
  void toolChanged();
  /// Goes with the next edit, after which it may hold no longer.
  void refuseUntilEdited(const QString& title, const QString& why);
  /// Into the log, and over the view where it is a warning or worse.
  void message(MessageLevel level, const QString& where, const QString& text);
  /// The scene that is being made is given up, which is said at once: what is at work ends a little later. False where
  /// none has been told of.
  bool cancelMaking();

 Q_SIGNALS:
  void rowWanted(const ps::Address& address);  ///< "Show it"

 private:
  void onEvent(const EngineEvent& event);
  void showFailure(const EngineEvent& event);
  void showLate(const std::string& plugin);
  void showRemark(const FailureText& remark);
  void showBroken(const EngineEvent& event);  ///< the scene could not be built
  void showMaking(const QString& stage, double done, double left);
  void showCancelled();
  Session& m_session;
  NoticeBar& m_bar;
  const Actions& m_actions;
  std::optional<uint64_t> m_refusedAt;  ///< Document::changeCount() at the refusal that goes with an edit
  int m_refusals = 0;                   ///< of the topic that refuse() has
  int m_toolRefusal = -1;               ///< the number of that which goes with toolChanged()
  bool m_tellsMaking = false;           ///< the scene that is being made has been told of
  bool m_givesUpMaking = false;         ///< and somebody has given it up
};

}  // namespace ps
