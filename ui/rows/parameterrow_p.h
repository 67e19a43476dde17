// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/rows/parameterrow.h"
#include "ui/theme/numbers.h"

#include <QtCore/QPointF>
#include <QtCore/QRect>
#include <QtCore/QTimer>

#include <limits>
#include <vector>

class QMenu;
class QPainter;

namespace ps {

// Measures of a row in logical pixels. From the left: changed mark, label, symbol, slider; from the right: room for the
// curve mark and a key, field.
inline constexpr int kRowHeight = 26, kRowLeft = 12, kRowRight = 42, kRowRightNarrow = 26, kFieldWidth = 104,
                     kFieldHeight = 22;
inline constexpr int kSymbolWidth = 26, kSliderGap = 6, kLabelGap = 8, kMinimumSlider = 40, kMinimumLabel = 120;
/// Of a row whose label is longer than the column of labels: twice the handle's way and its width.
inline constexpr int kLeastSlider = 24;
/// Right end of the value and left end of the unit, from the field's left.
inline constexpr int kFieldLeft = 7, kValueRight = 54, kUnitLeft = 60, kFieldRight = 3;
/// A gesture by wheel or keys, or a click that a double-click may follow, ends after this long without more of it.
inline constexpr int kSettleMilliseconds = 400;

struct ParameterRow::Private {
  explicit Private(ParameterRow* row) : q(row) {}

  ParameterRow* q;
  RowModel model;
  bool showSymbol = true;
  int labelWidth = kMinimumLabel;
  int rightMargin = kRowRight;
  bool hover = false;
  bool keyboardFocus = false;  ///< came by Tab: letters and digits are ours
  bool wasChanged = false;

  double delivered = std::numeric_limits<double>::quiet_NaN();
  QString limitText, errorText;
  QLabel* limit = nullptr;
  QLabel* error = nullptr;
  QLineEdit* edit = nullptr;
  QString editUnit;  ///< of bare numbers in `edit`; "": the displayed one

  // A gesture: open from Begin to End.
  bool open = false;
  Value before;
  bool mixedBefore = false;
  QTimer settle;
  bool dragging = false;
  bool dragCancelled = false;  ///< Esc: wait for the button to be released
  double dragPosition = 0;     ///< 0..1 on the slider, not rounded; on a sparkline the tens by which it is scaled
  double dragX = 0;
  Value dragCurve;  ///< what a drag on the sparkline scales
  double dragFrom = 0;
  bool scaled = false;   ///< by this drag
  double wheelRest = 0;  ///< parts of a wheel step

  const api::ParameterDeclaration& declaration() const { return model.declaration; }
  bool isEditable() const { return model.disabledReason.isEmpty() && model.derivedFrom.isEmpty(); }
  bool isNumeric() const;  ///< has a slider or sparkline, and a field
  bool showsCurve() const;
  bool hasEditor() const;                ///< of curves: somebody listens
  bool leadsTo(const QPoint& at) const;  ///< a click there asks for something that somebody listens to
  int symbolRoom() const;                ///< left of the slider, pixels
  bool drawsSymbol() const;              ///< a label that needs the symbol's room takes it
  FieldText fieldText() const;           ///< what stands in the field
  bool needsPrefix() const;              ///< the value is too long for the field in its own unit

  void begin();
  void change(const Value& value);
  void finish();
  void takeBack();                  ///< ends the gesture with the value it began with
  void single(const Value& value);  ///< a gesture of one change
  void refresh();                   ///< after any change: repaint, changed mark, accessibility
  void layoutNotes();
  void styleNotes();
  void closeEdit();
  bool scaleCurve(double factor, double added);
  void toggle();
  void choose(int index);
  void stepBy(double steps, bool fine);
  void dragTo(double x, Qt::KeyboardModifiers modifiers);
  double handleX() const;
  QRect curveRect() const;  ///< the curve mark right of the field
  /// Where a click means a mark right of the field: what a beam or a fingertip meets in a headset, too.
  QRect targetOf(const QRect& mark) const;
  QRect switchRect() const;
  /// Rectangles of the segments of a choice; empty when they do not fit or none is chosen (then a menu opens).
  std::vector<QRect> segments() const;
  QStringList choiceTexts() const;  ///< as shown
  QRect choiceRect() const;         ///< of all segments, or of the menu's button
  void openChoiceMenu();
  void openContextMenu(const QContextMenuEvent& event);
  void pressed(const QPoint& at, Qt::KeyboardModifiers modifiers);
  bool editKey(int key);  ///< of the line edit; true: handled
  void startTyping(const QString& text);
  bool wantsKey(int key, const QString& text) const;
  QString toolTipText() const;

  void paint(QPainter& painter) const;
  void paintSlider(QPainter& painter) const;
  void paintSparkline(QPainter& painter) const;
  void paintField(QPainter& painter) const;
  void paintChoice(QPainter& painter) const;
  void paintLeft(QPainter& painter) const;
  bool offersKeys() const;  ///< somebody listens
  bool takesKeys() const;
  QString keyText() const;  ///< of the tooltip
  void addKeyEntries(QMenu* menu);
  void paintKey(QPainter& painter) const;
};

/// Makes rows known to assistive technology; may be called often.
void installRowAccessibility();

}  // namespace ps
