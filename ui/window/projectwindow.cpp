// SPDX-License-Identifier: Apache-2.0
#include "ui/window/projectwindow.h"

#include "ui/document/document.h"
#include "ui/film/thumbnail.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/welcome/thumbnails.h"
#include "ui/window/dialogrow.h"
#include "ui/window/mainwindow.h"
#include "ui/window/welcome.h"

#include <QtCore/QDir>
#include <QtCore/QEvent>
#include <QtGui/QPixmap>
#include <QtWidgets/QDialog>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPlainTextEdit>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

const QString kName = QStringLiteral("psProject");
constexpr int kEdge = 16, kGap = 6;
constexpr QSize kPicture{160, 90};
constexpr api::ParameterDeclaration kDuration{
    "duration", "Duration", "", "s", api::ParameterKind::Number, api::Scale::Linear, 60, 0, 600, 0, 1e9, "", 1, 0, "",
    "",         "",         "", ""};

class ProjectProperties : public QDialog {
 public:
  explicit ProjectProperties(MainWindow& window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void done(int result) override;

 private:
  void addPicture(QVBoxLayout& column);
  void showAbout();
  void showPicture(const std::string& thumbnail);
  void tell(const QString& problem);
  void take();
  void takeDuration();
  Document& m_document;
  Thumbnails& m_pictures;
  QLineEdit *m_title, *m_toTry, *m_duration;
  QPlainTextEdit* m_description;
  QLabel *m_picture, *m_problem, *m_file;
  QPushButton* m_remove = nullptr;
  std::string m_shown;  ///< of the picture; it is unpacked where it changes alone
};

ProjectProperties::ProjectProperties(MainWindow& window)
    : QDialog(&window),
      m_document(window.session().document()),
      m_pictures(window.welcome().pictures()),
      m_title(new QLineEdit),
      m_toTry(new QLineEdit),
      m_duration(new QLineEdit),
      m_description(new QPlainTextEdit),
      m_picture(new QLabel),
      m_problem(new QLabel),
      m_file(new QLabel) {
  setWindowTitle(QStringLiteral("Project properties"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kEdge, kEdge, kEdge, kEdge);
  column->setSpacing(kGap);
  const auto add = [&](const QString& name, QWidget* field) {
    auto* label = new QLabel(name);
    label->setBuddy(field);
    field->setAccessibleName(name);
    field->installEventFilter(this);
    column->addWidget(label);
    column->addWidget(field);
  };
  add(QStringLiteral("Title"), m_title);
  add(QStringLiteral("Description"), m_description);
  m_description->setTabChangesFocus(true);
  m_description->setPlaceholderText(QStringLiteral("What the scene shows"));
  add(QStringLiteral("To try"), m_toTry);
  m_toTry->setPlaceholderText(QStringLiteral("A sentence: what to change first"));
  add(QStringLiteral("Duration"), m_duration);
  m_duration->setToolTip(
      QStringLiteral("How long a run is planned to be: the time line's length, and where the run of a copy for others "
                     "ends. It goes on beyond that while it plays."));
  addPicture(*column);
  m_problem->setProperty("role", "error");
  m_problem->setWordWrap(true);
  m_problem->hide();
  column->addWidget(m_problem);
  m_file->setProperty("role", "muted");
  m_file->setWordWrap(true);
  column->addWidget(m_file);
  for (QLineEdit* line : {m_title, m_toTry}) connect(line, &QLineEdit::editingFinished, this, &ProjectProperties::take);
  connect(m_duration, &QLineEdit::editingFinished, this, &ProjectProperties::takeDuration);
  connect(&m_document, &Document::changed, this, &ProjectProperties::showAbout);
  showAbout();
  resize(460, 510);
}

void ProjectProperties::addPicture(QVBoxLayout& column) {
  column.addWidget(new QLabel(QStringLiteral("Picture")));
  auto* parts = new QWidget;
  parts->setAccessibleName(QStringLiteral("Picture"));
  auto* row = new QHBoxLayout(parts);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kGap);
  m_picture->setFixedSize(kPicture);
  m_picture->setAlignment(Qt::AlignCenter);
  m_picture->setProperty("role", "muted");
  row->addWidget(m_picture);
  const auto button = [&](const QString& text, const QString& tip) {
    auto* push = new QPushButton(text);
    push->setAccessibleName(QStringLiteral("Picture: ") + text);
    push->setAutoDefault(false);  // Enter ends what is typed above
    push->setToolTip(tip);
    row->addWidget(push, 0, Qt::AlignTop);
    return push;
  };
  QPushButton* fromView = button(QStringLiteral("Take from view"),
                                 QStringLiteral("What the view shows now: the project's picture in lists and copies."));
  m_remove = button(QStringLiteral("Remove"), QStringLiteral("Lists then show how the project was last seen."));
  row->addStretch(1);
  column.addWidget(parts);
  connect(fromView, &QPushButton::clicked, this, [this] { m_pictures.takeOwn(); });
  connect(&m_pictures, &Thumbnails::ownTaken, this, &ProjectProperties::tell);
  connect(m_remove, &QPushButton::clicked, this, [this] {
    ProjectAbout about = m_document.about();
    about.thumbnail.clear();
    m_document.setAbout(about, QStringLiteral("picture"));
  });
  showPicture({});
}

void ProjectProperties::showPicture(const std::string& thumbnail) {
  m_remove->setEnabled(!thumbnail.empty());
  if (thumbnail == m_shown && !thumbnail.empty()) return;
  m_shown = thumbnail;
  const QImage picture = pictureOf(thumbnail);
  if (picture.isNull()) return m_picture->setText(QStringLiteral("None of its own"));
  const double ratio = devicePixelRatioF();
  QPixmap pixmap = QPixmap::fromImage(picture.scaled(kPicture * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation));
  pixmap.setDevicePixelRatio(ratio);
  m_picture->setPixmap(pixmap);
}

void ProjectProperties::tell(const QString& problem) {
  m_problem->setText(problem);
  m_problem->setVisible(!problem.isEmpty());
}

/// What is being typed stays; what an undo brings back is shown.
void ProjectProperties::showAbout() {
  const ProjectAbout about = m_document.about();
  const auto show = [](QLineEdit& line, const std::string& value) {
    const QString text = QString::fromStdString(value);
    if (line.text() != text && !(line.hasFocus() && line.isModified())) line.setText(text);
  };
  show(*m_title, about.title);
  show(*m_toTry, about.toTry);
  show(*m_duration, (formatNumber(about.duration) + QStringLiteral(" s")).toStdString());
  showPicture(about.thumbnail);
  const QString text = QString::fromStdString(about.description);
  const bool typing = m_description->hasFocus() && m_description->document()->isModified();
  if (m_description->toPlainText() != text && !typing) m_description->setPlainText(text);
  const QString& path = m_document.path();
  m_file->setText(path.isEmpty() ? QStringLiteral("Not saved yet") : QDir::toNativeSeparators(path));
}

void ProjectProperties::take() {
  ProjectAbout about = m_document.about();
  const std::string title = m_title->text().trimmed().toStdString();
  const std::string text = m_description->toPlainText().trimmed().toStdString();
  const std::string toTry = m_toTry->text().trimmed().toStdString();
  m_title->setModified(false);
  m_toTry->setModified(false);
  m_description->document()->setModified(false);
  if (about.title != title) {
    about.title = title;
    m_document.setAbout(about, QStringLiteral("title"));
  }
  if (about.description != text) {
    about.description = text;
    m_document.setAbout(about, QStringLiteral("description"));
  }
  if (about.toTry == toTry) return;
  about.toTry = toTry;
  m_document.setAbout(about, QStringLiteral("what to try"));
}

/// A number that is none, or out of range, is told of, and the one before stays in force.
void ProjectProperties::takeDuration() {
  if (!m_duration->isModified()) return;
  ProjectAbout about = m_document.about();
  const Typed typed = parseTyped(m_duration->text(), kDuration, about.duration);
  const QString range =
      QString::fromStdString(rangeProblem(typed.value, kDuration.hardMinimum, kDuration.hardMaximum, kDuration.unit));
  const QString problem = !typed.problem.isEmpty() ? typed.problem
                          : range.isEmpty()        ? QString()
                                                   : QStringLiteral("Duration %1.").arg(range);
  tell(problem);
  if (!problem.isEmpty()) return;
  m_duration->setModified(false);
  about.duration = typed.value;
  m_document.setAbout(about, QStringLiteral("duration"));
  showAbout();
}

bool ProjectProperties::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusOut && watched == m_description) take();
  return QDialog::eventFilter(watched, event);
}

void ProjectProperties::done(int result) {
  take();
  takeDuration();
  QDialog::done(result);
}

}  // namespace

void openProjectProperties(MainWindow& window, const QString& row) {
  focusDialogRow(*bringUp(window, kName, [&window] { return new ProjectProperties(window); }), row);
}

std::vector<DialogRow> projectRows() {
  return {{QStringLiteral("Title"), QStringLiteral("name of the project")},
          {QStringLiteral("Description"), QStringLiteral("what the scene shows")},
          {QStringLiteral("To try"), QStringLiteral("what to change first")},
          {QStringLiteral("Duration"), QStringLiteral("length of the run, end")},
          {QStringLiteral("Picture"), QStringLiteral("thumbnail in lists and copies")}};
}

}  // namespace ps
