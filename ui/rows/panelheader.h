// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>
#include <QtGui/QColor>
#include <QtWidgets/QWidget>

namespace ps {

/// Block on top of an inspector: a ball of the material's colour, name, what it is, where its data come from.
class PanelHeader : public QWidget {
  Q_OBJECT
 public:
  explicit PanelHeader(QWidget* parent = nullptr);
  void setTexts(const QString& name, const QString& subtitle, const QString& detail);
  void setDetail(const QString& detail) { setTexts(m_name, m_subtitle, detail); }
  void setSwatch(const QColor& colour);  ///< invalid: none
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString m_name, m_subtitle, m_detail;
  QColor m_swatch;
};

}  // namespace ps
