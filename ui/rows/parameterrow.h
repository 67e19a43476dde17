// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/parameters/parameterset.h"
#include "core/scene/project.h"

#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtWidgets/QWidget>

#include <limits>
#include <memory>

class QLabel;
class QLineEdit;

namespace ps {

enum class RowCommand;

/// Where an edit stands. Every gesture is Begin, any number of Live, End: one undo step. Begin carries the value
/// before, Live and End the new one; a gesture taken back with Esc ends with the value it began with.
enum class Edit { Begin, Live, End };

/// Where a row stands among the keys of its parameter over time.
enum class KeyMark {
  None,     ///< it has none
  Between,  ///< of two keys, or before the first, or behind the last
  OnKey
};

/// One row of a panel: a declared parameter, its value and what it is compared with.
/// The declaration's texts are borrowed and must outlive the row (declarations are static in the program or a plugin).
struct RowModel {
  QString key;  ///< comes back in signals; an Address's text, or the bare key
  api::ParameterDeclaration declaration{};
  Value value;
  Value defaultValue;           ///< "changed" means different from this; a reset goes here
  bool pinned = false;          ///< the copy that stands in "Try these"
  bool isPinned = false;        ///< such a copy exists, or is this row
  bool mixed = false;           ///< several selected owners disagree
  bool together = false;        ///< it stands for several owners: they are asked for a reset, each has its own default
  QStringList choiceLabels;     ///< of a choice, in the order of its names; empty: made from the names
  QStringList rules;            ///< sentences for the tooltip: what bounds the value, when it acts
  QString disabledReason;       ///< not empty: disabled, the tooltip says why
  bool kept = false;            ///< of a plugin that is not installed: there is nothing to pin, plot or key
  QString derivedFrom;          ///< not empty: computed, no field: "from pressure"
  QString source;               ///< of the default value; "": the declaration's
  double temperature = 293.15;  ///< K, operating point of a response
  KeyMark keyMark = KeyMark::None;
  ToNext way = ToNext::Linear;  ///< from the key that it is on, or behind, to the next
};

/// What a row shows at the moment; flags.
enum class RowState : unsigned {
  Hover = 1,
  Focus = 2,
  Disabled = 4,
  Mixed = 8,
  OutOfRange = 16,
  Changed = 32,
  Curve = 64,
  Derived = 128,
  Limited = 256,
  Error = 512,
  Editing = 1024,
  Dragging = 2048,
  OnKey = 4096,       ///< its parameter has keys over time, one of them now
  BetweenKeys = 8192  ///< or none now
};

/// A note as rich text: lines with "[text](link)" as links in accent, not underlined.
QString noteAsRichText(const QString& markdown);

/// Any text as a part of a note under a row (ParameterRow::setLimit), without a link in it.
QString asNote(QString text);

/// A parameter as one painted widget: changed mark, label, symbol, slider (or sparkline, toggle, choices), field with
/// unit. A line edit exists only while somebody types. Accessible as a slider (check box, combo box) with name and
/// value.
class ParameterRow : public QWidget {
  Q_OBJECT
 public:
  explicit ParameterRow(RowModel model, QWidget* parent = nullptr);
  ~ParameterRow() override;

  const RowModel& model() const;
  const QString& key() const;
  /// A value from outside (undo, another view). Ignored while this row is being dragged. Emits nothing.
  void setValue(const Value& value);
  void setDefaultValue(const Value& value);
  void setMixed(bool mixed);
  void setIsPinned(bool isPinned);
  void setDisabledReason(const QString& reason);
  void setChoiceLabels(const QStringList& labels);  ///< as RowModel::choiceLabels
  void setDerivedFrom(const QString& derivedFrom);
  void setTemperature(double kelvin);  ///< operating point of a response
  void setKeyMark(KeyMark mark, ToNext way);
  /// Note under the row, "" removes it. "[text](link)" is a link; what others wrote comes through asNote().
  /// `delivered`: the value (SI) up to which the solver can follow, hatched beyond it; NaN: no hatching.
  void setLimit(const QString& text, double delivered = std::numeric_limits<double>::quiet_NaN());
  /// A sentence under the row, plain text; the old value stays in force. "" removes it.
  void setError(const QString& text);
  void setShowSymbol(bool show);
  /// Width of the label's column in logical pixels, so that all rows of a panel align.
  void setLabelWidth(int pixels);
  /// Logical pixels right of the field.
  void setRightMargin(int pixels);
  /// Width of the label's text.
  int wantedLabelWidth() const;

  bool isChanged() const;
  unsigned states() const;  ///< of RowState
  bool has(RowState state) const { return (states() & static_cast<unsigned>(state)) != 0; }
  QString valueText() const;  ///< as shown, with unit; "—" when mixed
  /// The number behind the row in SI (toggle 0/1, choice index, response: at the operating point).
  double number() const;

  void reset();  ///< to the default, one gesture
  /// Asks for a key of the value that is shown, or for none where there is one. Nothing where nobody listens.
  void toggleKey();
  bool isHovered() const;
  /// Somebody listens to what it asks for: rows that are no values of the scene have no keys, graphs and pins.
  bool isServed(RowCommand command) const;
  /// Ends a gesture that is still open, and drops what was typed and not entered.
  void finishEditing();
  void startTyping();  ///< opens the line edit
  /// A number (SI) as if typed; refused beyond the hard limits.
  bool enterNumber(double value);
  bool enter(const QString& text);  ///< as if typed and Enter pressed; false: refused, the row shows why

  QRect labelRect() const;
  QRect sliderRect() const;  ///< of the track; also sparkline, toggle or choices
  QRect fieldRect() const;
  QRect keyRect() const;  ///< of the diamond
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;
  int heightForWidth(int width) const override;

 Q_SIGNALS:
  void editingStarted(const QString& key, const ps::Value& before);
  void valueEdited(const QString& key, const ps::Value& value);
  void editingFinished(const QString& key, const ps::Value& value);
  /// "*2" or "+10" typed into a mixed row: each value becomes `factor` times what it is, and `added` (SI) more. Within
  /// a gesture, as its curve is dragged, times what it was at the beginning.
  void scaled(const QString& key, double factor, double added);
  void resetAsked(const QString& key);       ///< of several owners
  void takenBack(const QString& key);        ///< before its end: what the gesture did to values that differed
  void curveRequested(const QString& key);   ///< sparkline clicked
  void sourceRequested(const QString& key);  ///< "from pressure" clicked
  void linkActivated(const QString& key, const QString& link);
  void pinToggled(const QString& key, bool pinned);
  void plotRequested(const QString& key);
  void keyToggled(const QString& key, const ps::Value& shown);
  void wayChosen(const QString& key, ps::ToNext way);
  void keysRemoved(const QString& key);
  void changedChanged();  ///< isChanged() may differ

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void changeEvent(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Private;
  std::unique_ptr<Private> d;
};

}  // namespace ps
Q_DECLARE_METATYPE(ps::Value)
Q_DECLARE_METATYPE(ps::Edit)
