// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/pointspanel.h"

#include "core/math/responseedit.h"
#include "ui/curves/curvetarget.h"
#include "ui/theme/numbers.h"
#include "ui/theme/theme.h"

#include <QtCore/QSignalBlocker>
#include <QtWidgets/QButtonGroup>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QRadioButton>
#include <QtWidgets/QTableWidget>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr const char* kKind = "kind";  // property of a radio button: "points", "constant" or a law
constexpr int kTableRow = 22;
constexpr int kNext = 2;  // column
constexpr size_t kMostCoefficients = 3;
constexpr double kLeastShare = 1e-9;  // of the largest value, that counts as a value when laws are compared

QString kindLabel(const std::string& kind) {
  QString label = QString::fromStdString(kind).replace(QLatin1Char('_'), QLatin1Char(' '));
  if (kind == "points") return QStringLiteral("Custom points");
  label[0] = label[0].toUpper();
  return label;
}

std::string kindOf(const Response& response) {
  return response.kind == Response::Kind::Law     ? response.law
         : response.kind == Response::Kind::Curve ? "points"
                                                  : "constant";
}

/// The formula of a law, and what its letters mean.
std::pair<QString, QString> formulaOf(const std::string& law) {
  const QString help = QString::fromStdString(lawHelp(law));
  const qsizetype colon = help.indexOf(QLatin1Char(':'));
  return {help.left(colon), help.mid(colon + 2)};
}

QPushButton* button(const QString& text, const QString& tip) {
  auto* made = new QPushButton(text);
  made->setToolTip(tip);
  return made;
}

}  // namespace

PointsPanel::PointsPanel(CurveTarget& target, QWidget* parent)
    : QWidget(parent),
      m_target(target),
      m_table(new QTableWidget(0, 3)),
      m_kinds(new QButtonGroup(this)),
      m_add(button(QStringLiteral("Add point"), QStringLiteral("In the middle of the gap behind the selected point"))),
      m_remove(button(QStringLiteral("Remove"), QStringLiteral("The selected point"))),
      m_paste(button(QStringLiteral("Paste table"),
                     QStringLiteral("Two columns that were copied from a table or a text, instead of all points"))),
      m_thin(button(QStringLiteral("Thin out"), QStringLiteral("As few points as keep the curve where it is, within"))),
      m_fit(button(QStringLiteral("Fit law to points"), QStringLiteral("The law that is nearest to the points"))),
      m_sample(
          button(QStringLiteral("Sample law as points"), QStringLiteral("Points of the law, to be moved by hand"))),
      m_tolerance(new QLineEdit(QStringLiteral("1 %"))),
      m_laws(new QWidget),
      m_help(new QLabel),
      m_note(new QLabel) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 6, 8, 8);
  column->setSpacing(6);
  m_table->setAccessibleName(QStringLiteral("Points"));
  m_table->setTabKeyNavigation(false);  // Tab would go round in it for ever
  m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_table->setSelectionMode(QAbstractItemView::SingleSelection);
  m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  m_table->verticalHeader()->hide();
  m_table->verticalHeader()->setDefaultSectionSize(kTableRow);
  m_table->setMinimumHeight(5 * kTableRow);
  m_table->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);
  column->addWidget(m_table, 1);
  const auto pair = [column](QPushButton* left, QPushButton* right) {
    auto* row = new QHBoxLayout;
    row->addWidget(left);
    row->addWidget(right);
    row->addStretch(1);
    column->addLayout(row);
    return row;
  };
  pair(m_add, m_remove);
  pair(m_paste, m_thin)->insertWidget(2, m_tolerance);
  m_tolerance->setFixedWidth(64);
  m_tolerance->setAlignment(Qt::AlignRight);
  m_tolerance->setAccessibleName(QStringLiteral("Tolerance of thinning out"));
  m_tolerance->setToolTip(QStringLiteral("Of each value on a logarithmic axis, else of the largest one"));
  makeLaws();
  column->addWidget(m_laws);
  column->addWidget(m_note);
  column->addStretch();
  connectParts();
}

