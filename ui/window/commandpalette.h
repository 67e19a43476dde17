// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QPointer>
#include <QtCore/QString>
#include <QtWidgets/QWidget>

#include <functional>
#include <vector>

class QLineEdit;
class QListWidget;

namespace ps {

class NothingFound;

/// One thing that Ctrl+K finds.
struct PaletteEntry {
  QString title;  ///< "Conductivity, liquid"
  QString where;  ///< "Material · Water", "File"
  QString keys;   ///< shortcut, or the value
  QString words;  ///< further words to find it by
  std::function<void()> run;
  bool replaces = false;  ///< puts another scene in the place of this one
  QString whyNot{};       ///< why it cannot be run now; "": it can
};

/// Entries that match every word of `query`, best first: titles that are it, titles that begin with it, then titles,
/// then other words.
/// What replaces the scene comes last unless its title begins with the query, and what cannot be run comes behind all.
std::vector<size_t> paletteMatches(const std::vector<PaletteEntry>& entries, const QString& query);

/// The search field over the window: type, arrows choose, Enter runs or jumps, Esc closes. What cannot be run is grey
/// and says why.
class CommandPalette : public QWidget {
  Q_OBJECT
 public:
  explicit CommandPalette(QWidget* parent);
  void open(std::vector<PaletteEntry> entries);
  int shownCount() const;
  QString currentTitle() const;
  QLineEdit* field() const { return m_field; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void refresh();
  void runCurrent();
  std::vector<PaletteEntry> m_entries;
  QLineEdit* m_field;
  QListWidget* m_list;
  NothingFound* m_nothing;
  QPointer<QWidget> m_before;
};

}  // namespace ps
