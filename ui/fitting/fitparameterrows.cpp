// SPDX-License-Identifier: Apache-2.0
#include "ui/fitting/fitparameterrows.h"

#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"

#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kField = 76;  // logical pixels

}  // namespace

FitParameterRows::FitParameterRows(Document& document, QWidget* parent)
    : QWidget(parent), m_document(document), m_column(new QVBoxLayout(this)) {
  m_column->setContentsMargins(0, 0, 0, 0);
  m_column->setSpacing(2);
  connect(&document, &Document::changed, this, [this](const ChangeEvent&) { follow(); });
}

FitParameterRows::Key FitParameterRows::keyOf(const FitTarget& target) const {
  const Track* track = target.key ? findTrack(m_document.project().tracks, target.trackText()) : nullptr;
  return track && *target.key < track->keys.size() ? Key{track->keys[*target.key].time, track->keys.size()} : Key{};
}

/// The key of the same time; where there is none and none came or went, it was moved.
bool FitParameterRows::followKey(size_t row) {
  FitTarget& target = m_parameters[row].target;
  if (!target.key) return true;
  const Track* track = findTrack(m_document.project().tracks, target.trackText());
  if (!track) return false;
  const auto same = std::find_if(track->keys.begin(), track->keys.end(),
                                 [&](const TrackKey& key) { return key.time == m_keys[row].time; });
  if (same != track->keys.end())
    target.key = static_cast<size_t>(same - track->keys.begin());
  else if (track->keys.size() != m_keys[row].count)
    return false;
  m_keys[row] = keyOf(target);
  return true;
}

void FitParameterRows::follow() {
  bool gone = false;
  for (size_t k = m_parameters.size(); k-- > 0;) {
    const bool stays =
        followKey(k) && whyNotFitted(m_document.project(), m_document.plugins(), m_parameters[k].target).empty();
    if (stays) continue;
    m_parameters.erase(m_parameters.begin() + static_cast<ptrdiff_t>(k));
    m_keys.erase(m_keys.begin() + static_cast<ptrdiff_t>(k));
    gone = true;
  }
  if (gone)
    rebuild();
  else
    showValues();
}

QString FitParameterRows::add(const FitTarget& target) {
  const std::string why = whyNotFitted(m_document.project(), m_document.plugins(), target);
  if (!why.empty()) return QString::fromStdString(why);
  const bool known =
      std::any_of(m_parameters.begin(), m_parameters.end(), [&](const FitParameter& p) { return p.target == target; });
  if (known) return QStringLiteral("%1 is there already").arg(nameOf(target));
  const api::ParameterDeclaration& declared = *m_document.declaration(target.address);
  m_parameters.push_back({target, declared.minimum, declared.maximum});
  m_keys.push_back(keyOf(target));
  rebuild();
  return {};
}

QString FitParameterRows::nameOf(const FitTarget& target) const {
  const api::ParameterDeclaration* declared = m_document.declaration(target.address);
  if (!declared) return QString::fromStdString(target.address.text());
  const QString name = awayLabel(m_document.project(), target.address, QString::fromUtf8(declared->label));
  const QString point = target.point ? QStringLiteral(", point %1").arg(*target.point) : QString();
  const Track* track = findTrack(m_document.project().tracks, target.trackText());
  if (!target.key || !track || *target.key >= track->keys.size()) return name + point;
  return name + point + QStringLiteral(", key at %1 s").arg(formatShort(track->keys[*target.key].time, 6));
}

QString FitParameterRows::shown(const FitTarget& target, double number) const {
  const api::ParameterDeclaration* declared = m_document.declaration(target.address);
  return declared ? formatValue(*declared, number) : formatNumber(number);
}

void FitParameterRows::rebuild() {
  m_names.clear();
  while (QLayoutItem* item = m_column->takeAt(0)) {
    if (item->widget()) item->widget()->deleteLater();
    delete item;
  }
  for (size_t k = 0; k < m_parameters.size(); ++k) {
    const FitParameter& p = m_parameters[k];
    const api::ParameterDeclaration& declared = *m_document.declaration(p.target.address);
    auto* row = new QWidget;
    auto* line = new QHBoxLayout(row);
    line->setContentsMargins(0, 0, 0, 0);
    line->setSpacing(4);
    auto* name = new QLabel(nameOf(p.target));
    name->setTextFormat(Qt::PlainText);
    name->setMinimumWidth(20);
    line->addWidget(name, 1);
    m_names.push_back(name);
    for (const bool most : {false, true}) {
      auto* field = new QLineEdit(formatField(declared, most ? p.maximum : p.minimum));
      field->setFixedWidth(kField);
      field->setAlignment(Qt::AlignRight);
      field->setAccessibleName(nameOf(p.target) + (most ? QStringLiteral(", at most") : QStringLiteral(", at least")));
      field->setToolTip((most ? QStringLiteral("Looked for up to, in %1") : QStringLiteral("Looked for from, in %1"))
                            .arg(displayUnit(declared)));
      connect(field, &QLineEdit::editingFinished, this, [this, k, most, field] { readEnd(k, most, field); });
      line->addWidget(field);
      if (!most) line->addWidget(new QLabel(QStringLiteral("–")));
    }
    auto* unit = new QLabel(displayUnit(declared));
    unit->setProperty("role", "muted");
    line->addWidget(unit);
    auto* remove = new QToolButton;
    remove->setIcon(icon(QStringLiteral("close")));
    remove->setAutoRaise(true);
    remove->setToolTip(QStringLiteral("Leave it as it is"));
    connect(remove, &QToolButton::clicked, this, [this, k] {
      m_parameters.erase(m_parameters.begin() + static_cast<ptrdiff_t>(k));
      m_keys.erase(m_keys.begin() + static_cast<ptrdiff_t>(k));
      rebuild();
    });
    line->addWidget(remove);
    m_column->addWidget(row);
  }
  showValues();
  Q_EMIT changed();
}

/// What is no number, or out of the hard range, leaves the old one.
void FitParameterRows::readEnd(size_t row, bool most, QLineEdit* field) {
  if (row >= m_parameters.size()) return;
  FitParameter& p = m_parameters[row];
  const api::ParameterDeclaration& declared = *m_document.declaration(p.target.address);
  double& end = most ? p.maximum : p.minimum;
  const Typed typed = parseTyped(field->text(), declared, end);
  if (typed.problem.isEmpty() && typed.value >= declared.hardMinimum && typed.value <= declared.hardMaximum)
    end = typed.value;
  field->setText(formatField(declared, end));
}

void FitParameterRows::showValues() {
  for (size_t k = 0; k < m_parameters.size(); ++k) {
    const FitTarget& target = m_parameters[k].target;
    m_names[k]->setText(nameOf(target));
    m_names[k]->setToolTip(
        QStringLiteral("Now %1").arg(shown(target, numberAt(m_document.project(), m_document.plugins(), target))));
  }
}

}  // namespace ps
