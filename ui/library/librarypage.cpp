// SPDX-License-Identifier: Apache-2.0
#include "ui/library/librarypage.h"

#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/presets.h"
#include "ui/library/flow.h"
#include "ui/library/materialcard.h"
#include "ui/library/phaseview.h"
#include "ui/rows/filterfield.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/swatches.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"

#include <QtCore/QEvent>
#include <QtCore/QMimeData>
#include <QtCore/QSignalBlocker>
#include <QtGui/QDrag>
#include <QtGui/QPainter>
#include <QtWidgets/QButtonGroup>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QTreeWidget>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace ps {
namespace {

constexpr int kKeyRole = kEntryRole + 1;  // whose card it is, whatever others come
constexpr const char* kTag = "tag";       // property of a chip; "": all
constexpr int kPicture = 72;              // px
constexpr int kWidestColumn = 170;        // px, of a name
constexpr double kDiffers = 1.1;          // factor from which two values are marked as different

/// Cards that can be dragged onto bodies, of the view too, which takes the page's place meanwhile.
class CardList : public QListWidget {
 public:
  /// `carry(data)` lasts as long as the drag.
  CardList(const MaterialLibrary& library, std::function<void(QMimeData*)> carry)
      : m_library(library), m_carry(std::move(carry)) {}

 protected:
  QMimeData* mimeData(const QList<QListWidgetItem*>& items) const override {
    const auto index =
        items.isEmpty() ? m_library.entries().size() : static_cast<size_t>(items.front()->data(kEntryRole).toInt());
    if (index >= m_library.entries().size()) return nullptr;
    const LibraryEntry& entry = m_library.entries()[index];
    auto* carried = new QMimeData;
    if (entry.file.isEmpty()) {
      carried->setData(QLatin1String(kInstalledMime), QByteArray::fromStdString(entry.material.base));
    } else {
      carryPreset(*carried, entry.material);
    }
    return carried;
  }
  /// The card under the pointer, also where several are chosen.
  void startDrag(Qt::DropActions) override {
    if (QMimeData* carried = currentItem() ? mimeData({currentItem()}) : nullptr) m_carry(carried);
  }

 private:
  const MaterialLibrary& m_library;
  const std::function<void(QMimeData*)> m_carry;
};

}  // namespace

/// A material's picture, larger than on its card; hidden without a material.
class SwatchView : public QWidget {
 public:
  explicit SwatchView(Swatches& swatches) : m_swatches(swatches) {
    setFixedSize(kPicture, kPicture);
    connect(&swatches, &Swatches::arrived, this, qOverload<>(&QWidget::update));
  }
  void showMatter(const LibraryEntry* entry) {
    setVisible(entry != nullptr);
    if (!entry) return;
    m_swatch = swatchOf(*entry);
    setAccessibleName(entry->label);
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    paintSwatch(painter, rect(), m_swatch, m_swatches);
  }

 private:
  Swatches& m_swatches;
  Swatch m_swatch;
};

LibraryPage::LibraryPage(MaterialLibrary& library, Session& session, Selection& selection, QWidget* parent)
    : QWidget(parent),
      m_library(library),
      m_session(session),
      m_selection(selection),
      m_search(new QLineEdit),
      m_name(new QLineEdit),
      m_words(new QLineEdit),
      m_nothing(new NothingFound(*m_search)),
      m_cards(new CardList(library, [this](QMimeData* carried) { carry(carried); })),
      m_table(new QTreeWidget),
      m_title(new QLabel),
      m_about(new QLabel),
      m_of(new QLabel),
      m_hint(new QLabel),
      m_add(new QPushButton(QStringLiteral("Add to the scene"))),
      m_export(new QPushButton(QStringLiteral("Export…"))),
      m_remove(new QPushButton(QStringLiteral("Remove preset"))),
      m_save(new QPushButton(QStringLiteral("Save as preset"))),
      m_mixture(new QPushButton(QStringLiteral("Change the mixture…"))),
      m_phases(new PhaseView) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);  // no page makes the window wider while another shows
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 12, 16, 12);
  row->setSpacing(16);
  row->addWidget(makeLeft(), 1);
  row->addWidget(makeRight(), 1);
  connect(&library, &MaterialLibrary::changed, this, &LibraryPage::refresh);
  connect(&selection, &Selection::materialChanged, this, &LibraryPage::showScene);
  refresh();
  showScene();
}

