// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/graphs/timeplot.h"

#include <array>
#include <memory>

namespace ps {

/// Mass in each phase over time as stacked areas, in grams; colours and letters of the phase map.
class PhaseStackView : public TimePlot {
  Q_OBJECT
 public:
  explicit PhaseStackView(QWidget* parent = nullptr);
  ~PhaseStackView() override;

  /// Mass in kg by api::Phase. Times ascend.
  void append(double time, const std::array<double, 5>& kilograms);
  void clear();
  size_t sampleCount() const;

 protected:
  bool hasData() const override;
  double lastTime() const override;
  std::pair<double, double> valueExtent(double first, double last) const override;
  void paintData(QPainter& painter) override;
  void paintLabels(QPainter& painter) override;
  QStringList readOut(double time) const override;

 private:
  struct Private;
  std::unique_ptr<Private> d;
};

}  // namespace ps
