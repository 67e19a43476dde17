// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/graphs/plot.h"

#include <limits>

namespace ps {

/// A plot over the scene's time, in s, with the line of the present time.
class TimePlot : public Plot {
  Q_OBJECT
 public:
  using Plot::Plot;
  /// The axis shows at least [0, seconds] while it is fitted; longer data extend it.
  void setDuration(double seconds);
  /// Line of the present time; NaN hides it.
  void setPresentTime(double seconds);
  double presentTime() const { return m_present; }
  /// Where labels say what a curve is: at the present time, or where it ends before that.
  double labelTime(double last) const { return m_present < last ? m_present : last; }
  /// Thin lines with names: times in s.
  void setMarkers(std::vector<std::pair<double, QString>> markers);
  const std::vector<std::pair<double, QString>>& markers() const { return m_markers; }
  virtual void clear() = 0;  ///< removes all samples

 Q_SIGNALS:
  void seekRequested(double seconds);  ///< clicked

 protected:
  virtual double lastTime() const = 0;  ///< s, of the data
  std::pair<double, double> fittedRange() const override;
  QString unitAlong() const override { return QStringLiteral("s"); }
  QString placeText(double at) const override;
  double summaryPlace() const override { return lastTime(); }
  void clicked(double at) override { Q_EMIT seekRequested(at); }
  void paintBehind(QPainter& painter) override;
  /// Names of the markers, lowest where nothing else is written: `taken`. One that has no such place is left out; the
  /// timeline has them all.
  void paintMarkerNames(QPainter& painter, std::vector<QRectF> taken) const;

 private:
  QRectF markerPlace(double time, double width, const std::vector<QRectF>& taken) const;  ///< empty: there is none
  std::vector<std::pair<double, QString>> m_markers;
  double m_duration = 0, m_present = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace ps
