// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/timeline.h"

#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/markerrow.h"

#include <QtWidgets/QScrollArea>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kMostRows = 4;  ///< that are shown without scrolling

}  // namespace

Timeline::Timeline(Session& session, PointedBy by, QWidget* parent)
    : QWidget(parent),
      m_keys(new KeyRows(session, by == PointedBy::Hand ? kHandLeast : 0)),
      m_markers(new MarkerRow(session, *m_keys)),
      m_scroll(new QScrollArea),
      m_transport(new Transport(session, by)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  m_scroll->setFrameShape(QFrame::NoFrame);
  m_scroll->setWidgetResizable(true);
  m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_scroll->setFocusPolicy(Qt::NoFocus);
  m_scroll->setWidget(m_keys);
  layout->addWidget(m_transport);
  layout->addWidget(m_markers);
  layout->addWidget(m_scroll);
  connect(m_keys, &KeyRows::rowsChanged, this, &Timeline::fit);
  connect(m_transport, &Transport::heightChanged, this, &Timeline::fit);
  m_transport->setAxis({KeyRows::kLabel, KeyRows::kEnd});
  m_markers->setHidden(session.document().project().markers.empty());
  connect(m_markers, &MarkerRow::wanted, this, [this](bool any) {
    m_markers->setVisible(any);
    fit();
  });
  fit();
}

std::vector<std::pair<QString, QString>> Timeline::gestures() {
  return {{QStringLiteral("Drag"), QStringLiteral("Show a recorded time; move a key or a marker")},
          {QStringLiteral("Double-click"), QStringLiteral("Set a key or a marker; name a run or a marker")},
          {QStringLiteral("Ctrl+double-click"), QStringLiteral("The same at a frame, not at a tenth of a second")},
          {QStringLiteral("F2"), QStringLiteral("Name the chosen run or marker")},
          {QStringLiteral("Del"), QStringLiteral("Delete the chosen key or marker")},
          {QStringLiteral("Right-click"),
           QStringLiteral("Type a key, add a marker; go on with an earlier run, compare, delete")}};
}

void Timeline::setSlim(bool slim) {
  m_keys->setRowsShown(!slim);
  fit();
}

/// The ruler stays where there are no keys: markers and the recorded part are on its scale.
void Timeline::fit() {
  const int most = m_keys->ruler() + kMostRows * m_keys->rowHeight();
  const int height = std::min(m_keys->wantedHeight(), most);
  m_scroll->setFixedHeight(height);
  const int all = m_transport->minimumHeight() + (m_markers->isHidden() ? 0 : m_markers->height()) + height;
  setFixedHeight(all);
  Q_EMIT heightChanged(all);
}

}  // namespace ps
