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

/// What is said where a search leaves nothing, rich text; its link clears what was typed. `among`: what else was left
/// out, by the name of what was not; "": nothing.
QString nothingCalled(const QString& wanted, const QString& among = {});

/// Stands in the place of a list in which a search has found nothing.
class NothingFound : public QLabel {
  Q_OBJECT
 public:
  explicit NothingFound(QLineEdit& search);
  /// `any`: something is left in the list, which shows then. `among`: see nothingCalled().
  void standFor(QWidget& list, bool any, const QString& among = {});

 private:
  QLineEdit& m_search;
};

}  // namespace ps
