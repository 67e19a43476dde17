// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

#include <vector>

class QLabel;

namespace ps {

class CurveTarget;
class GroupHeading;
class Session;

/// What can be said of a curve as it is: how it goes, whether it is usual, what matter and solver make of it.
struct CurveCheck {
  enum class Kind { Fine, News, Warning };
  Kind kind = Kind::Fine;
  QString text;  ///< a sentence
};

/// Goes through all particles of the material.
std::vector<CurveCheck> checksOf(const CurveTarget& target);

/// The checks of the curve that is edited, below its points; they follow it and the running scene.
class CurveChecks : public QWidget {
  Q_OBJECT
 public:
  CurveChecks(Session& session, CurveTarget& target, QWidget* parent = nullptr);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void refresh();
  struct Row {
    QWidget* box;
    QLabel *sign, *text;
  };
  CurveTarget& m_target;
  GroupHeading* m_heading;
  std::vector<Row> m_rows;
};

}  // namespace ps
