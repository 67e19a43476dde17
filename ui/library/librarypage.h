// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/library/materiallibrary.h"

#include <QtWidgets/QWidget>

#include <array>

class QButtonGroup;
class QLabel;
class QLineEdit;
class QListWidget;
class QMimeData;
class QPushButton;
class QTreeWidget;

namespace ps {

class Flow;
class NothingFound;
class PhaseView;
class Selection;
class SwatchView;

/// All materials that can be had: cards to search in, with a swatch and the phases over temperature at a glance, and
/// picture and properties of one, or of two side by side (Ctrl+click). From here they come into the scene; the scene's
/// own become presets.
class LibraryPage : public QWidget {
  Q_OBJECT
 public:
  LibraryPage(MaterialLibrary& library, Session& session, Selection& selection, QWidget* parent = nullptr);
  QStringList shown() const;     ///< labels of the cards that search and tag leave
  QStringList compared() const;  ///< labels of the one or two whose properties are listed
  QListWidget* cards() const { return m_cards; }
  QTreeWidget* table() const { return m_table; }
  void setTag(const QString& tag);  ///< "": all
  void choose(const QString& label, bool beside = false);
  void beginSearch(bool anew);  ///< takes the keys; `anew`: without the words of the last one
  void refresh();               ///< cards and table anew, in the unit that people prefer

 Q_SIGNALS:
  void closeRequested();
  void carrying();     ///< a card is dragged, onto a body perhaps, which has to be seen
  void broughtBack();  ///< and was let go where nothing takes it
  void importWanted();
  void mixWanted(const QString& first, const QString& second);  ///< keys; "" for any
  void mixtureWanted(const std::string& material);              ///< of the scene, whose share is to change
  void exportWanted(const ps::LibraryEntry& entry);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  QWidget* makeLeft();
  QWidget* makeRight();
  void connectChosen();  ///< what acts on the chosen cards, and on the scene's material
  void filter();
  void showChosen();
  void showTags();
  void showScene();
  void addToScene();
  void carry(QMimeData* carried);
  std::vector<const LibraryEntry*> chosen() const;
  MaterialLibrary& m_library;
  Session& m_session;
  Selection& m_selection;
  QLineEdit *m_search, *m_name, *m_words;
  NothingFound* m_nothing;
  QString m_wordsOf;  ///< whose tags the line has, by the key of its card
  Flow* m_chips = nullptr;
  QButtonGroup* m_tags = nullptr;
  QListWidget* m_cards;
  QTreeWidget* m_table;
  QLabel *m_title, *m_about, *m_of, *m_hint;
  QPushButton *m_add, *m_export, *m_remove, *m_save, *m_mixture;
  QString m_tag;
  PhaseView* m_phases;
  std::array<SwatchView*, 2> m_pictures{};  ///< of the chosen ones
};

}  // namespace ps
