// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/welcome/gallery.h"

#include <QtGui/QPixmap>
#include <QtWidgets/QAbstractButton>

class QAction;

namespace ps {

/// A button of the welcome page that paints itself: its ground follows the pointer, its ring the keyboard.
class PageButton : public QAbstractButton {
  Q_OBJECT
 public:
  explicit PageButton(QWidget* parent = nullptr);

 protected:
  bool event(QEvent* event) override;
  /// The ground that its state asks for; invalid: none.
  QColor ground() const;
};

/// A sample: picture, title and one line. Its tooltip says what to try.
class Card : public PageButton {
  Q_OBJECT
 public:
  explicit Card(Sample sample, QWidget* parent = nullptr);
  const Sample& sample() const { return m_sample; }
  void setBadge(const QString& text);  ///< over the picture: "Start here"
  QSize sizeHint() const override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  static int heightFor(int width, int lines);
  int linesIn(int width) const;  ///< that its summary takes in a card of this width
  void setLines(int lines);      ///< that there are for it
  int lines() const { return m_lines; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Sample m_sample;
  int m_lines = 1;
  QString m_badge;
  QPixmap m_scaled;  ///< the picture at the size and scale at which it was painted last
};

/// A project that was open lately: a small picture, its name, where it lies and of when it is, and what it says to try.
class RecentRow : public PageButton {
  Q_OBJECT
 public:
  explicit RecentRow(RecentProject project, QWidget* parent = nullptr);
  QSize sizeHint() const override { return {260, m_project.toTry.isEmpty() ? 50 : 68}; }
  const RecentProject& project() const { return m_project; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  RecentProject m_project;
  QString m_where;  ///< folder and day
};

/// An action of the window as an entry of the page's list: icon, name, key.
class NavigationButton : public PageButton {
  Q_OBJECT
 public:
  NavigationButton(const QString& icon, const QString& text, QAction* action, QWidget* parent = nullptr);
  void setCurrent(bool on);  ///< what it leads to is what is shown
  QSize sizeHint() const override { return {180, 34}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString m_icon, m_keys;
  bool m_current = false;
};

}  // namespace ps