void PointsPanel::connectParts() {
  connect(m_paste, &QPushButton::clicked, this, &PointsPanel::paste);
  connect(m_thin, &QPushButton::clicked, this, &PointsPanel::thinOut);
  connect(m_add, &QPushButton::clicked, this, &PointsPanel::addPoint);
  connect(m_remove, &QPushButton::clicked, this, &PointsPanel::removePoint);
  connect(m_fit, &QPushButton::clicked, this, &PointsPanel::fitNearest);
  connect(m_sample, &QPushButton::clicked, this, &PointsPanel::sample);
  connect(m_kinds, &QButtonGroup::buttonClicked, this,
          [this](QAbstractButton* radio) { chooseKind(radio->property(kKind).toString().toStdString()); });
  connect(m_table, &QTableWidget::cellClicked, this, &PointsPanel::showWays);
  connect(m_table, &QTableWidget::cellChanged, this, &PointsPanel::enterCell);
  connect(m_table, &QTableWidget::currentCellChanged, this, [this](int row) { m_target.choosePoint(row); });
  connect(&m_target, &CurveTarget::targetChanged, this, [this] { note({}); });
  connect(&m_target, &CurveTarget::responseChanged, this, &PointsPanel::refresh);
  connect(&m_target, &CurveTarget::pointChanged, this, &PointsPanel::showSelected);
  connect(&m_target, &CurveTarget::refused, this, &PointsPanel::note);
}

void PointsPanel::makeLaws() {
  auto* column = new QVBoxLayout(m_laws);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addLayout(kindRows());
  auto* numbers = new QGridLayout;
  for (size_t i = 0; i < kMostCoefficients; ++i) {
    m_coefficients.push_back(new QLineEdit);
    m_coefficients[i]->setAlignment(Qt::AlignRight);
    numbers->addWidget(m_coefficients[i], 0, static_cast<int>(i));
    connect(m_coefficients[i], &QLineEdit::editingFinished, this, [this, i] { enterCoefficient(i); });
  }
  column->addLayout(numbers);
  column->addWidget(m_help);
  for (QLabel* text : {m_help, m_note}) {
    text->setFont(Theme::font(TextRole::Small));
    text->setWordWrap(true);
  }
  auto* row = new QHBoxLayout;
  row->addWidget(m_fit);
  row->addWidget(m_sample);
  row->addStretch(1);
  column->addLayout(row);
}

/// A button for each kind of response, and the formula of a law.
QGridLayout* PointsPanel::kindRows() {
  std::vector<std::string> kinds{"points", "constant"};
  kinds.insert(kinds.end(), lawNames().begin(), lawNames().end());
  auto* grid = new QGridLayout;
  grid->setVerticalSpacing(2);
  grid->setColumnStretch(1, 1);
  for (const std::string& kind : kinds) {
    auto* radio = new QRadioButton(kindLabel(kind));
    radio->setProperty(kKind, QString::fromStdString(kind));
    m_kinds->addButton(radio);
    auto* formula = new QLabel(formulaOf(kind).first);
    formula->setFont(Theme::font(TextRole::Small));
    formula->setForegroundRole(QPalette::PlaceholderText);
    formula->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    formula->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    grid->addWidget(radio, grid->rowCount(), 0);
    grid->addWidget(formula, grid->rowCount() - 1, 1);
  }
  return grid;
}

QString PointsPanel::noteText() const { return m_note->text(); }

void PointsPanel::note(const QString& text) {
  m_note->setText(text);
  m_note->setVisible(!text.isEmpty());
}

void PointsPanel::refresh() {
  const QSignalBlocker quiet(m_table);
  const Response response = m_target.response();
  const bool curve = response.kind == Response::Kind::Curve;
  const size_t count = curve ? response.points.size() : 0;
  m_table->setHorizontalHeaderLabels(
      {(m_target.track() ? QStringLiteral("Time, ") : QStringLiteral("Temperature, ")) + displayUnit(m_target.axis()),
       QStringLiteral("Value, ") + displayUnit(m_target.declaration()), QStringLiteral("Next")});
  m_table->setRowCount(static_cast<int>(count));
  for (size_t i = 0; i < count; ++i) {
    const QString texts[] = {formatField(m_target.axis(), response.points[i].x),
                             formatField(m_target.declaration(), response.points[i].y)};
    for (int k = 0; k < 2; ++k) {
      auto* item = new QTableWidgetItem(texts[k]);
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      m_table->setItem(static_cast<int>(i), k, item);
    }
    auto* way = new QTableWidgetItem(i + 1 < count ? labelOf(betweenOf(response, i)) : QStringLiteral("–"));
    way->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    way->setFlags(way->flags() & ~Qt::ItemIsEditable);
    way->setToolTip(QStringLiteral("How the curve goes to the next point: click to choose"));
    m_table->setItem(static_cast<int>(i), kNext, way);
  }
  showKind();
  showCoefficients();
  showSelected();
}

