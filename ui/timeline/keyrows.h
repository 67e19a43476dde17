// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "ui/document/changeevent.h"

#include <QtWidgets/QWidget>

#include <optional>
#include <vector>

namespace ps {

class Session;

/// The keys of the document over the scene's time: a ruler, on which a drag shows recorded frames, and a row for each
/// animated parameter. A key is chosen by a click and dragged to another frame (Shift: to any time; Ctrl: a copy of
/// it); a double-click sets one of the value that holds there; Delete takes it away. Each gesture is one undo step.
class KeyRows : public QWidget {
  Q_OBJECT
 public:
  static constexpr int kRuler = 18, kRow = 24, kLabel = 176;  ///< logical pixels

  explicit KeyRows(Session& session, QWidget* parent = nullptr);
  struct Chosen {
    Address address;
    size_t key = 0;
    bool operator==(const Chosen&) const = default;
  };
  const std::optional<Chosen>& chosen() const { return m_chosen; }
  int rowCount() const { return static_cast<int>(m_rows.size()); }
  int wantedHeight() const { return m_rows.empty() ? 0 : kRuler + kRow * rowCount(); }
  double xOf(double seconds) const;
  double secondsAt(double x) const;
  QPoint placeOf(const Address& address, size_t key) const;  ///< centre of its diamond

 Q_SIGNALS:
  void rowsChanged();
  void refused(const QString& problem);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  struct Row {
    Address address;
    QString title;
  };
  void onChanged(const ChangeEvent& event);
  void rebuild();
  std::optional<Chosen> keyUnder(const QPoint& at) const;
  const Row* rowAt(const QPoint& at) const;
  const std::vector<TrackKey>& keysOf(const Row& row) const;
  bool beginDrag(double time, const QPoint& at);
  double snapped(double seconds, bool free) const;
  void endDrag(bool keep);
  void removeChosen();
  QString tipAt(const QPoint& at) const;
  void paintRuler(QPainter& painter) const;
  void paintRow(QPainter& painter, const Row& row, int top) const;
  double span() const;  ///< s, from the left end to the right one

  Session& m_session;
  std::vector<Row> m_rows;
  std::optional<Chosen> m_chosen;
  struct Drag {
    double grip = 0;  ///< s from the key to where it was taken
    TrackKey from;
    bool moved = false, copies = false;
  };
  std::optional<Drag> m_drag;
  bool m_scrubs = false;
};

}  // namespace ps
