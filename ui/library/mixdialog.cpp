// SPDX-License-Identifier: Apache-2.0
#include "ui/library/mixdialog.h"

#include "core/base/error.h"
#include "core/matter/mixture.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "core/simulation/compile.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"
#include "ui/document/presets.h"
#include "ui/library/mixpreview.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/units.h"

#include <QtCore/QSignalBlocker>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QStyle>
#include <QtWidgets/QTreeWidget>

#include <algorithm>
#include <array>
#include <utility>

namespace ps {
namespace {

constexpr int kGap = 8, kEdge = 16, kLabelWidth = 110, kWidestColumn = 190;
constexpr int kLate = 200;  // ms
constexpr QSize kSize{860, 700};
constexpr const char* kLimits =
    "The rules know the parts alone, not how they act on each other: no eutectics (solder melts some 60 K lower than "
    "they say), no compounds, nothing that separates.";

constexpr api::ParameterDeclaration kShare{
    "share",
    "Share of the second",
    "w",
    "",
    api::ParameterKind::Number,
    api::Scale::Linear,
    0.5,
    0,
    1,
    0,
    1,
    "%",
    100,
    0,
    "",
    "",
    "How much of the second there is, by mass; at both ends one of the two is left as it is.",
    "bronze is copper with 12 % of tin",
    ""};

}  // namespace

MixDialog::MixDialog(MaterialLibrary& library, Session& session, Selection& selection, QWidget* parent)
    : QDialog(parent),
      m_library(library),
      m_session(session),
      m_selection(selection),
      m_grid(new QGridLayout(this)),
      m_first(new QComboBox),
      m_second(new QComboBox),
      m_note(new QLabel),
      m_preview(new MixPreview(session.swatches())),
      m_table(new QTreeWidget) {
  setAttribute(Qt::WA_DeleteOnClose);
  m_grid->setContentsMargins(kEdge, kEdge, kEdge, kEdge);
  m_grid->setSpacing(kGap);
  m_grid->setColumnMinimumWidth(0, kLabelWidth);
  m_grid->setColumnStretch(1, 1);
  resize(kSize);
  m_late.setSingleShot(true);
  m_late.setInterval(kLate);
  connect(&m_late, &QTimer::timeout, this, &MixDialog::readSources);
  connect(&session.document(), &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event) || isGone()) return reject();
    const auto* parameter = std::get_if<ParameterChanged>(&event);
    const bool follows =
        std::holds_alternative<MaterialsChanged>(event) || (parameter && parameter->address.owner == Owner::Material);
    if (follows && m_changed.empty()) m_late.start();
  });
}

MixDialog::MixDialog(MaterialLibrary& library, Session& session, Selection& selection, const QString& first,
                     const QString& second, QWidget* parent)
    : MixDialog(library, session, selection, parent) {
  setWindowTitle(QStringLiteral("Mix two materials"));
  addSources();
  for (QComboBox* box : {m_first, m_second}) {
    for (const Source& source : m_sources) box->addItem(source.label);
  }
  m_second->setCurrentIndex(std::min(1, m_second->count() - 1));
  addRow(QStringLiteral("First"), m_first);
  addRow(QStringLiteral("Second"), m_second);
  addShare(0.5);
  m_name = new QLineEdit;
  m_name->setPlaceholderText(QStringLiteral("What it is made of"));
  addRow(QStringLiteral("Name"), m_name);
  addResult();
  addButtons();
  chooseParts(first, second);
  for (QComboBox* box : {m_first, m_second}) connect(box, &QComboBox::currentIndexChanged, this, &MixDialog::refresh);
  connect(&library, &MaterialLibrary::changed, &m_late, qOverload<>(&QTimer::start));
  refresh();
}

MixDialog::MixDialog(MaterialLibrary& library, Session& session, Selection& selection, const std::string& material,
                     QWidget* parent)
    : MixDialog(library, session, selection, parent) {
  m_changed = material;
  for (const SceneMaterial& own : session.document().project().materials) {
    if (own.id != material) continue;
    if (!own.mixture) continue;
    setWindowTitle(QStringLiteral("Change the mixture “%1”").arg(QString::fromStdString(shownName(own))));
    const Mixture& mixture = *own.mixture;
    for (const auto& [box, part] : {std::pair(m_first, mixture.first), std::pair(m_second, mixture.second)}) {
      m_sources.push_back({QString::fromStdString(part.label), part});
      box->addItem(m_sources.back().label);
      box->setEnabled(false);
      box->setToolTip(QStringLiteral("With the values that it had when the two were mixed."));
    }
    addRow(QStringLiteral("First"), m_first);
    addRow(QStringLiteral("Second"), m_second);
    addShare(mixture.share);
    addResult();
    addButtons();
    refresh();
  }
}

