// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

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

 private:
  void showTitle();
  void showPoint();
  void showOverlays();
  void enter(QLineEdit* field);
  CurveTarget& m_target;
  QLabel *m_title, *m_source, *m_which, *m_note;
  CurveView* m_view;
  QLineEdit *m_kelvin, *m_value;
};

}  // namespace ps
