// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"

#include <QtCore/QObject>

namespace ps {

class Document;

/// Where the first of the scene's materials that there is any of changes phase at the air's pressure: marks in legends,
/// lines in graphs.
class Transitions : public QObject {
  Q_OBJECT
 public:
  explicit Transitions(Document& document, QObject* parent = nullptr);
  double melts() const { return m_melts; }  ///< K; NaN: it does not
  double boils() const { return m_boils; }  ///< K; NaN or infinite: it does not
  double meltsOr(double fallback) const;

 Q_SIGNALS:
  void changed();

 private:
  void onChanged(const ChangeEvent& event);
  void compute();
  Document& m_document;
  double m_melts, m_boils;
  size_t m_material = 0;  ///< of which they are, by its place in the project
};

}  // namespace ps
