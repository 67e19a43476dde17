// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/groupheading.h"
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowvalue.h"

#include <QtWidgets/QAccessibleWidget>

namespace ps {
namespace {

/// A row as a screen reader meets it: slider, check box or combo box, with name, value and what it is about.
class RowAccessible final : public QAccessibleWidget, public QAccessibleValueInterface {
 public:
  explicit RowAccessible(ParameterRow* row) : QAccessibleWidget(row, roleOf(*row)) {}

  QString text(QAccessible::Text kind) const override {
    switch (kind) {
      case QAccessible::Name:
        return QString::fromUtf8(declaration().label);
      case QAccessible::Value:
        return row()->valueText();
      case QAccessible::Description:
        return QString::fromUtf8(declaration().help) +
               (row()->model().keyMark == KeyMark::OnKey     ? QStringLiteral(" It has a key at this time.")
                : row()->model().keyMark == KeyMark::Between ? QStringLiteral(" It goes by keys.")
                                                             : QString());
      default:
        return QAccessibleWidget::text(kind);
    }
  }
  QAccessible::State state() const override {
    QAccessible::State state = QAccessibleWidget::state();
    state.disabled = row()->has(RowState::Disabled);
    state.readOnly = row()->has(RowState::Derived);
    state.invalid = row()->has(RowState::Error);
    if (role() == QAccessible::CheckBox) {
      state.checkable = true;
      state.checked = row()->number() != 0;
    }
    return state;
  }
  void* interface_cast(QAccessible::InterfaceType type) override {
    if (type == QAccessible::ValueInterface) return static_cast<QAccessibleValueInterface*>(this);
    return QAccessibleWidget::interface_cast(type);
  }
  QVariant currentValue() const override { return row()->number(); }
  void setCurrentValue(const QVariant& value) override { row()->enterNumber(value.toDouble()); }
  QVariant minimumValue() const override { return role() == QAccessible::Slider ? declaration().minimum : 0.0; }
  QVariant maximumValue() const override {
    switch (role()) {
      case QAccessible::CheckBox:
        return 1.0;
      case QAccessible::ComboBox:
        return static_cast<double>(choiceNames(declaration()).size() - 1);
      default:
        return declaration().maximum;
    }
  }
  QVariant minimumStepSize() const override {
    if (role() != QAccessible::Slider) return 1.0;
    const double middle = valueAtPosition(declaration(), 0.5);
    return stepped(declaration(), middle, 1, false) - middle;
  }

 private:
  static QAccessible::Role roleOf(const ParameterRow& row) {
    switch (row.model().declaration.kind) {
      case api::ParameterKind::Toggle:
        return QAccessible::CheckBox;
      case api::ParameterKind::Choice:
        return QAccessible::ComboBox;
      default:
        return QAccessible::Slider;
    }
  }
  ParameterRow* row() const { return static_cast<ParameterRow*>(widget()); }
  const api::ParameterDeclaration& declaration() const { return row()->model().declaration; }
};

QAccessibleInterface* makeAccessible(const QString& /*className*/, QObject* object) {
  if (auto* heading = qobject_cast<GroupHeading*>(object)) return new QAccessibleWidget(heading, QAccessible::Button);
  auto* row = qobject_cast<ParameterRow*>(object);
  return row ? new RowAccessible(row) : nullptr;
}

}  // namespace

void installRowAccessibility() {
  static const bool installed = [] {
    QAccessible::installFactory(makeAccessible);
    return true;
  }();
  (void)installed;
}

}  // namespace ps