QWidget* LibraryPage::makeLeft() {
  auto* left = new QWidget;
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(10);
  auto* head = new QHBoxLayout;
  auto* title = new QLabel(QStringLiteral("Materials"));
  title->setFont(Theme::font(TextRole::Title));
  head->addWidget(title);
  head->addStretch(1);
  m_search->setObjectName(QStringLiteral("psFilter"));
  m_search->setPlaceholderText(QStringLiteral("Name, or what it is"));
  m_search->setAccessibleName(QStringLiteral("Search materials"));
  m_search->setFixedWidth(190);
  head->addWidget(m_search);
  column->addLayout(head);
  m_chips = new Flow(6);
  column->addLayout(m_chips);
  m_cards->setItemDelegate(new MaterialCard(m_library, m_session.swatches(), m_cards));
  m_cards->setViewMode(QListView::IconMode);
  m_cards->setResizeMode(QListView::Adjust);
  m_cards->setMovement(QListView::Static);
  m_cards->setDragEnabled(true);  // setMovement() has taken it away
  m_cards->setUniformItemSizes(true);
  m_cards->setMouseTracking(true);
  m_cards->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_cards->setAccessibleName(QStringLiteral("Materials"));
  column->addWidget(m_cards, 1);
  column->addWidget(m_nothing, 1);
  m_hint->setProperty("role", "muted");
  m_hint->setWordWrap(true);
  column->addWidget(m_hint);
  connect(&m_session.swatches(), &Swatches::arrived, m_cards->viewport(), qOverload<>(&QWidget::update));
  connect(m_search, &QLineEdit::textChanged, this, &LibraryPage::filter);
  connect(m_search, &QLineEdit::returnPressed, this, [this] {
    if (!shown().isEmpty()) addToScene();
  });
  connect(m_nothing, &QLabel::linkActivated, this, [this] { setTag({}); });  // which hides some, too
  connect(m_cards, &QListWidget::itemSelectionChanged, this, &LibraryPage::showChosen);
  connect(m_cards, &QListWidget::itemActivated, this, &LibraryPage::addToScene);
  return left;
}

QWidget* LibraryPage::makeRight() {
  auto* right = new QWidget;
  auto* column = new QVBoxLayout(right);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  auto* head = new QHBoxLayout;
  m_title->setFont(Theme::font(TextRole::Heading));
  m_title->setWordWrap(true);  // mixtures have long names
  auto* import = new QPushButton(QStringLiteral("Import…"));
  auto* back = new QPushButton(QStringLiteral("Back to the scene"));
  head->addWidget(m_title, 1);
  head->addWidget(import);
  head->addWidget(back);
  column->addLayout(head);
  m_about->setWordWrap(true);
  m_about->setProperty("role", "text2");
  auto* shown = new QHBoxLayout;
  shown->setSpacing(8);
  for (SwatchView*& picture : m_pictures) {
    picture = new SwatchView(m_session.swatches());
    shown->addWidget(picture, 0, Qt::AlignTop);
  }
  shown->addWidget(m_about, 1);
  column->addLayout(shown);
  column->addWidget(m_phases);
  m_words->setPlaceholderText(QStringLiteral("Tags, with commas between them"));
  m_words->setAccessibleName(QStringLiteral("Tags"));
  m_words->setToolTip(QStringLiteral("Words by which this preset is found, with commas between them: food, kitchen"));
  column->addWidget(m_words);
  m_table->setRootIsDecorated(false);
  m_table->setAllColumnsShowFocus(true);
  m_table->setSelectionMode(QAbstractItemView::NoSelection);
  m_table->setAccessibleName(QStringLiteral("Properties"));
  column->addWidget(m_table, 1);
  auto* act = new QHBoxLayout;
  m_add->setProperty("primary", true);
  for (QPushButton* button : {m_add, m_export, m_remove}) act->addWidget(button);
  act->addStretch(1);
  auto* mix = new QPushButton(QStringLiteral("Mix…"));
  mix->setToolTip(QStringLiteral("Makes an alloy or mixture of two materials, by stated rules."));
  act->addWidget(mix);
  column->addLayout(act);
  auto* keep = new QHBoxLayout;
  m_name->setPlaceholderText(QStringLiteral("Name"));
  m_name->setAccessibleName(QStringLiteral("Name of the preset"));
  m_name->setToolTip(m_name->accessibleName());
  keep->addWidget(m_of);
  keep->addWidget(m_name, 1);
  keep->addWidget(m_save);
  keep->addWidget(m_mixture);
  column->addLayout(keep);
  connect(import, &QPushButton::clicked, this, &LibraryPage::importWanted);
  connect(back, &QPushButton::clicked, this, &LibraryPage::closeRequested);
  connect(mix, &QPushButton::clicked, this, [this] {
    QStringList keys;
    for (const LibraryEntry* entry : chosen()) keys << entry->key();
    Q_EMIT mixWanted(keys.value(0), keys.value(1));
  });
  connectChosen();
  return right;
}

