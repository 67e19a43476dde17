// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>
#include <QtWidgets/QWidget>

#include <map>

class QLabel;
class QStackedWidget;

namespace ps {

/// A panel in the headset that bears pages of the window: their title over them, by which a hand takes it, and what was
/// refused below. One that others are set beside bears all that have no panel of their own.
class VrBoard : public QWidget {
  Q_OBJECT
 public:
  enum class Bears { All, OneBeside };
  explicit VrBoard(Bears bears);

  void add(QWidget& page, const QString& title);  ///< takes it from wherever it was
  void showPage(QWidget& page);
  bool bears(const QWidget& page) const;
  QWidget* page() const;           ///< nullptr: there is none yet
  QString title() const;           ///< of that; "": none
  double header() const;           ///< share of its height, from its upper edge
  void note(const QString& text);  ///< "": nothing any more

 Q_SIGNALS:
  void besideWanted();  ///< its page shall have a panel of its own
  void closed();

 private:
  QLabel *m_title, *m_note;
  QStackedWidget* m_pages;
  std::map<const QWidget*, QString> m_titles;
};

}  // namespace ps