void PointsPanel::showKind() {
  const Response response = m_target.response();
  const QString kind = QString::fromStdString(kindOf(response));
  for (QAbstractButton* radio : m_kinds->buttons()) radio->setChecked(radio->property(kKind).toString() == kind);
  m_fit->setEnabled(response.kind == Response::Kind::Curve && response.points.size() > 1);
  m_sample->setEnabled(response.kind != Response::Kind::Curve);
  m_laws->setVisible(!m_target.track());
  for (QWidget* widget : std::initializer_list<QWidget*>{m_table, m_add, m_remove, m_thin, m_tolerance})
    widget->setVisible(response.kind == Response::Kind::Curve);
}

void PointsPanel::showCoefficients() {
  const Response response = m_target.response();
  const bool law = response.kind == Response::Kind::Law;
  const size_t count = law ? response.coefficients.size() : 0;
  m_help->setVisible(law);
  const auto [formula, meaning] = formulaOf(response.law);
  m_help->setText(meaning);
  for (size_t i = 0; i < m_coefficients.size(); ++i) {
    m_coefficients[i]->setVisible(i < count);
    if (i >= count) continue;
    m_coefficients[i]->setText(formatShort(response.coefficients[i], 7));
    m_coefficients[i]->setAccessibleName(QStringLiteral("Coefficient %1 of %2").arg(i + 1).arg(formula));
    m_coefficients[i]->setModified(false);
  }
}

void PointsPanel::showSelected() {
  const QSignalBlocker quiet(m_table);
  const int point = m_target.point();
  m_remove->setEnabled(point >= 0 && m_table->rowCount() > 1);
  if (point >= 0)
    m_table->setCurrentCell(point, std::max(0, m_table->currentColumn()));
  else
    m_table->setCurrentItem(nullptr);
}

void PointsPanel::enterCell(int row, int column) {
  Response next = m_target.response();
  if (next.kind != Response::Kind::Curve || static_cast<size_t>(row) >= next.points.size() || column == kNext) return;
  CurvePoint p = next.points[static_cast<size_t>(row)];
  const Typed typed = parseTyped(m_table->item(row, column)->text(),
                                 column == 0 ? m_target.axis() : m_target.declaration(), column == 0 ? p.x : p.y);
  if (typed.problem.isEmpty()) {
    (column == 0 ? p.x : p.y) = typed.value;
    movePoint(next, static_cast<size_t>(row), {p.x, p.y});
    if (m_target.set(next, QStringLiteral("Move point of ") + m_target.title())) return;
  } else {
    note(typed.problem);
  }
  refresh();
}

/// A menu of how the curve may go from a point to the next.
void PointsPanel::showWays(int row, int column) {
  const Response response = m_target.response();
  const auto piece = static_cast<size_t>(row);
  const bool toggle = m_target.declaration().kind == api::ParameterKind::Toggle;  // has no values between on and off
  if (column != kNext || piece + 1 >= response.points.size() || toggle) return;
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  for (const Between way : {Between::Step, Between::Linear, Between::Monotone, Between::Stated}) {
    QAction* action = menu->addAction(labelOf(way));
    action->setCheckable(true);
    action->setChecked(betweenOf(response, piece) == way);
    connect(action, &QAction::triggered, this, [this, piece, way] {
      Response next = m_target.response();
      if (piece + 1 >= next.points.size()) return;
      setBetween(next, piece, way);
      m_target.set(next, QStringLiteral("Way between points of ") + m_target.title());
    });
  }
  menu->popup(m_table->viewport()->mapToGlobal(m_table->visualItemRect(m_table->item(row, column)).bottomLeft()));
}

