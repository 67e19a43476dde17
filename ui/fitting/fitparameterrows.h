// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/curvefit.h"

#include <QtWidgets/QWidget>

#include <vector>

class QLabel;
class QLineEdit;
class QVBoxLayout;

namespace ps {

class Document;

/// What may change, each with the range in which it is looked for. A parameter that has gone from the scene goes.
class FitParameterRows : public QWidget {
  Q_OBJECT
 public:
  explicit FitParameterRows(Document& document, QWidget* parent = nullptr);
  /// With the range of its slider; "" or why it cannot be looked for.
  QString add(const FitTarget& target);
  const std::vector<FitParameter>& parameters() const { return m_parameters; }
  /// "Hot plate temperature", "Viscosity of Honey, point 2".
  QString nameOf(const FitTarget& target) const;
  /// A number of it as people see it, with its unit.
  QString shown(const FitTarget& target, double number) const;

 Q_SIGNALS:
  void changed();

 private:
  /// What its index stood for, since keys that come and go shift it.
  struct Key {
    double time = 0;   ///< s
    size_t count = 0;  ///< of its track
  };
  Key keyOf(const FitTarget& target) const;
  bool followKey(size_t row);  ///< false: it is gone
  void follow();
  void rebuild();
  void readEnd(size_t row, bool most, QLineEdit* field);
  void showValues();
  Document& m_document;
  QVBoxLayout* m_column;
  std::vector<FitParameter> m_parameters;
  std::vector<Key> m_keys;       ///< of these; of those that are no keys nothing
  std::vector<QLabel*> m_names;  ///< of these, in their rows
};

}  // namespace ps
