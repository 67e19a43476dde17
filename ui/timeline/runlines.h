// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

#include <cstdint>
#include <optional>

class QMenu;

namespace ps {

class Session;

/// The earlier runs of a scene as lines with their names, from where each left the run to its end, the oldest at the
/// top. A click chooses one; F2 or a double-click names it in its place, a right-click offers what can be done with it
/// and with those that are too old to have a line.
/// The one that graphs compare with is dashed, as its curves are, and has the ghost's colour while that is shown.
class RunLines : public QWidget {
  Q_OBJECT
 public:
  static constexpr int kPitch = 16, kMost = 4;  ///< logical pixels; lines that are shown, the newest

  explicit RunLines(Session& session, QWidget* parent = nullptr);
  void setSpan(double seconds);  ///< from the left end to the right one
  int wantedHeight() const;
  void fillMenu(QMenu& menu, uint64_t run);
  void addMenus(QMenu& menu, bool older);  ///< one for each run, or for each that has no line
  void editName(uint64_t run);             ///< in its line; of one without, in the first
  QRect rowOf(uint64_t run) const;         ///< empty: it is not shown
  std::optional<uint64_t> chosen() const { return m_chosen; }

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  struct Row {
    uint64_t run = 0;
    QString name, tip;
    QRectF line, text;
  };
  std::vector<Row> rows() const;
  std::optional<uint64_t> runAt(const QPoint& at) const;

  Session& m_session;
  double m_span = 1;  ///< s
  std::optional<uint64_t> m_chosen;
};

}  // namespace ps
