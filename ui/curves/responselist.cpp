// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/responselist.h"

#include "core/matter/material.h"
#include "ui/curves/curvetarget.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/rows/panelheader.h"
#include "ui/session/session.h"
#include "ui/session/swatches.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"

#include <QtCore/QSignalBlocker>
#include <QtGui/QDropEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QLabel>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QMenu>
#include <QtWidgets/QStyledItemDelegate>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace ps {
namespace {

constexpr int kRow = 40, kOther = 24;
constexpr double kSparkWidth = 70, kSparkHeight = 24, kLeastSpark = 24;  // narrower ones are not drawn
const QString kConstant = QStringLiteral("constant");
constexpr int kLeastWidth = 180;  // of a response's name beside its curve
constexpr int kKey = Qt::UserRole, kValue = Qt::UserRole + 1, kInstalled = Qt::UserRole + 2;

const api::ParameterDeclaration& declarationOf(const QString& key) {
  return propertyCatalogue()[static_cast<size_t>(propertyIndex(key.toStdString()))];
}

/// Up to five of its rows are seen, as high as they are where it is.
void fitRows(QListWidget& list) {
  const int row = std::max(kOther, list.sizeHintForRow(0));
  list.setFixedHeight(std::clamp(list.count(), 1, 5) * row + 4);
}

/// The phase that a property is of, where none of the matter is in it now: what the curve says there is of nothing.
QString absentPhase(const QString& key, const MaterialNow& now) {
  using api::Phase;
  static const std::map<QString, std::vector<Phase>> kOf{
      {QStringLiteral("solid"), {Phase::Solid, Phase::Melting}},
      {QStringLiteral("liquid"), {Phase::Liquid, Phase::Melting, Phase::Boiling}},
      {QStringLiteral("gas"), {Phase::Gas, Phase::Boiling}}};
  static const std::map<QString, QString> kNamed{{QStringLiteral("viscosity"), QStringLiteral("liquid")},
                                                 {QStringLiteral("yield_stress"), QStringLiteral("liquid")},
                                                 {QStringLiteral("youngs_modulus"), QStringLiteral("solid")}};
  const auto named = kNamed.find(key);
  const auto of = kOf.find(named == kNamed.end() ? key.section(QLatin1Char('_'), -1) : named->second);
  if (now.count == 0 || of == kOf.end()) return {};
  const bool any = std::any_of(of->second.begin(), of->second.end(),
                               [&](Phase phase) { return now.phases[static_cast<size_t>(phase)] > 0; });
  return any ? QString() : of->first;
}

Response responseFor(const CurveTarget& target, const std::string& key) {
  return responseOf(target.document().value({Owner::Material, target.material(), key}));
}

/// Name and value of a response, and its curve around the temperature that its matter has.
class ResponseDelegate final : public QStyledItemDelegate {
 public:
  ResponseDelegate(CurveTarget& target, QObject* parent) : QStyledItemDelegate(parent), m_target(target) {}
  double temperature = 293.15;  // K

  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {160, kRow}; }
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Theme& theme = Theme::current();
    const QRectF row = option.rect;
    if (option.state & QStyle::State_Selected)
      painter->fillRect(row, theme[Token::Selection]);
    else if (option.state & QStyle::State_MouseOver)
      painter->fillRect(row, theme[Token::Hover]);
    const QString name = index.data().toString(), key = index.data(kKey).toString();
    const Response response = responseFor(m_target, key.toStdString());
    const bool constant = response.kind == Response::Kind::Constant;
    // The name is whole before anything else is: "constant" stands below it, a curve takes what is left.
    const double full = row.width() - 18, left = full - textWidth(name, Theme::font(TextRole::Normal)) - 10;
    const double spark =
        constant ? textWidth(kConstant, Theme::font(TextRole::Small)) + 2 : std::min(kSparkWidth, left);
    const double text = full - spark - 6;
    const bool below = constant && spark > left;
    paintText(*painter, QRectF(row.left() + 10, row.top() + 4, below || spark < kLeastSpark ? full : text, 17),
              Qt::AlignLeft | Qt::AlignVCenter, name, Theme::font(TextRole::Normal), theme[Token::Text]);
    paintText(*painter, QRectF(row.left() + 10, row.top() + 20, text, 16), Qt::AlignLeft | Qt::AlignVCenter,
              index.data(kValue).toString(), Theme::font(TextRole::Small), theme[Token::Muted]);
    const QRectF box(row.right() - spark - 8, row.top() + (kRow - kSparkHeight) / 2, spark, kSparkHeight);
    if (constant)
      paintText(*painter, below ? QRectF(box.left(), row.top() + 20, spark, 16) : box,
                Qt::AlignRight | Qt::AlignVCenter, kConstant, Theme::font(TextRole::Small), theme[Token::Muted]);
    else if (spark >= kLeastSpark)
      paintSpark(*painter, box, response, declarationOf(key).scale == api::Scale::Logarithmic);
    if (option.state & QStyle::State_HasFocus) paintFocusRing(*painter, row, 4);
  }

 private:
  void paintSpark(QPainter& painter, const QRectF& box, const Response& response, bool logarithmic) const {
    const Theme& theme = Theme::current();
    paintBox(painter, box, theme[Token::Field], theme[Token::FieldEdge], 3);
    double cold = temperature - 100, hot = temperature + 100;
    if (response.kind == Response::Kind::Curve) {
      cold = std::min(cold, response.points.front().x);
      hot = std::max(hot, response.points.back().x);
    }
    cold = std::max(cold, 1.0);
    const auto level = [&](double kelvin) {
      const double value = response.at(kelvin);
      return logarithmic ? std::log(std::max(value, 1e-300)) : value;
    };
    const int samples = static_cast<int>(box.width()) - 4;
    std::vector<double> levels;
    levels.reserve(static_cast<size_t>(samples));
    for (int i = 0; i < samples; ++i) levels.push_back(level(cold + (hot - cold) * i / (samples - 1)));
    const auto [least, most] = std::minmax_element(levels.begin(), levels.end());
    const double low = *least, span = *most - low;
    const auto height = [&](double l) {
      return box.bottom() - 4 - (box.height() - 8) * (span > 0 ? std::clamp((l - low) / span, 0.0, 1.0) : 0.5);
    };
    QPolygonF line;
    for (int i = 0; i < samples; ++i) line << QPointF(box.left() + 2 + i, height(levels[static_cast<size_t>(i)]));
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(theme[Token::Curve], 1.35));
    painter.drawPolyline(line);
    const double x = box.left() + 2 + (samples - 1) * (temperature - cold) / (hot - cold);
    paintVerticalLine(painter, x, box.top() + 2, box.bottom() - 2, theme[Token::ControlEdge]);
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme[Token::Text]);
    painter.drawEllipse(QPointF(x, height(level(temperature))), 2.5, 2.5);
    painter.restore();
  }
  CurveTarget& m_target;
};

