// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QHash>
#include <QtWidgets/QDockWidget>
#include <QtWidgets/QWidget>

class QHBoxLayout;
class QStackedWidget;
class QTabBar;
class QToolButton;

namespace ps {

/// Property of a button in a dock's header: title of the page that it is for; none: it is for all.
inline constexpr const char* kForPage = "forPage";

/// A dock with a header of its own: tabs on the left, actions on the right, 28 pixels high.
class Dock : public QDockWidget {
  Q_OBJECT
 public:
  Dock(const QString& name, const QString& title, QWidget* parent);
  /// The first page gives a plain title until there is a second.
  int addPage(const QString& title, QWidget* page);
  bool hasPage(const QString& title) const { return indexOf(title) >= 0; }
  QWidget* takePage(const QString& title);  ///< for another dock; nullptr: there is none of this title
  void choosePage(const QString& title);    ///< shown or not
  void showPage(const QString& title);
  QString currentPage() const;
  QWidget* page(const QString& title) const { return m_pageOf.value(title); }  ///< nullptr: there is none
  /// What F6 goes to: of the page that is shown what had the focus last, or its first widget that takes keys, else the
  /// tabs; nullptr where there is neither.
  QWidget* firstStop() const;
  void setPageTitle(const QString& title, const QString& shown);
  void movePage(const QString& title, int place);  ///< its tab; -1: behind the others
  /// In the header, for as long as `page` is shown; "": with all pages.
  QToolButton* addAction(const QString& icon, const QString& tip, const QString& page = {});

 Q_SIGNALS:
  void pageChanged(const QString& title);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  int indexOf(const QString& title) const;  ///< -1: there is none
  QWidget* m_header;
  QHBoxLayout* m_actions;
  QTabBar* m_tabs;
  QStackedWidget* m_pages;
  QHash<QString, QWidget*> m_pageOf;  ///< by title
};

/// Of a dock, and of what stands in the middle: the window's ground shows at its corners.
void roundCorners(QWidget& panel);

}  // namespace ps