void LibraryPage::connectChosen() {
  connect(m_add, &QPushButton::clicked, this, &LibraryPage::addToScene);
  connect(m_export, &QPushButton::clicked, this, [this] {
    if (const auto some = chosen(); !some.empty()) Q_EMIT exportWanted(*some.front());
  });
  connect(m_remove, &QPushButton::clicked, this, [this] {
    if (const auto some = chosen(); !some.empty()) m_library.removePreset(*some.front());
  });
  connect(m_words, &QLineEdit::editingFinished, this, [this] {
    if (const auto some = chosen(); some.size() == 1 && m_words->isModified())
      m_library.setTags(*some.front(), m_words->text());
    m_words->setModified(false);
  });
  connect(m_mixture, &QPushButton::clicked, this, [this] { Q_EMIT mixtureWanted(m_selection.material()); });
  const auto save = [this] {
    for (const SceneMaterial& material : m_session.document().project().materials)
      if (material.id == m_selection.material()) return m_library.savePreset(material, m_name->text());
  };
  connect(m_save, &QPushButton::clicked, this, save);
  connect(m_name, &QLineEdit::returnPressed, this, save);
}

/// Cards anew; what was chosen stays chosen.
void LibraryPage::refresh() {
  QStringList before;
  for (const QListWidgetItem* item : m_cards->selectedItems()) before << item->data(kKeyRole).toString();
  m_hint->setText(
      QStringLiteral("The bar shows solid, liquid and gas from %1 to %2 under the air's usual pressure; its "
                     "line is at %3. Ctrl+click compares two. Drag a card onto a body, which becomes of it.")
          .arg(temperatureText(kColdest, 0), temperatureText(kHottest, 0), temperatureText(kRoom, 0)));
  const QSignalBlocker quiet(m_cards);  // what is chosen shows below, once
  m_cards->clear();
  for (size_t i = 0; i < m_library.entries().size(); ++i) {
    const LibraryEntry& entry = m_library.entries()[i];
    auto* item = new QListWidgetItem(entry.label, m_cards);
    item->setData(kEntryRole, static_cast<int>(i));
    item->setToolTip(QStringLiteral("%1: %2\n%3").arg(entry.label, transitionsText(entry), entry.about).trimmed());
    item->setData(kKeyRole, entry.key());
    item->setSelected(before.contains(entry.key()));
  }
  if (before.isEmpty() && m_cards->count() > 0) m_cards->setCurrentRow(0);
  delete m_tags;
  m_tags = new QButtonGroup(this);
  while (QLayoutItem* item = m_chips->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  const QStringList tags = m_library.tags();
  if (!tags.contains(m_tag)) m_tag.clear();
  for (const QString& tag : QStringList(QString()) + tags) {
    const QString all = QStringLiteral("All %1").arg(m_library.entries().size());
    auto* chip = new QPushButton(asButtonText(tag.isEmpty() ? all : tag));
    chip->setObjectName(QStringLiteral("psChip"));
    chip->setProperty(kTag, tag);
    chip->setCheckable(true);
    m_tags->addButton(chip);
    connect(chip, &QPushButton::clicked, this, [this, tag] { setTag(tag); });
    m_chips->addWidget(chip);
  }
  setTag(m_tag);
  showChosen();
}

void LibraryPage::setTag(const QString& tag) {
  m_tag = tag;
  for (QAbstractButton* chip : m_tags->buttons()) {
    if (chip->property(kTag).toString() == tag) chip->setChecked(true);
  }
  filter();
}

void LibraryPage::beginSearch(bool anew) {
  if (anew) m_search->clear();
  m_search->setFocus();
  m_search->selectAll();
}

void LibraryPage::filter() {
  for (int i = 0; i < m_cards->count(); ++i) {
    QListWidgetItem* item = m_cards->item(i);
    const LibraryEntry& entry = m_library.entries()[static_cast<size_t>(item->data(kEntryRole).toInt())];
    const QString all = entry.label + QLatin1Char(' ') + entry.about + QLatin1Char(' ') + entry.tags.join(u' ');
    item->setHidden(!all.contains(m_search->text().trimmed(), Qt::CaseInsensitive) ||
                    (!m_tag.isEmpty() && !entry.tags.contains(m_tag)));
  }
  m_nothing->standFor(*m_cards, !shown().isEmpty(), m_tag);
  // What is chosen is what one sees: it would be added, unseen, in place of what was looked for.
  const QList<QListWidgetItem*> selected = m_cards->selectedItems();
  if (std::any_of(selected.begin(), selected.end(), [](const QListWidgetItem* item) { return !item->isHidden(); }))
    return;
  for (int i = 0; i < m_cards->count(); ++i)
    if (!m_cards->item(i)->isHidden()) return m_cards->setCurrentRow(i, QItemSelectionModel::ClearAndSelect);
}

QStringList LibraryPage::shown() const {
  QStringList labels;
  for (int i = 0; i < m_cards->count(); ++i)
    if (!m_cards->item(i)->isHidden()) labels << m_cards->item(i)->text();
  return labels;
}

std::vector<const LibraryEntry*> LibraryPage::chosen() const {
  std::vector<const LibraryEntry*> some;
  for (const QListWidgetItem* item : m_cards->selectedItems()) {
    const auto index = static_cast<size_t>(item->data(kEntryRole).toInt());
    if (some.size() < 2 && index < m_library.entries().size()) some.push_back(&m_library.entries()[index]);
  }
  return some;
}

QStringList LibraryPage::compared() const {
  QStringList labels;
  for (const QListWidgetItem* item : m_cards->selectedItems().mid(0, 2)) labels << item->text();
  return labels;
}

void LibraryPage::choose(const QString& label, bool beside) {
  if (!beside) m_cards->clearSelection();
  for (QListWidgetItem* item : m_cards->findItems(label, Qt::MatchExactly)) item->setSelected(true);
}

/// Properties of one, or of two: what differs by a tenth and more is marked.
void LibraryPage::showChosen() {
  const std::vector<const LibraryEntry*> some = chosen();
  m_table->clear();
  m_table->setColumnCount(static_cast<int>(some.size()) + 1);
  QStringList head{QStringLiteral("At ") + temperatureText(kRoom, 0)};
  for (const LibraryEntry* entry : some) head << entry->label;
  m_table->setHeaderLabels(head);
  m_title->setText(head.mid(1).join(QStringLiteral(" and ")));
  m_about->setText(some.size() == 1 ? some.front()->about : QString());
  for (size_t k = 0; k < m_pictures.size(); ++k) m_pictures[k]->showMatter(k < some.size() ? some[k] : nullptr);
  m_phases->showMaterials(some);
  for (QPushButton* button : {m_add, m_export}) button->setEnabled(!some.empty());
  m_remove->setVisible(some.size() == 1 && !some.front()->file.isEmpty());
  showTags();
  const api::ParameterList catalogue = propertyCatalogue();
  for (size_t at = 0; at < catalogue.count; ++at) {
    const api::ParameterDeclaration& declaration = catalogue[at];
    if (std::none_of(some.begin(), some.end(),
                     [&](const LibraryEntry* entry) { return entry->values.properties.contains(declaration.key); }))
      continue;
    QStringList cells{QString::fromUtf8(declaration.label)};
    std::vector<double> numbers;
    for (const LibraryEntry* entry : some) {
      numbers.push_back(valueOf(entry->values, declaration.key, kRoom));
      cells << formatValue(declaration, numbers.back());
    }
    auto* row = new QTreeWidgetItem(m_table, cells);
    row->setToolTip(0, QString::fromUtf8(declaration.help));
    const bool differs =
        numbers.size() == 2 && numbers[0] != numbers[1] &&
        !(numbers[0] * numbers[1] > 0 && std::max(numbers[0] / numbers[1], numbers[1] / numbers[0]) < kDiffers);
    for (int k = 1; differs && k < 3; ++k) row->setForeground(k, Theme::current()[Token::Accent]);
  }
  m_table->header()->setStretchLastSection(false);
  m_table->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int k = 1; k < m_table->columnCount(); ++k) {
    m_table->header()->setSectionResizeMode(k, QHeaderView::Interactive);
    m_table->resizeColumnToContents(k);
    m_table->setColumnWidth(k, std::min(m_table->columnWidth(k), kWidestColumn));
  }
}