/// All that can be had, and the scene's own with the values that they have there.
void MixDialog::addSources() {
  for (const LibraryEntry& entry : m_library.entries()) {
    Material values = entry.values;
    values.label = entry.label.toStdString();
    m_sources.push_back({entry.label, partOf(values), entry.key()});
  }
  const Project& project = m_session.document().project();
  EvaluatedMaterials evaluated;
  for (const SceneMaterial& own : project.materials) {
    try {
      const Material values = compileMaterial(project, own, *m_session.plugins(), evaluated);
      m_sources.push_back({QStringLiteral("%1, as it is in the scene").arg(QString::fromStdString(values.label)),
                           partOf(values), QStringLiteral("scene:") + QString::fromStdString(own.id)});
    } catch (const Error&) {
      continue;  // what is broken in the scene is told there
    }
  }
}

bool MixDialog::Source::operator==(const Source& other) const {
  return key == other.key && label == other.label && part.label == other.part.label &&
         part.properties == other.part.properties && part.adheresTo == other.part.adheresTo;
}

/// What is chosen stays so, with the values that it had where it is gone. The library reads its folder again whenever a
/// file comes or goes there, which may be none of a material: what is the same then is not filled in anew.
void MixDialog::readSources() {
  const bool begins = m_sources.empty();
  std::array<Source, 2> kept;
  if (!begins) kept = {chosen(*m_first), chosen(*m_second)};
  const std::vector<Source> before = std::exchange(m_sources, {});
  addSources();
  if (m_sources == before) return;  // also before the library has come
  const std::array<QComboBox*, 2> boxes{m_first, m_second};
  std::array<int, 2> places{0, std::min(1, static_cast<int>(m_sources.size()) - 1)};
  for (size_t k = 0; !begins && k < boxes.size(); ++k) {
    places[k] = indexOf(kept[k].key);
    if (places[k] >= 0) continue;
    places[k] = static_cast<int>(m_sources.size());
    kept[k].label.replace(QStringLiteral("as it is in"), QStringLiteral("as it was in"));
    m_sources.push_back(kept[k]);
  }
  for (size_t k = 0; k < boxes.size(); ++k) {
    const QSignalBlocker quiet(boxes[k]);
    boxes[k]->clear();
    for (const Source& source : m_sources) boxes[k]->addItem(source.label);
    boxes[k]->setCurrentIndex(places[k]);
  }
  refresh();
}

bool MixDialog::isGone() const {
  const auto& all = m_session.document().project().materials;
  return !m_changed.empty() && std::none_of(all.begin(), all.end(), [&](const SceneMaterial& each) {
    return each.id == m_changed && each.mixture;
  });
}

int MixDialog::indexOf(const QString& key) const {
  const auto found =
      std::find_if(m_sources.begin(), m_sources.end(), [&](const Source& each) { return each.key == key; });
  return found == m_sources.end() ? -1 : static_cast<int>(found - m_sources.begin());
}

const MixDialog::Source& MixDialog::chosen(const QComboBox& box) const {
  return m_sources[static_cast<size_t>(std::max(0, box.currentIndex()))];
}

void MixDialog::addRow(const QString& label, QWidget* field) {
  auto* words = new QLabel(label);
  words->setBuddy(field);
  field->setAccessibleName(label);
  const int line = m_grid->rowCount();
  m_grid->addWidget(words, line, 0);
  m_grid->addWidget(field, line, 1);
}

void MixDialog::addShare(double share) {
  RowModel model;
  model.key = QStringLiteral("share");
  model.declaration = kShare;
  model.value = share;
  model.defaultValue = share;
  m_share = new ParameterRow(model);
  m_grid->addWidget(m_share, m_grid->rowCount(), 0, 1, 2);
  const auto follow = [this](const QString&, const Value&) { refresh(); };
  connect(m_share, &ParameterRow::valueEdited, this, follow);
  connect(m_share, &ParameterRow::editingFinished, this, follow);
}

void MixDialog::addResult() {
  m_note->setTextFormat(Qt::PlainText);
  m_note->setWordWrap(true);
  m_grid->addWidget(m_note, m_grid->rowCount(), 0, 1, 2);
  m_grid->addWidget(m_preview, m_grid->rowCount(), 0, 1, 2);
  m_table->setRootIsDecorated(false);
  m_table->setAllColumnsShowFocus(true);
  m_table->setWordWrap(true);
  m_table->setSelectionMode(QAbstractItemView::NoSelection);
  m_table->setAccessibleName(QStringLiteral("Properties of the mixture and their rules"));
  m_table->setColumnCount(5);
  const int line = m_grid->rowCount();
  m_grid->addWidget(m_table, line, 0, 1, 2);
  m_grid->setRowStretch(line, 1);
}

