// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/autosave.h"
#include "ui/window/noticebar.h"

#include <QtCore/QObject>
#include <QtCore/QStringList>

#include <memory>
#include <vector>

namespace ps {

class Notices;
class Session;

/// Nothing is lost: what earlier sessions left behind is offered, one after another, and work that another project took
/// the place of can be brought back.
class RestoreOffer : public QObject {
  Q_OBJECT
 public:
  /// `old`: whether this window has to do with what earlier sessions left at all.
  RestoreOffer(Session& session, Notices& notices, bool old, QObject* parent = nullptr);
  /// Opens the scene that was open when the last session was closed. False: there is none.
  bool reopenLast();
  bool anyUnsaved() const { return !unsavedWork().empty(); }
  /// Once the first project is there. What earlier sessions had saved needs no note any more.
  void offerAtStart();
  /// Offers all unsaved work that waits, one after another.
  void offer();
  /// The way back to work whose place another project took. It is in memory: it leads there even where no copy could
  /// be written.
  void showReplaced(const QString& text);
  /// What is offered now; without a title nothing is.
  struct Offer {
    QString title, text;
    std::vector<NoticeBar::Button> buttons;
  };
  const Offer& present() const { return m_present; }

 Q_SIGNALS:
  void offerChanged();

 private:
  std::vector<AutosavedSession> unsavedWork() const;
  void offerNext();  ///< of m_offered

  Session& m_session;
  Notices& m_notices;
  bool m_old;
  std::shared_ptr<const ReplacedWork> m_replaced;
  Offer m_present;
  QStringList m_offered;  ///< stems of unsaved work that is still to be decided about
};

}  // namespace ps