void PointsPanel::enterCoefficient(size_t index) {
  Response next = m_target.response();
  if (!m_coefficients[index]->isModified() || index >= next.coefficients.size()) return;
  m_coefficients[index]->setModified(false);
  const auto typed = parseNumber(m_coefficients[index]->text());
  if (!typed) note(QStringLiteral("This is not a number."));
  if (typed) next.coefficients[index] = *typed;
  const QString title = QStringLiteral("Law of ") + m_target.title();
  if (!typed || !m_target.set(next, title)) showCoefficients();
}

void PointsPanel::sample() {
  const Response response = m_target.response();
  if (response.kind == Response::Kind::Curve) return;
  const auto [cold, hot] = m_target.range();
  const api::ParameterDeclaration& d = m_target.declaration();
  Response curve = asPoints(response, cold, hot, d.scale == api::Scale::Logarithmic);
  for (CurvePoint& p : curve.points) p.y = std::clamp(p.y, d.hardMinimum, d.hardMaximum);
  m_target.set(curve, QStringLiteral("Sample %1 as points").arg(m_target.title()));
}

void PointsPanel::chooseKind(const std::string& kind) {
  const Response response = m_target.response();
  const QString name = m_target.title();
  if (kind == kindOf(response)) return;
  if (kind == "points") return sample();
  if (kind == "constant") {
    m_target.set(Response(response.at(m_target.temperature())), QStringLiteral("Constant ") + name);
  } else {
    const auto [cold, hot] = m_target.range();
    const auto points =
        response.kind == Response::Kind::Curve ? response.points : sampled(response, cold, hot, kLawPoints);
    const LawFit fit = fitLaw(kind, points, m_target.temperature());
    if (fit.problem.empty())
      m_target.set(fit.law, QStringLiteral("Law of ") + name);
    else
      note(QString::fromStdString(fit.problem));
  }
  showKind();
}

/// The one whose deviations, as shares of the values, have the least sum of squares. A value of 0 weighs as a very
/// small one: of itself every deviation is infinite.
void PointsPanel::fitNearest() {
  const Response response = m_target.response();
  if (response.kind != Response::Kind::Curve) return;
  double largest = 0;
  for (const CurvePoint& p : response.points) largest = std::max(largest, std::abs(p.y));
  LawFit best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::string& law : lawNames()) {
    LawFit fit = fitLaw(law, response.points, m_target.temperature());
    if (!fit.problem.empty()) continue;
    double sum = 0;
    for (const CurvePoint& p : response.points) {
      const double scale = std::max({std::abs(p.y), kLeastShare * largest, 1e-300});
      sum += std::pow((fit.law.at(p.x) - p.y) / scale, 2);
    }
    if (sum >= least) continue;
    least = sum;
    best = std::move(fit);
  }
  if (std::isfinite(least))
    m_target.set(best.law, QStringLiteral("Fit law to ") + m_target.title());
  else
    note(QStringLiteral("No law goes through these points."));
}

void PointsPanel::addPoint() {
  Response next = m_target.response();
  if (next.kind != Response::Kind::Curve) return;
  const std::vector<CurvePoint>& p = next.points;
  size_t behind = m_target.point() >= 0 ? static_cast<size_t>(m_target.point()) : p.size() - 1;
  double kelvin = p.back().x + (m_target.track() ? 1 : 10);
  if (behind + 1 < p.size()) kelvin = 0.5 * (p[behind].x + p[behind + 1].x);
  kelvin = m_target.snapped(kelvin);
  if (!ps::addPoint(next, {kelvin, next.at(kelvin)})) return;
  if (m_target.set(next, QStringLiteral("Add point to ") + m_target.title()))
    m_target.choosePoint(static_cast<int>(behind + 1));
}

void PointsPanel::removePoint() {
  Response next = m_target.response();
  if (m_target.point() < 0 || next.kind != Response::Kind::Curve) return;
  ps::removePoint(next, static_cast<size_t>(m_target.point()));
  m_target.set(next, QStringLiteral("Remove point of ") + m_target.title());
}

}  // namespace ps