void MixDialog::addButtons() {
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  const auto add = [&](const QString& text, auto act, bool primary) {
    auto* button = new QPushButton(text);
    button->setAutoDefault(false);
    if (primary) {
      button->setProperty("primary", true);
      button->setDefault(true);
    }
    buttons->addWidget(button);
    connect(button, &QPushButton::clicked, this, act);
    return button;
  };
  add(QStringLiteral("Cancel"), &QDialog::reject, false);
  if (m_changed.empty()) {
    m_makes.push_back(add(QStringLiteral("Save as preset"), &MixDialog::keepAsPreset, false));
    m_makes.push_back(add(QStringLiteral("Add to the scene"), &MixDialog::addToScene, true));
  } else {
    m_makes.push_back(add(QStringLiteral("Change"), &MixDialog::change, true));
  }
  m_grid->addLayout(buttons, m_grid->rowCount(), 0, 1, 2);
}

bool MixDialog::chooseParts(const QString& first, const QString& second) {
  const int one = indexOf(first), other = indexOf(second);
  if (one >= 0) m_first->setCurrentIndex(one);
  if (other >= 0) m_second->setCurrentIndex(other);
  return one >= 0 && other >= 0;
}

Mixture MixDialog::mixture() const {
  if (m_sources.empty()) return {};
  if (!m_changed.empty()) return {m_share->number(), m_sources[0].part, m_sources[1].part, {}};
  return {m_share->number(), chosen(*m_first).part, chosen(*m_second).part, {}};
}

QString MixDialog::name() const {
  const QString typed = m_name ? m_name->text().trimmed() : QString();
  return typed.isEmpty() ? QString::fromStdString(mixtureText(mixture())) : typed;
}

void MixDialog::refresh() {
  const Mixture wanted = mixture();
  const Material first = materialOf(wanted.first), second = materialOf(wanted.second);
  m_problem = QString::fromStdString(whyNot(wanted));
  m_note->setProperty("role", m_problem.isEmpty() ? "muted" : "warning");
  m_note->setText(m_problem.isEmpty() ? QString::fromLatin1(kLimits) : m_problem);
  m_note->style()->unpolish(m_note);
  m_note->style()->polish(m_note);
  for (QPushButton* button : m_makes) button->setEnabled(m_problem.isEmpty());
  m_table->clear();
  m_table->setHeaderLabels({QStringLiteral("At ") + temperatureText(kRoom, 0), QString::fromStdString(first.label),
                            QString::fromStdString(second.label), QStringLiteral("Mixture"), QStringLiteral("Rule")});
  if (!m_problem.isEmpty()) return m_preview->showMaterials(first, second, nullptr);
  const Material whole = materialOf(wanted);
  m_preview->showMaterials(first, second, &whole);
  fillTable(first, second, whole);
}

void MixDialog::fillTable(const Material& first, const Material& second, const Material& mixture) {
  const api::ParameterList catalogue = propertyCatalogue();
  for (size_t k = 0; k < catalogue.count; ++k) {
    const api::ParameterDeclaration& declaration = catalogue[k];
    if (!mixture.properties.contains(declaration.key)) continue;
    QStringList cells{QString::fromUtf8(declaration.label)};
    QString assumed;
    for (const Material* part : {&first, &second}) {
      const bool stated = part->properties.contains(declaration.key);
      cells << formatValue(declaration, valueOf(*part, declaration.key, kRoom));
      if (stated) continue;
      cells.back() += QStringLiteral(" (usual)");
      assumed =
          QStringLiteral("\n%1 does not state it: the usual value stands in.").arg(QString::fromStdString(part->label));
    }
    const QString rule = QString::fromUtf8(std::string(mixtureRule(declaration.key)).c_str());
    cells << formatValue(declaration, valueOf(mixture, declaration.key, kRoom)) << rule;
    auto* row = new QTreeWidgetItem(m_table, cells);
    for (int column = 0; column < cells.size(); ++column) row->setToolTip(column, cells[column] + assumed);
    row->setToolTip(0, QString::fromUtf8(declaration.help));
  }
  QHeaderView* header = m_table->header();
  header->setStretchLastSection(true);
  for (int column = 0; column < 4; ++column) {
    m_table->resizeColumnToContents(column);
    m_table->setColumnWidth(column, std::min(m_table->columnWidth(column), kWidestColumn));
  }
}

SceneMaterial MixDialog::made() const {
  SceneMaterial material = mixedMaterial(mixture(), *m_session.plugins());
  material.id = "mixture";
  material.label = name().toStdString();
  return material;
}

void MixDialog::addToScene() {
  m_selection.pickMaterial(addPreset(m_session.document(), made()));
  accept();
}

void MixDialog::keepAsPreset() {
  m_library.savePreset(made(), name());
  accept();
}

/// One step. What was changed by hand since it was mixed stays.
void MixDialog::change() {
  Document& document = m_session.document();
  const std::vector<SceneMaterial>& before = document.project().materials;
  std::vector<SceneMaterial> after = before;
  for (SceneMaterial& material : after) {
    if (material.id == m_changed) material = withShare(material, m_share->number(), *m_session.plugins());
  }
  document.undoStack().push(new MaterialsCommand(document, before, after, QStringLiteral("changing the mixture")));
  accept();
}

}  // namespace ps
