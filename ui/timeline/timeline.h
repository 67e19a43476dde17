// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/timeline/transport.h"

#include <QtWidgets/QWidget>

#include <utility>
#include <vector>

class QScrollArea;

namespace ps {

class KeyRows;
class MarkerRow;
class Session;

/// The transport, and below it markers and the keys of what is animated, where there are any and it is not slim.
class Timeline : public QWidget {
  Q_OBJECT
 public:
  explicit Timeline(Session& session, PointedBy by = PointedBy::Mouse, QWidget* parent = nullptr);
  /// What keys and buttons do here: {"Drag", "Show any recorded time"}.
  static std::vector<std::pair<QString, QString>> gestures();

  void setSlim(bool slim);  ///< the ruler alone, without the rows of keys

 Q_SIGNALS:
  void heightChanged(int pixels);

 private:
  void fit();
  KeyRows* m_keys;
  MarkerRow* m_markers;
  QScrollArea* m_scroll;
  Transport* m_transport;
};

}  // namespace ps
