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

/// Block on top of an inspector: a swatch of the material, name, and as captions below it what it is and where its data
/// come from. A caption that has no room to stand whole is left out; the tip has it.
class PanelHeader : public QWidget {
  Q_OBJECT
 public:
  explicit PanelHeader(QWidget* parent = nullptr);
  void setTexts(const QString& name, const QString& subtitle, const QString& detail);
  void setDetail(const QString& detail) { setTexts(m_name, m_subtitle, detail); }
  void setSwatch(SwatchPainter painter);  ///< nullptr: none
  QSize sizeHint() const override;
  int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Captions {
    QString subtitle, detail;  ///< "": left out
  };
  Captions captionsIn(int width) const;
  QString m_name, m_subtitle, m_detail;
  SwatchPainter m_swatch;
};

}  // namespace ps