OtherMaterial otherOf(const QListWidgetItem& item) {
  return {item.data(kKey).toString().toStdString(), item.data(kInstalled).toBool()};
}

QListWidget* flatList(const QString& name) {
  auto* list = new QListWidget;
  list->setFrameShape(QFrame::NoFrame);
  list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list->setMouseTracking(true);
  list->setAccessibleName(name);
  return list;
}

}  // namespace

ResponseList::ResponseList(Session& session, CurveTarget& target, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_target(target),
      m_header(new PanelHeader),
      m_heading(new QLabel(QStringLiteral("Compare with"))),
      m_keyed(new QLabel(QStringLiteral("Keys over time"))),
      m_list(flatList(QStringLiteral("Responses"))),
      m_others(flatList(QStringLiteral("Compare with"))),
      m_tracks(flatList(QStringLiteral("Keys over time"))),
      m_add(new QToolButton) {
  setMinimumWidth(kLeastWidth);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 4);
  column->setSpacing(0);
  column->addWidget(m_header);
  column->addWidget(m_list, 1);
  for (const auto& [heading, list] : {std::pair(m_heading, m_others), std::pair(m_keyed, m_tracks)}) {
    heading->setFont(Theme::font(TextRole::Medium));
    heading->setContentsMargins(10, 8, 8, 4);
    column->addWidget(heading);
    column->addWidget(list);
    if (list != m_others) continue;
    auto* row = new QHBoxLayout;
    row->setContentsMargins(4, 0, 0, 0);
    row->addWidget(m_add);
    row->addStretch(1);
    column->addLayout(row);
  }
  makeAddMenu();
  m_list->setItemDelegate(new ResponseDelegate(target, this));
  connect(m_list, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
    if (item) m_target.choose({Owner::Material, m_target.material(), item->data(kKey).toString().toStdString()});
  });
  for (const QListWidget* list : {m_list, m_tracks})
    connect(list, &QListWidget::itemPressed, this, &ResponseList::chosen);
  connect(m_others, &QListWidget::itemChanged, this, &ResponseList::onCompared);
  connect(m_tracks, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
    const auto address = item ? Address::parse(item->data(kKey).toString().toStdString()) : std::nullopt;
    if (address) m_target.chooseTrack(*address);
  });
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<TracksChanged>(event)) rebuildTracks();
  });
  connect(&target, &CurveTarget::targetChanged, this, &ResponseList::rebuild);
  connect(&target, &CurveTarget::comparedChanged, this, &ResponseList::showCompared);
  connect(&target, &CurveTarget::responseChanged, this, &ResponseList::refresh);
  connect(&session.swatches(), &Swatches::arrived, m_header, qOverload<>(&QWidget::update));
  connect(&session, &Session::totalsDue, this, [this] {
    if (isVisible()) refresh();
  });
  rebuild();  // on the board it is made when there is a target already
}

