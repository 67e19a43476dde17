// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QLineEdit>

namespace ps {

/// A line edit with a funnel (or another icon) in front. Esc clears it.
class FilterField : public QLineEdit {
  Q_OBJECT
 public:
  explicit FilterField(QWidget* parent = nullptr, const QString& icon = QStringLiteral("filter"));

 protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QString m_icon;
};

}  // namespace ps
