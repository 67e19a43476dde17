// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/rows/panelheader.h"
#include "ui/rows/parameterrow.h"

#include <QtWidgets/QWidget>

#include <limits>
#include <memory>
#include <vector>

namespace ps {

/// Rows of a list of declarations with the values of `set`. `defaults` are what the values are compared with (a
/// material's base values); what it lacks has the declaration's default. Rules are judged by the set alone: what a
/// declaration says of another owner counts as met. `keyPrefix` is put before each key: "material/water/".
std::vector<RowModel> rowModels(api::ParameterList list, const ParameterSet& set, const ParameterSet& defaults = {},
                                const QString& keyPrefix = {});

/// An inspector made from declarations: header, filter, "Changed n", headings that fold, rows. It knows no document:
/// it tells of edits and is told of values. Two rows may have one key (a pinned row and its original).
class ParameterPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ParameterPanel(QWidget* parent = nullptr);
  ~ParameterPanel() override;

  /// Block at the top: name, line below it, small line below that. A nullptr swatch draws none.
  void setHeader(const QString& name, const QString& subtitle, const QString& detail = {}, SwatchPainter swatch = {});
  /// Below the header, with links as ParameterRow::setLimit() has them, which come back as linkActivated() of key "".
  void setHeaderNote(const QString& note);
  void setHeaderDetail(const QString& detail);
  void updateHeader();  ///< paints its swatch again
  /// Replaces all rows. Pinned ones stand in a group "Try these" on top, others by the declaration's group in the order
  /// in which groups first appear. Keeps scroll position, folded groups and the filter. Gestures still open end first;
  /// a row may ask for this from its own menu or signal.
  void setModel(std::vector<RowModel> rows);
  /// Sentence shown when there are no rows.
  void setEmptyText(const QString& text);

  void setValue(const QString& key, const Value& value);
  void setDefaultValue(const QString& key, const Value& value);
  void setMixed(const QString& key, bool mixed);
  void setKeyMark(const QString& key, KeyMark mark, ToNext way);
  /// Keys of what is pinned, in this panel or another: what the rows' menus offer follows. Holds for later models too.
  void setPinned(const QStringList& keys);
  /// Note under the row; see ParameterRow::setLimit. "" removes it.
  void setLimit(const QString& key, const QString& text, double delivered = std::numeric_limits<double>::quiet_NaN());
  void setDisabledReason(const QString& key, const QString& reason);  ///< "" enables it
  void setChoiceLabels(const QString& key, const QStringList& labels);
  void setError(const QString& key, const QString& text);

  ParameterRow* row(const QString& key) const;  ///< first with that key, or nullptr
  std::vector<ParameterRow*> rows() const;      ///< all, in order
  int changedCount() const;
  void setFilter(const QString& text);
  void setChangedOnly(bool on);
  void setGroupFolded(const QString& group, bool folded);
  QStringList foldedGroups() const;                ///< sorted, also of other rows that it has had
  bool isRowShown(const ParameterRow* row) const;  ///< by filter and folding
  /// Unfolds a row's group, scrolls so that its heading stands on top (unless the row would be out of sight then) and
  /// gives the row the focus where asked. False: no such row.
  bool reveal(const QString& key, bool focus = true);

 Q_SIGNALS:
  void edited(const QString& key, const ps::Value& value, ps::Edit edit);
  void scaled(const QString& key, double factor, double added);
  void resetAsked(const QString& key);
  void takenBack(const QString& key);
  void linkActivated(const QString& key, const QString& link);
  void curveRequested(const QString& key);
  void sourceRequested(const QString& key);
  void pinToggled(const QString& key, bool pinned);
  void plotRequested(const QString& key);
  void keyToggled(const QString& key, const ps::Value& shown);
  void wayChosen(const QString& key, ps::ToNext way);
  void keysRemoved(const QString& key);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Private;
  std::unique_ptr<Private> d;
};

}  // namespace ps