/// Of one preset, whose file they are written to; what somebody is typing stays.
void LibraryPage::showTags() {
  const std::vector<const LibraryEntry*> some = chosen();
  const bool one = some.size() == 1 && !some.front()->file.isEmpty();
  const QString of = one ? m_cards->selectedItems().front()->data(kKeyRole).toString() : QString();
  const bool stays = m_words->isModified() && of == m_wordsOf;
  m_wordsOf = of;
  m_words->setVisible(one);
  if (stays) return;
  QStringList words;
  for (const std::string& tag : one ? some.front()->material.tags : std::vector<std::string>{})
    words << QString::fromStdString(tag);
  m_words->setText(words.join(QStringLiteral(", ")));
}

/// The scene's material that would become a preset.
void LibraryPage::showScene() {
  const std::string id = m_selection.material();
  const QString label = ownerLabel(m_session.document().project(), {Owner::Material, id, {}});
  const QString shown = m_of->fontMetrics().elidedText(label, Qt::ElideRight, kWidestColumn);
  m_of->setText(id.empty() ? QStringLiteral("The scene has no material")
                           : QStringLiteral("“%1” of the scene as").arg(shown));
  m_of->setToolTip(label);
  m_save->setEnabled(!id.empty());
  m_name->setEnabled(!id.empty());
  const auto& materials = m_session.document().project().materials;
  m_mixture->setVisible(
      std::any_of(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == id && m.mixture; }));
}

void LibraryPage::addToScene() {
  std::string last;
  const auto entries = chosen();
  Document& document = m_session.document();
  if (entries.size() > 1) document.undoStack().beginMacro(QStringLiteral("adding %1 materials").arg(entries.size()));
  for (const LibraryEntry* entry : entries)
    last = entry->file.isEmpty() ? document.addMaterial(entry->material.base) : addPreset(document, entry->material);
  if (entries.size() > 1) document.undoStack().endMacro();
  if (!last.empty()) m_selection.pickMaterial(last);
}

void LibraryPage::carry(QMimeData* carried) {
  auto* way = new QDrag(m_cards);  // goes by itself
  way->setMimeData(carried);
  Q_EMIT carrying();
  const bool taken = way->exec(Qt::CopyAction) != Qt::IgnoreAction;
  if (!taken) Q_EMIT broughtBack();
}

void LibraryPage::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), Theme::current()[Token::Panel]);
}

void LibraryPage::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) showChosen();
}

}  // namespace ps