/// What it did not follow while it was hidden; a board in a headset has larger rows.
void ResponseList::showEvent(QShowEvent*) {
  for (QListWidget* list : {m_others, m_tracks}) fitRows(*list);
  refresh();
}

void ResponseList::onCompared(QListWidgetItem* item) {
  m_target.compare(otherOf(*item), item->checkState() == Qt::Checked);
}

/// One that is installed alone stays in the list, to be taken in again.
void ResponseList::showCompared() {
  const QSignalBlocker quiet(m_others);
  for (const OtherMaterial& other : m_target.others()) addOther(other);
  for (int i = 0; i < m_others->count(); ++i) {
    QListWidgetItem* item = m_others->item(i);
    item->setCheckState(m_target.compared().contains(otherOf(*item)) ? Qt::Checked : Qt::Unchecked);
  }
  fitRows(*m_others);
  m_others->setVisible(m_others->count() > 0);
}

/// Made when it is opened: what is installed, and what is compared, changes.
void ResponseList::makeAddMenu() {
  m_add->setText(QStringLiteral("Add or drop a material"));
  m_add->setToolTip(QStringLiteral("Draws its curve beside this one. It does not come into the scene."));
  m_add->setIcon(icon(QStringLiteral("plus")));
  m_add->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  m_add->setPopupMode(QToolButton::InstantPopup);
  m_add->setFocusPolicy(Qt::TabFocus);
  auto* menu = new QMenu(m_add);
  m_add->setMenu(menu);
  connect(menu, &QMenu::aboutToShow, this, [this, menu] {
    menu->clear();
    for (const OtherMaterial& other : m_target.installed())
      menu->addAction(asButtonText(m_target.otherLabel(other)), this, [this, other] { m_target.compare(other, true); });
  });
  setAcceptDrops(true);
}

void ResponseList::dragEnterEvent(QDragEnterEvent* event) {
  if (draggedMaterial(*event->mimeData())) event->acceptProposedAction();
}

