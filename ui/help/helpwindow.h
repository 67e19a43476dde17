// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/help/helppages.h"

#include <QtWidgets/QDialog>

#include <functional>
#include <optional>

class QTextBrowser;
class QToolButton;

namespace ps {

/// Pages of help beside the work. It fetches nothing from anywhere: pages come from whoever made it.
class HelpWindow : public QDialog {
  Q_OBJECT
 public:
  /// The page of an id; nothing where there is none.
  using Library = std::function<std::optional<HelpPage>(const QString& id)>;
  HelpWindow(Library library, QWidget* parent);
  void open(const QString& id);  ///< of a page, or of a section of one: "sketching#fill"
  void refresh();                ///< asks for the page again
  QString current() const;       ///< id of the page that is shown, without its section; "" before the first
  QString text() const;          ///< of it, as read

 Q_SIGNALS:
  void actionWanted(const QString& name);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void go(int place);
  void showPage(const HelpPage& page, const QString& section);
  Library m_library;
  QTextBrowser* m_text;
  QToolButton *m_back, *m_forward;
  QStringList m_way;  ///< ids that were shown
  int m_place = -1;   ///< in them
};

}  // namespace ps
