// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/export/recordedframes.h"

#include <QtWidgets/QDialog>

#include <optional>

class QComboBox;
class QGridLayout;
class QHBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace ps {

class Session;

/// Asks what of the recorded run is to be written, and where: rows of its own kind, then from when to when, which
/// frames, the place, and what will come of it in words. In a dialog, or as a page of a dock, where projects come and
/// go; it stays open while a run goes on. For as long as nobody types a range it is all that has been recorded by then.
class RunForm : public QWidget {
  Q_OBJECT
 public:
  explicit RunForm(Session& session);

  /// As if somebody had chosen it.
  void setPlace(const QString& place);
  QHBoxLayout& buttons() const { return *m_buttons; }
  QPushButton& exportButton() const { return *m_begin; }
  Session& session() const { return m_session; }

 Q_SIGNALS:
  void begun();  ///< what was asked for is being done

 protected:
  void resizeEvent(QResizeEvent* event) override;
  QComboBox* addChoice(const QString& label, const QString& tip);
  /// Those that all have, below one's own.
  void addRange();
  FrameRange range() const;  ///< of frames by their numbers
  size_t frames() const;     ///< that are kept in it
  double framesPerSecond() const;
  /// "Only 0 to 4 s are recorded." where more was typed; "" elsewhere.
  QString limits() const;
  const QString& place() const { return m_place; }
  void refresh();
  /// Where the files go unless somebody chooses: beside the project where it has a file of its own.
  QString besideProject(const QString& ending) const;

  virtual QString suggestedPlace() const = 0;
  virtual QString choosePlace() = 0;  ///< "" where it was given up
  virtual QString summary() const = 0;
  /// Of the files in the folder that the place is, "frame-*.png"; "": the place is a file.
  virtual QString fileNames() const = 0;
  virtual bool isPossible() const { return true; }
  virtual void begin() = 0;

  bool replaces() const { return m_replaces; }  ///< files that were at the place when it was last looked at

  /// "25 frames written to …."
  static QString writtenText(size_t frames, const QString& where);

 private:
  QLineEdit* addTime(const QString& label, const QString& tip);
  void addRates();
  void followRun();
  void showAll();  ///< as the range
  /// What a field was filled in with.
  struct ShownTime {
    QString text;
    double seconds = 0;
  };
  static std::optional<double> timeIn(const QLineEdit& field, const ShownTime& shown);  ///< s; nothing: no number
  void showPlace();
  void lookAtPlace();

  Session& m_session;
  QGridLayout* m_grid;
  QHBoxLayout* m_buttons;
  QLineEdit *m_from = nullptr, *m_to = nullptr;
  QComboBox* m_every = nullptr;
  QPushButton *m_where, *m_begin;
  QLabel* m_summary = nullptr;
  QString m_place;
  bool m_chosen = false;  ///< the place, by hand
  bool m_rangeTyped = false;
  QString m_looked;  ///< place and names that m_replaces is of: disks may be slow
  bool m_replaces = false;
  ShownTime m_shownFrom, m_shownTo;
  double m_shownLength = 0;  ///< s of a frame, by which rates are told
};

/// A form to be answered or given up; the window stays in use meanwhile. It goes with the project.
class RunDialog : public QDialog {
  Q_OBJECT
 public:
  /// `window`: the dialog's parent.
  RunDialog(RunForm* form, const QString& title, QWidget* window);
};

}  // namespace ps
