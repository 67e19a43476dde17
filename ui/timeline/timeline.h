// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

class QScrollArea;

namespace ps {

class KeyRows;
class Session;
class Transport;

/// The transport, and below it the keys of what is animated, where there are any.
class Timeline : public QWidget {
  Q_OBJECT
 public:
  explicit Timeline(Session& session, QWidget* parent = nullptr);

 Q_SIGNALS:
  void heightChanged(int pixels);

 private:
  void fit();
  KeyRows* m_keys;
  QScrollArea* m_scroll;
  Transport* m_transport;
};

}  // namespace ps
