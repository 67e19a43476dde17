// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>
#include <QtWidgets/QWidget>

#include <functional>

class QPainter;
class QRectF;

namespace ps {

/// Draws how a material looks into a square.
using SwatchPainter = std::function<void(QPainter&, const QRectF&)>;

/// Block on top of an inspector: a swatch of the material, name, what it is, where its data come from.
class PanelHeader : public QWidget {
  Q_OBJECT
 public:
  explicit PanelHeader(QWidget* parent = nullptr);
  void setTexts(const QString& name, const QString& subtitle, const QString& detail);
  void setDetail(const QString& detail) { setTexts(m_name, m_subtitle, detail); }
  void setSwatch(SwatchPainter painter);  ///< nullptr: none
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString m_name, m_subtitle, m_detail;
  SwatchPainter m_swatch;
};

}  // namespace ps
