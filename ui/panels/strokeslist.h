// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "ui/tools/toolbox.h"

#include <QtCore/QRectF>
#include <QtCore/QString>
#include <QtGui/QColor>
#include <QtWidgets/QWidget>

#include <optional>
#include <string>
#include <vector>

class QKeyEvent;
class QMenu;

namespace ps {

class Document;
class GroupHeading;
class Selection;
class Session;
class StrokeListEdits;
struct StrokeChanged;

/// The strokes of one sketched body, in the order in which they were drawn: with which brush, how far it went, and of
/// what. The body is the one that is selected or, while none is, the one that was drawn at last. Without one that has
/// strokes there is a sentence. The keys, the mouse and a menu remove a stroke, move it earlier or later, give it
/// another material, hide it and have it drawn anew (see StrokeListEdits). The view shows the one that the keys are on,
/// and the tool Move moves it.
class StrokesList : public QWidget {
  Q_OBJECT
 public:
  StrokesList(Session& session, Toolbox& tools, QWidget* parent = nullptr);

  /// A line as it is painted.
  struct Line {
    QString icon, name, length;  ///< "tube", "Tube, in a mirror", "312 mm"
    QColor colour;               ///< of its matter; invalid where it leaves none
    bool hidden = false;
  };
  const std::vector<Line>& lines() const { return m_lines; }
  const std::string& body() const { return m_body; }  ///< whose strokes these are; "": of none
  int current() const { return m_current; }           ///< the line that the keys are on; -1: none
  void setCurrent(int line);
  StrokeListEdits& edits() { return *m_edits; }
  /// px, of the eye of a line.
  static QRectF eyeOf(int line, int width) { return {width - 28.0, line * kRow + 3.0, 20, 20}; }
  QMenu* menuOf(int line);  ///< of what can be done with it; its parent is the list

  /// The next stroke that a hand draws takes its place, unless another tool is taken first.
  void drawAnew(int line);

  static constexpr int kRow = 26;  ///< px

 private:
  class Rows;
  void refresh();
  void refreshHeading();
  void choose();  ///< the line that the keys are on, for the view
  void onStroke(const StrokeChanged& event);
  void takeAnew(const std::string& body, bool isLast);
  void turnHidden(int line);  ///< hides a stroke that is shown, and shows one that is hidden
  const VoxelShape* sketch(const std::string& body) const;  ///< nullptr: it has no strokes
  bool act(const QKeyEvent& event);                         ///< whether a key is one of the list's, and done

  Document& m_document;
  Toolbox& m_tools;
  Selection& m_selection;
  StrokeListEdits* m_edits;
  std::string m_body, m_drawn;
  std::vector<Line> m_lines;
  int m_current = -1;
  std::optional<ChosenStroke> m_anew;  ///< that the next stroke of a hand takes the place of
  GroupHeading* m_heading;
  Rows* m_rows;
  QWidget* m_scroll;
};

}  // namespace ps
