// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/mixing.h"
#include "ui/library/materiallibrary.h"

#include <QtCore/QTimer>
#include <QtWidgets/QDialog>

#include <string>
#include <vector>

class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;

namespace ps {

class MixPreview;
class ParameterRow;
class Selection;

/// Makes a material of two, or changes the share of one that was mixed: which two, how much of the second, what each
/// property comes to and by which rule, and how it melts and boils beside its parts. It becomes a material of the scene
/// or a preset; what makes no mixture is said, and nothing can then be made. The window stays in use meanwhile: what
/// can be mixed follows library and scene, and it closes where another project is opened or its material is gone.
class MixDialog : public QDialog {
  Q_OBJECT
 public:
  /// `first`, `second`: keys of the library's entries that are chosen to begin with; "" for any.
  MixDialog(MaterialLibrary& library, Session& session, Selection& selection, const QString& first,
            const QString& second, QWidget* parent = nullptr);
  /// Of a mixture of the scene, which keeps its parts.
  MixDialog(MaterialLibrary& library, Session& session, Selection& selection, const std::string& material,
            QWidget* parent = nullptr);
  ParameterRow* share() const { return m_share; }
  QTreeWidget* table() const { return m_table; }
  MixPreview* preview() const { return m_preview; }
  QString problem() const { return m_problem; }  ///< "" or why there is no such mixture
  /// By the keys of the library's entries, or "scene:" and the id of a material of the scene; false: there are none.
  bool chooseParts(const QString& first, const QString& second);

 private:
  MixDialog(MaterialLibrary& library, Session& session, Selection& selection, QWidget* parent);
  struct Source {
    QString label;
    Mixture::Part part;
    QString key{};  ///< see chooseParts()
    bool operator==(const Source& other) const;
  };
  void addSources();
  void readSources();
  bool isGone() const;                    ///< the mixture that is to be changed
  int indexOf(const QString& key) const;  ///< among the sources; -1: there is none
  const Source& chosen(const QComboBox& box) const;
  void addRow(const QString& label, QWidget* field);
  void addShare(double share);
  void addResult();
  void addButtons();
  void refresh();
  void fillTable(const Material& first, const Material& second, const Material& mixture);
  Mixture mixture() const;
  QString name() const;
  SceneMaterial made() const;
  void addToScene();
  void keepAsPreset();
  void change();
  MaterialLibrary& m_library;
  Session& m_session;
  Selection& m_selection;
  std::string m_changed;  ///< of the scene, whose share it is; "": a new one
  std::vector<Source> m_sources;
  QTimer m_late;  ///< many edits are followed once
  QGridLayout* m_grid;
  QComboBox *m_first, *m_second;
  ParameterRow* m_share = nullptr;
  QLineEdit* m_name = nullptr;
  QLabel* m_note;
  MixPreview* m_preview;
  QTreeWidget* m_table;
  std::vector<QPushButton*> m_makes;  ///< what makes it, where there is one
  QString m_problem;
};

}  // namespace ps
