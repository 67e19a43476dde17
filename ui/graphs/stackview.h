// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/graphs/timeplot.h"

#include <QtGui/QColor>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace ps {

/// Parts of a whole over time as stacked areas: those above 0 upwards, those below it downwards. A line beside them
/// may say what they should add up to.
class StackView : public TimePlot {
  Q_OBJECT
 public:
  struct Layer {
    QString name, letter;  ///< the letter tells it apart without its colour
  };
  StackView(std::vector<Layer> layers, const QString& unit, QWidget* parent = nullptr);
  ~StackView() override;
  void setLine(const QString& name);  ///< of the line; "": there is none

  /// One value for each layer, in the unit, and that of the line. Times ascend.
  void append(double time, std::span<const double> values, double line = 0);
  void clear() override;
  size_t sampleCount() const;

 protected:
  virtual QColor colourOf(size_t layer) const = 0;
  virtual bool isHatched(size_t) const { return false; }  ///< to be told from its neighbours without colours
  bool hasData() const override;
  double lastTime() const override;
  std::pair<double, double> valueExtent(size_t axis, double first, double last) const override;
  void paintData(QPainter& painter) override;
  void paintLabels(QPainter& painter) override;
  std::vector<PlotLine> readOut(double time) const override;
  std::vector<PlotLine> measure(double from, double to) const override;

 private:
  struct Private;
  QRectF paintTitle(QPainter& painter, double present) const;  ///< px, the line of the present; returns where it stands
  void paintLayers(QPainter& painter, const std::vector<size_t>& columns, bool above) const;
  std::unique_ptr<Private> d;
};

/// Mass in each phase over time, in grams; colours and letters of the phase map.
class PhaseStackView : public StackView {
  Q_OBJECT
 public:
  explicit PhaseStackView(QWidget* parent = nullptr);
  void append(double time, const std::array<double, 5>& kilograms);  ///< by api::Phase

 protected:
  QColor colourOf(size_t layer) const override;
  bool isHatched(size_t layer) const override;
};

/// What heat has come from where since the start, in J, and how much matter holds more: both are measured, and where
/// the balance is whole the line lies on what the areas add up to.
class EnergyStackView : public StackView {
  Q_OBJECT
 public:
  explicit EnergyStackView(QWidget* parent = nullptr);
  struct Parts {
    double walls = 0, air = 0, radiation = 0, heaters = 0, matter = 0;
  };
  void append(double time, const Parts& given, double held);

 protected:
  QColor colourOf(size_t layer) const override;
};

}  // namespace ps
