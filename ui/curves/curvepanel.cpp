// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/curvepanel.h"

#include "core/math/responseedit.h"
#include "ui/curves/curveview.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QVBoxLayout>

#include <cmath>

namespace ps {
namespace {

const QString kHint =
    QStringLiteral("Double-click adds a point · Del removes · Shift fine · Alt-drag moves all · F fits");

QLabel* label(TextRole role, bool muted = false) {
  auto* text = new QLabel;
  text->setFont(Theme::font(role));
  text->setTextFormat(Qt::PlainText);
  text->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  if (muted) text->setForegroundRole(QPalette::PlaceholderText);
  return text;
}

QLineEdit* field(const QString& name) {
  auto* line = new QLineEdit;
  line->setFixedWidth(124);
  line->setAlignment(Qt::AlignRight);
  line->setAccessibleName(name);
  return line;
}

}  // namespace

CurvePanel::CurvePanel(Session& session, CurveTarget& target, QWidget* parent)
    : QWidget(parent),
      m_target(target),
      m_title(label(TextRole::Heading)),
      m_source(label(TextRole::Small, true)),
      m_which(label(TextRole::Normal)),
      m_note(label(TextRole::Small, true)),
      m_view(new CurveView(target)),
      m_kelvin(field(QStringLiteral("Temperature of the point"))),
      m_value(field(QStringLiteral("Value of the point"))) {
  m_title->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  m_which->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  m_note->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  auto* top = new QHBoxLayout;
  top->setContentsMargins(10, 4, 10, 0);
  top->setSpacing(12);
  top->addWidget(m_title);
  top->addWidget(m_source, 1);
  auto* bottom = new QHBoxLayout;
  bottom->setContentsMargins(12, 0, 12, 6);
  bottom->setSpacing(6);
  bottom->addWidget(m_which);
  bottom->addWidget(m_kelvin);
  bottom->addWidget(m_value);
  bottom->addWidget(m_note, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addLayout(top);
  column->addWidget(m_view, 1);
  column->addLayout(bottom);
  for (QLineEdit* line : {m_kelvin, m_value}) {
    connect(line, &QLineEdit::editingFinished, this, [this, line] { enter(line); });
  }
  connect(&target, &CurveTarget::targetChanged, this, &CurvePanel::showTitle);
  connect(&target, &CurveTarget::responseChanged, this, [this] {
    showPoint();
    showOverlays();
  });
  connect(&target, &CurveTarget::pointChanged, this, &CurvePanel::showPoint);
  connect(&target, &CurveTarget::comparedChanged, this, &CurvePanel::showOverlays);
  connect(&target, &CurveTarget::refused, this,
          [this](const QString& problem) { m_note->setText(problem.isEmpty() ? kHint : problem); });
  const auto follow = [this] {
    if (m_view->isVisible()) m_view->showParticles();
  };
  connect(&session, &Session::totalsDue, m_view, follow);
  connect(&target, &CurveTarget::markChanged, m_view, follow);
  connect(&session, &Session::projectShown, m_view, &CurveView::fit);  // its matter is known only now
}

void CurvePanel::showTitle() {
  const QString source = m_target.source();
  m_title->setText(QString::fromUtf8(m_target.declaration().label));
  m_title->setMinimumWidth(static_cast<int>(std::ceil(textWidth(m_title->text(), m_title->font()))) + 2);
  m_source->setText(QStringLiteral("of %1, over temperature").arg(m_target.materialLabel()) +
                    (source.isEmpty() ? source : QStringLiteral(" · ") + source));
  m_source->setToolTip(source);
  m_note->setText(kHint);
}

void CurvePanel::showPoint() {
  const Response response = m_target.response();
  const int index = m_target.point();
  const bool any = response.kind == Response::Kind::Curve && index >= 0;
  m_which->setText(any ? QStringLiteral("Point %1").arg(index + 1) : QStringLiteral("No point selected"));
  for (QLineEdit* line : {m_kelvin, m_value}) line->setVisible(any);
  if (!any) return;
  const api::ResponsePoint& p = response.points[static_cast<size_t>(index)];
  m_kelvin->setText(formatValue(temperatureDeclaration(), p.x));
  m_value->setText(formatValue(m_target.declaration(), p.y));
  m_kelvin->setModified(false);
  m_value->setModified(false);
}

/// The number as typed, with any unit of its kind.
void CurvePanel::enter(QLineEdit* line) {
  Response next = m_target.response();
  const int index = m_target.point();
  if (!line->isModified() || index < 0 || next.kind != Response::Kind::Curve) return;
  line->setModified(false);
  api::ResponsePoint p = next.points[static_cast<size_t>(index)];
  const bool kelvin = line == m_kelvin;
  const Typed typed =
      parseTyped(line->text(), kelvin ? temperatureDeclaration() : m_target.declaration(), kelvin ? p.x : p.y);
  if (!typed.problem.isEmpty()) {
    showPoint();
    m_note->setText(typed.problem);
    return;
  }
  (kelvin ? p.x : p.y) = typed.value;
  movePoint(next, static_cast<size_t>(index), p);
  if (!m_target.set(next, QStringLiteral("Move point of %1").arg(QString::fromUtf8(m_target.declaration().label))))
    showPoint();
}

void CurvePanel::showOverlays() {
  std::vector<OverlayCurve> overlays;
  const Project& project = m_target.document().project();
  for (const SceneMaterial& other : project.materials) {
    if (other.id == m_target.material() || !m_target.compared().contains(other.id)) continue;
    const Address address{Owner::Material, other.id, m_target.address().key};
    overlays.push_back({other.id, ownerLabel(project, address), responseOf(m_target.document().value(address))});
  }
  m_view->setOverlays(std::move(overlays));
}

}  // namespace ps
