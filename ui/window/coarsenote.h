// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"

#include <QtCore/QObject>
#include <QtCore/QString>

namespace ps {

class StatusLine;
class Toolbox;

/// Says in the status line that particles are too large for what has just been drawn: once in each scene, and again
/// where they stand otherwise.
class CoarseNote : public QObject {
  Q_OBJECT
 public:
  CoarseNote(Toolbox& tools, StatusLine& status, QObject* parent);
  /// Of the row that a note of the status line leads to: that of the spacing where it is this one, else `address`.
  QString leadsTo(const QString& address) const;

 private:
  void onChanged(const ChangeEvent& event);
  Toolbox& m_tools;
  StatusLine& m_status;
  QString m_told;  ///< "": nothing yet
};

}  // namespace ps
