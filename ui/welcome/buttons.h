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

/// A sample: picture, title, one line and what to try, which its tooltip says whole where the card has no room for it.
class Card : public PageButton {
  Q_OBJECT
 public:
  explicit Card(Sample sample, QWidget* parent = nullptr);
  const Sample& sample() const { return m_sample; }
  void setBadge(const QString& text);  ///< over the picture: "Start here"
  QSize sizeHint() const override;
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  /// Lines of the words below the title.
  struct Lines {
    int summary = 1, toTry = 0;
  };
  static int heightFor(int width, const Lines& lines);
  int linesIn(int width) const;       ///< that its summary takes in a card of this width
  Lines wanted(int width) const;      ///< of both, at most four of what to try
  void setLines(const Lines& lines);  ///< that there are for them
  int lines() const { return m_lines.summary; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintWords(QPainter& painter, double top) const;
  Sample m_sample;
  Lines m_lines;
  QString m_badge;
  QPixmap m_scaled;  ///< the picture at the size and scale at which it was painted last
};

/// A project that was open lately: a small picture, its name, where it lies and of when it is, and what it says to try;
/// or that it is not found.
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
