// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>

namespace ps {

class StatusLine;
class Toolbox;

/// Says in the status line why the handles that were taken have nothing to move, turn or scale, where something is
/// selected: a probe's box and a pin are not turned. What can be dragged only in part is told in the view alone.
class HandleNote : public QObject {
  Q_OBJECT
 public:
  HandleNote(Toolbox& tools, StatusLine& status);  ///< goes with the line

 private:
  void follow();
  Toolbox& m_tools;
  StatusLine& m_status;
  QString m_told;  ///< "": nothing
};

}  // namespace ps
