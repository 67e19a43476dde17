// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>
#include <QtWidgets/QWidget>

namespace ps {

/// Heading of a group of rows: hairline, arrow, title, count. A click or Enter folds the group.
class GroupHeading : public QWidget {
  Q_OBJECT
 public:
  explicit GroupHeading(const QString& title, QWidget* parent = nullptr);
  QString title() const { return m_title; }
  void setCount(const QString& count);  ///< "8", "3 of 8", "3 pinned"
  const QString& count() const { return m_count; }
  bool isFolded() const { return m_folded; }
  void setFolded(bool folded);
  QSize sizeHint() const override { return {200, kHeight}; }

  static constexpr int kHeight = 28;

 Q_SIGNALS:
  void foldedChanged(bool folded);  ///< by the user

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void toggle();
  QString m_title, m_count;
  bool m_folded = false, m_hover = false;
};

}  // namespace ps
