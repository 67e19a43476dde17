// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "ui/document/changeevent.h"

#include <QtWidgets/QWidget>

#include <optional>
#include <vector>

class QMenu;

namespace ps {

class Session;

/// The keys of the document over the scene's time: a ruler, on which a drag shows recorded frames, and a row for each
/// animated parameter, where there are any. Keys are chosen by a click, Shift adds one, or by a box that is drawn
/// around them, and dragged to other frames together (Shift: to any time; Ctrl: copies of them); Escape takes a drag
/// back. A double-click sets a key of the value that holds there, at a tenth of a second (Ctrl: at a frame, Shift: at
/// any time), on a name it opens the keys as a curve; Delete takes chosen ones away. Each gesture is one undo step.
class KeyRows : public QWidget {
  Q_OBJECT
 public:
  static constexpr int kRuler = 18, kRow = 24, kLabel = 176,
                       kEnd = 16;  ///< logical pixels; the last: right of the last second

  /// `least`: logical pixels that the ruler and each row are high at least, where hands point at them.
  explicit KeyRows(Session& session, int least = 0, QWidget* parent = nullptr);
  struct Chosen {
    Address address;
    size_t key = 0;
    bool operator==(const Chosen&) const = default;
  };
  std::vector<Chosen> chosen() const;
  int rowCount() const { return static_cast<int>(m_rows.size()); }
  int ruler() const { return m_ruler; }  ///< logical pixels that it is high
  int rowHeight() const { return m_row; }
  int wantedHeight() const { return m_ruler + (m_rowsShown ? m_row * rowCount() : 0); }
  void setRowsShown(bool shown);  ///< else the ruler alone
  double xOf(double seconds) const;
  double secondsAt(double x) const;
  QPoint placeOf(const Address& address, size_t key) const;  ///< centre of its diamond

 Q_SIGNALS:
  void rowsChanged();
  void refused(const QString& title, const QString& why);  ///< "The keys stay as they are.", why
  void hint(const QString& sentence);                      ///< what a click does where it did nothing
  void curveWanted(const ps::Address& address);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  struct Row {
    Address address;
    QString title;
  };
  void onChanged(const ChangeEvent& event);
  void rebuild();
  void fit();
  static constexpr double kGrip = 8;  ///< px around the middle of a key, of a mouse
  std::optional<Chosen> keyUnder(const QPoint& at, double reach = kGrip) const;
  const Row* rowAt(const QPoint& at) const;
  const std::vector<TrackKey>& keysOf(const Address& address) const;
  double snapped(double seconds, bool free) const;
  bool isChosen(const Chosen& key) const;
  void choose(std::vector<Chosen> keys);
  void followChosen();
  void chooseIn(const QRect& box);
  void beginDrag(const Chosen& key, double grip, bool copies);
  void dragTo(double time);
  double heldShift(double shift) const;
  void endDrag(bool keep);
  void tell(const QString& problem);  ///< "": there is none
  void setKeyAt(const Row& row, double time);
  void removeChosen();
  /// Fields over the row, for time and value of a key.
  void typeKey(const Chosen& key);
  void takeTyped(const Address& address, double time, const QString& newTime, const QString& newValue);
  void hintAhead(double seconds);
  void fillKeyMenu(QMenu& menu);
  void setWay(ToNext way);
  QString tipAt(const QPoint& at) const;
  void paintRuler(QPainter& painter) const;
  void paintRow(QPainter& painter, const Row& row, int top) const;
  double span() const;  ///< s, from the left end to the right one

  Session& m_session;
  const int m_ruler, m_row;
  std::vector<Row> m_rows;
  bool m_rowsShown = true;
  /// What it was when it was chosen, to find it again among keys that others change.
  struct Picked {
    Chosen key;
    double time = 0;
    size_t count = 0;  ///< of its track's keys
  };
  std::vector<Picked> m_picked;  ///< the last one is under the hand
  struct Drag {
    double grip = 0, from = 0;  ///< s: from the key to where it was taken, and where it was
    std::vector<std::pair<Address, std::vector<TrackKey>>> before;
    std::vector<Chosen> keys;
    bool moved = false, copies = false;
    QString problem{};
  };
  std::optional<Drag> m_drag;
  std::optional<QRect> m_box;
  bool m_scrubs = false;
};

}  // namespace ps
