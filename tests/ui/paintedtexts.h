// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QList>
#include <QtCore/QString>
#include <QtGui/QPaintDevice>
#include <QtGui/QPaintEngine>
#include <QtGui/QPainter>
#include <QtWidgets/QWidget>

// What is painted, read back as text.
namespace ps {

struct PaintedText {
  QString text;
  QPointF at;    ///< where it begins, in the widget
  QRectF place;  ///< of all of it
};

/// Takes the texts that are painted, and nothing else.
class TextReader : public QPaintEngine {
 public:
  explicit TextReader(QList<PaintedText>& texts) : QPaintEngine(AllFeatures), m_texts(texts) {}
  bool begin(QPaintDevice*) override { return true; }
  bool end() override { return true; }
  void updateState(const QPaintEngineState& now) override { m_transform = now.transform(); }
  void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override {}
  void drawPath(const QPainterPath&) override {}
  void drawPolygon(const QPointF*, int, PolygonDrawMode) override {}
  void drawTextItem(const QPointF& at, const QTextItem& item) override {
    const QRectF place(at.x(), at.y() - item.ascent(), item.width(), item.ascent() + item.descent());
    m_texts << PaintedText{item.text(), m_transform.map(at), m_transform.mapRect(place)};
  }
  Type type() const override { return User; }

 private:
  QList<PaintedText>& m_texts;
  QTransform m_transform;
};

class TextDevice : public QPaintDevice {
 public:
  explicit TextDevice(const QSize& size) : m_size(size) {}
  QPaintEngine* paintEngine() const override { return &m_reader; }
  QList<PaintedText> texts;

 protected:
  int metric(PaintDeviceMetric metric) const override {
    switch (metric) {
      case PdmWidth:
        return m_size.width();
      case PdmHeight:
        return m_size.height();
      case PdmDepth:
        return 32;
      case PdmDevicePixelRatio:
        return 1;
      case PdmDevicePixelRatioScaled:
        return static_cast<int>(devicePixelRatioFScale());
      default:
        return 96;
    }
  }

 private:
  QSize m_size;
  mutable TextReader m_reader{texts};
};

inline QList<PaintedText> paintedBy(QWidget& widget) {
  TextDevice device(widget.size());
  widget.render(&device, {}, {}, {});
  return device.texts;
}

}  // namespace ps
