// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QString>
#include <QtGui/QColor>
#include <QtWidgets/QWidget>

#include <string>
#include <vector>

namespace ps {

class Document;
class GroupHeading;
class Selection;

/// The strokes of one sketched body, in the order in which they were drawn: with which brush, how far it went, and of
/// what. The body is the one that is selected or, while none is, the one that was drawn at last. Without one that has
/// strokes there is a sentence.
class StrokesList : public QWidget {
  Q_OBJECT
 public:
  StrokesList(Document& document, Selection& selection, QWidget* parent = nullptr);

  /// A line as it is painted.
  struct Line {
    QString icon, name, length;  ///< "tube", "Tube, in a mirror", "312 mm"
    QColor colour;               ///< of its matter; invalid where it leaves none
  };
  const std::vector<Line>& lines() const { return m_lines; }
  const std::string& body() const { return m_body; }  ///< whose strokes these are; "": of none
  int current() const { return m_current; }           ///< the line that the keys are on; -1: none

  static constexpr int kRow = 26;  ///< px

 private:
  class Rows;
  void refresh();
  const VoxelShape* sketch(const std::string& body) const;  ///< nullptr: it has no strokes
  void setCurrent(int line);

  Document& m_document;
  Selection& m_selection;
  std::string m_body, m_drawn;
  std::vector<Line> m_lines;
  int m_current = -1;
  GroupHeading* m_heading;
  Rows* m_rows;
  QWidget* m_scroll;
};

}  // namespace ps
