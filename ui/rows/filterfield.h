// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QLabel>
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

/// What is said where a search leaves nothing, rich text; its link clears what was typed.
QString nothingCalled(const QString& wanted);

/// Stands in the place of a list in which a search has found nothing.
class NothingFound : public QLabel {
  Q_OBJECT
 public:
  explicit NothingFound(QLineEdit& search);
  void standFor(QWidget& list, bool any);  ///< `any`: something is left in the list, which shows then

 private:
  QLineEdit& m_search;
};

}  // namespace ps
