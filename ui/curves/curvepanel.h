// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

class QComboBox;
class QLabel;
class QLineEdit;

namespace ps {

class CurveTarget;
class CurveView;
class Session;

/// The curve with its title above it, and the numbers of the selected point, to be typed, below.
class CurvePanel : public QWidget {
  Q_OBJECT
 public:
  CurvePanel(Session& session, CurveTarget& target, QWidget* parent = nullptr);
  CurveView* view() const { return m_view; }
  QLineEdit* temperatureField() const { return m_kelvin; }
  QLineEdit* valueField() const { return m_value; }
  QLineEdit* slopeField() const { return m_slope; }
  QString noteText() const;
  QComboBox* between() const { return m_between; }  ///< how all pieces go; the table has each by itself

 private:
  void layOut();
  void connectParts(Session& session);
  void showTitle();
  void note(const QString& text);  ///< below the curve
  void showPoint();
  void showOverlays();
  void showBetween();
  void chooseBetween(int index);
  void enter(QLineEdit* field);
  void enterSlope();
  CurveTarget& m_target;
  QLabel *m_title, *m_source, *m_which, *m_slopeLabel, *m_note;
  QComboBox* m_between;
  CurveView* m_view;
  QLineEdit *m_kelvin, *m_value, *m_slope;
};

}  // namespace ps
