// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

#include <string>
#include <vector>

class QButtonGroup;
class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace ps {

class CurveTarget;

/// The points of the response as a table, and the named laws: a law that is chosen is fitted to what there is. The
/// numbers of a law are typed below it.
class PointsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit PointsPanel(CurveTarget& target, QWidget* parent = nullptr);
  QTableWidget* table() const { return m_table; }
  /// Of "points", "constant" or a law's name.
  void chooseKind(const std::string& kind);
  void fitNearest();  ///< the law that is nearest to the points
  void sample();      ///< points of the law, or of the constant
  void paste();       ///< a table of two columns from the clipboard instead of all points
  void thinOut();     ///< fewest points within toleranceField()
  QLineEdit* toleranceField() const { return m_tolerance; }
  QString noteText() const;
  void addPoint();  ///< in the middle of the gap behind the selected point

 private:
  void connectParts();
  void makeLaws();
  QGridLayout* kindRows();
  void refresh();
  void showKind();
  void showCoefficients();
  void showSelected();
  void enterCell(int row, int column);
  void showWays(int row, int column);
  void enterCoefficient(size_t index);
  void removePoint();
  void note(const QString& text);
  CurveTarget& m_target;
  QTableWidget* m_table;
  QButtonGroup* m_kinds;
  QPushButton *m_add, *m_remove, *m_paste, *m_thin, *m_fit, *m_sample;
  QLineEdit* m_tolerance;
  QWidget* m_laws;  ///< all that keys over time do not have
  QLabel *m_help, *m_note;
  std::vector<QLineEdit*> m_coefficients;
};

}  // namespace ps
