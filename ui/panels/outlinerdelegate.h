// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QStyledItemDelegate>

#include <string>

namespace ps {

/// Paints a row of the outliner and takes clicks on its eye and lock.
class OutlinerDelegate : public QStyledItemDelegate {
  Q_OBJECT
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  bool editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                   const QModelIndex& index) override;
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override;
  void updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                            const QModelIndex& index) const override;
  static QRect eyeRect(const QRect& row);
  static QRect lockRect(const QRect& row);

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;

 Q_SIGNALS:
  void visibleToggled(int kind, const std::string& id, bool on) const;
  void lockToggled(int kind, const std::string& id, bool on) const;
  void renamed(int kind, const std::string& id, const QString& name) const;  ///< `kind`: OutlineKind
};

}  // namespace ps
