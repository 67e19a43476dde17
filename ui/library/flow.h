// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QList>
#include <QtWidgets/QLayout>

namespace ps {

/// One behind the other, in as many lines as they need, each as large as it wants to be.
class Flow : public QLayout {
 public:
  explicit Flow(int spacing) { setSpacing(spacing); }
  ~Flow() override;
  void addItem(QLayoutItem* item) override;
  int count() const override { return static_cast<int>(m_items.size()); }
  QLayoutItem* itemAt(int index) const override { return m_items.value(index); }
  QLayoutItem* takeAt(int index) override;
  Qt::Orientations expandingDirections() const override { return {}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return arrange({0, 0, width, 0}, false); }
  QSize sizeHint() const override { return minimumSize(); }
  QSize minimumSize() const override;  ///< of the largest one
  void setGeometry(const QRect& rect) override;

 private:
  int arrange(const QRect& rect, bool moves) const;  ///< px, how high they are
  QList<QLayoutItem*> m_items;
};

}  // namespace ps
