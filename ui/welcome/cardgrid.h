// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/welcome/buttons.h"

#include <QtWidgets/QWidget>

#include <vector>

namespace ps {

/// Cards side by side, as many as have room, all of one width. Arrows go from one to the next.
class CardGrid : public QWidget {
  Q_OBJECT
 public:
  explicit CardGrid(QWidget* parent = nullptr);
  void setSamples(const std::vector<Sample>& samples);
  /// Shows those with this word alone; "": all.
  void setTag(const QString& tag);
  std::vector<Card*> cards() const;  ///< those that are shown
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;
  QSize sizeHint() const override { return {700, heightForWidth(700)}; }
  QSize minimumSizeHint() const override { return {200, 100}; }

 Q_SIGNALS:
  void chosen(const QString& path);
  void focused(QWidget* card);  ///< the keyboard has come to it

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  int columnsIn(int width) const;
  int cardWidth(int width) const;
  int arrange(int width, bool moves) const;  ///< px, how high they are
  void place();
  std::vector<Card*> m_cards;
};

}  // namespace ps
