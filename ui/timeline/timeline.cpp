// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/timeline.h"

#include "ui/timeline/keyrows.h"
#include "ui/timeline/transport.h"

#include <QtWidgets/QScrollArea>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kMostRows = 4;  ///< that are shown without scrolling

}  // namespace

Timeline::Timeline(Session& session, QWidget* parent)
    : QWidget(parent), m_keys(new KeyRows(session)), m_scroll(new QScrollArea), m_transport(new Transport(session)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  m_scroll->setFrameShape(QFrame::NoFrame);
  m_scroll->setWidgetResizable(true);
  m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_scroll->setFocusPolicy(Qt::NoFocus);
  m_scroll->setWidget(m_keys);
  layout->addWidget(m_transport);
  layout->addWidget(m_scroll);
  connect(m_keys, &KeyRows::rowsChanged, this, &Timeline::fit);
  connect(m_transport, &Transport::heightChanged, this, &Timeline::fit);
  fit();
}

void Timeline::fit() {
  const int most = KeyRows::kRuler + kMostRows * KeyRows::kRow;
  const int height = std::min(m_keys->wantedHeight(), most);
  m_scroll->setFixedHeight(height);
  m_scroll->setVisible(height > 0);
  setFixedHeight(m_transport->minimumHeight() + height);
  Q_EMIT heightChanged(m_transport->minimumHeight() + height);
}

}  // namespace ps
