// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/export/recordedframes.h"

#include <QtWidgets/QDialog>

class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace ps {

class Session;

/// Asks what of the recorded run is to be written, and where: rows of its own kind, then from when to when, which
/// frames, the place, and what will come of it in words.
class RunDialog : public QDialog {
  Q_OBJECT
 public:
  /// `window`: the dialog's parent.
  RunDialog(Session& session, const QString& title, QWidget* window);

  /// As if somebody had chosen it.
  void setPlace(const QString& place);

 protected:
  QComboBox* addChoice(const QString& label, const QString& tip);
  /// Those that all have, below one's own.
  void addRange();
  FrameRange range() const;  ///< of frames by their numbers
  size_t frames() const;     ///< that are kept in it
  double framesPerSecond() const;
  const QString& place() const { return m_place; }
  void refresh();
  /// Where the files go unless somebody chooses: beside the project where it has a file of its own.
  QString besideProject(const QString& ending) const;

  virtual QString suggestedPlace() const = 0;
  virtual QString choosePlace() = 0;  ///< "" where it was given up
  virtual QString summary() const = 0;
  virtual bool isPossible() const { return true; }
  virtual void begin() = 0;

  Session& session() const { return m_session; }

  /// "25 frames written to …."
  static QString writtenText(size_t frames, const QString& where);

 private:
  QLineEdit* addTime(const QString& label, const QString& tip, double seconds);

  Session& m_session;
  QGridLayout* m_grid;
  QLineEdit *m_from = nullptr, *m_to = nullptr;
  QComboBox* m_every = nullptr;
  QPushButton *m_where = nullptr, *m_begin = nullptr;
  QLabel* m_summary = nullptr;
  QString m_place;
  bool m_chosen = false;  ///< the place, by hand
};

}  // namespace ps