void ResponseList::dropEvent(QDropEvent* event) {
  const auto other = draggedMaterial(*event->mimeData());
  if (!other) return;
  event->acceptProposedAction();
  m_target.compare(*other, true);
}

void ResponseList::addOther(const OtherMaterial& other) {
  for (int i = 0; i < m_others->count(); ++i) {
    if (otherOf(*m_others->item(i)) == other) return;
  }
  auto* item = new QListWidgetItem(m_target.otherLabel(other), m_others);
  item->setData(kKey, QString::fromStdString(other.id));
  item->setData(kInstalled, other.installed);
  if (other.installed) item->setToolTip(QStringLiteral("Installed; not in the scene"));
}

void ResponseList::rebuild() {
  const QSignalBlocker quiet(m_list), quietToo(m_others);
  m_list->clear();
  m_others->clear();
  const api::ParameterList catalogue = propertyCatalogue();
  for (size_t i = 0; i < catalogue.count && !m_target.material().empty(); ++i) {
    if (catalogue[i].kind != api::ParameterKind::Response) continue;
    auto* item = new QListWidgetItem(QString::fromUtf8(catalogue[i].label), m_list);
    item->setData(kKey, QString::fromUtf8(catalogue[i].key));
    item->setToolTip(QString::fromUtf8(catalogue[i].help));
    if (!m_target.track() && m_target.address().key == catalogue[i].key) m_list->setCurrentItem(item);
  }
  showCompared();
  rebuildTracks();
  refresh();
}

void ResponseList::rebuildTracks() {
  const QSignalBlocker quiet(m_tracks);
  m_tracks->clear();
  const Document& document = m_target.document();
  for (const Track& track : document.project().tracks) {
    const auto address = Address::parse(track.parameter);
    if (!address || !document.keyDeclaration(*address)) continue;
    auto* item = new QListWidgetItem(document.trackTitle(*address), m_tracks);
    item->setData(kKey, QString::fromStdString(track.parameter));
    item->setToolTip(QStringLiteral("Edits its keys as a curve over time"));
    if (m_target.track() == *address) m_tracks->setCurrentItem(item);
  }
  fitRows(*m_tracks);
  for (QWidget* widget : std::initializer_list<QWidget*>{m_keyed, m_tracks}) widget->setVisible(m_tracks->count() > 0);
}

void ResponseList::refresh() {
  const Project& project = m_target.document().project();
  if (m_target.material().empty()) {
    m_header->setTexts({}, {}, {});
    return;
  }
  const MaterialNow now = m_target.now(0, 1);
  const double kelvin = m_target.temperature(now);
  static_cast<ResponseDelegate*>(m_list->itemDelegate())->temperature = kelvin;
  m_header->setTexts(m_target.materialLabel(),
                     QStringLiteral("%1 particles").arg(formatFixed(static_cast<double>(now.count))),
                     QStringLiteral("At %1").arg(formatValue(temperatureDeclaration(), kelvin)));
  m_header->setSwatch(
      m_session.swatches().painterOf(swatchOf(project, m_target.document().plugins(), m_target.material())));
  for (int i = 0; i < m_list->count(); ++i) {
    QListWidgetItem* item = m_list->item(i);
    const QString key = item->data(kKey).toString();
    const QString value = formatValue(declarationOf(key), responseFor(m_target, key.toStdString()).at(kelvin));
    const QString absent = absentPhase(key, now);
    item->setData(kValue, absent.isEmpty() ? value : QStringLiteral("no %1 now").arg(absent));
    const QString nothing = QStringLiteral("\n%1 at %2, where none of the matter is %3 now")
                                .arg(value, formatValue(temperatureDeclaration(), kelvin), absent);
    item->setToolTip(QStringLiteral("%1: %2\n%3")
                         .arg(item->text(), item->data(kValue).toString(), QString::fromUtf8(declarationOf(key).help)) +
                     (absent.isEmpty() ? QString() : nothing));
  }
  m_list->viewport()->update();
}

}  // namespace ps
