// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/particlefield.h"
#include "core/simulation/snapshot.h"
#include "ui/graphs/plot.h"
#include "ui/graphs/seriesunit.h"

#include <QtCore/QByteArray>

#include <vector>

namespace ps {

/// How a field is spread over the particles at the present time: how many have which value (a histogram), or its mean
/// with the lowest and highest along an axis of the scene (a profile).
class DistributionView : public Plot {
  Q_OBJECT
 public:
  static constexpr size_t kBins = 60;
  using Plot::Plot;
  /// Of a graph of one of these kinds, whose field a snapshot may have; what is held in place counts only as a body's.
  void show(const Snapshot& snapshot, const Graph& graph, const ParticleField* field);
  /// One row for each bin, in SI units.
  QByteArray csv() const;

 protected:
  bool hasData() const override { return !m_bins.empty(); }
  std::pair<double, double> fittedRange() const override;
  std::pair<double, double> valueExtent(size_t axis, double first, double last) const override;
  void paintData(QPainter& painter) override;
  void paintLabels(QPainter& painter) override { paintHeading(painter); }
  QString unitAlong() const override { return m_ofAlong.shown; }
  QString placeText(double at) const override;
  std::vector<PlotLine> readOut(double at) const override;
  std::vector<PlotLine> measure(double from, double to) const override;

 private:
  struct Bin {
    double count = 0, sum = 0, low = 0, high = 0;
    double mean() const { return sum / count; }
  };
  void fill(const std::vector<double>& along, const std::vector<double>& values);
  double edge(size_t bin) const { return m_low + (m_high - m_low) * static_cast<double>(bin) / double{kBins}; }
  const Bin* binAt(double at) const;
  bool m_profile = false;
  double m_low = 0, m_high = 1;  ///< ends of the bins, as people see them
  SeriesUnit m_ofAlong{""}, m_ofValues{""};
  std::string m_title, m_titleAlong;  ///< of columns
  std::vector<Bin> m_bins;
};

}  // namespace ps
