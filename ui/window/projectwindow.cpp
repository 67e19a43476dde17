// SPDX-License-Identifier: Apache-2.0
#include "ui/window/projectwindow.h"

#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/window/mainwindow.h"

#include <QtCore/QDir>
#include <QtCore/QEvent>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPlainTextEdit>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

const QString kName = QStringLiteral("psProject");
constexpr int kEdge = 16, kGap = 6;

class ProjectProperties : public QDialog {
 public:
  explicit ProjectProperties(MainWindow& window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void done(int result) override;

 private:
  void showAbout();
  void take();
  Document& m_document;
  QLineEdit *m_title, *m_toTry;
  QPlainTextEdit* m_description;
  QLabel* m_file;
};

ProjectProperties::ProjectProperties(MainWindow& window)
    : QDialog(&window),
      m_document(window.session().document()),
      m_title(new QLineEdit),
      m_toTry(new QLineEdit),
      m_description(new QPlainTextEdit),
      m_file(new QLabel) {
  setObjectName(kName);
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
  m_file->setProperty("role", "muted");
  m_file->setWordWrap(true);
  column->addWidget(m_file);
  for (QLineEdit* line : {m_title, m_toTry}) connect(line, &QLineEdit::editingFinished, this, &ProjectProperties::take);
  connect(&m_document, &Document::changed, this, &ProjectProperties::showAbout);
  showAbout();
  resize(460, 340);
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

bool ProjectProperties::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusOut && watched == m_description) take();
  return QDialog::eventFilter(watched, event);
}

void ProjectProperties::done(int result) {
  take();
  QDialog::done(result);
}

}  // namespace

void openProjectProperties(MainWindow& window) {
  auto* dialog = window.findChild<QDialog*>(kName);
  if (!dialog) dialog = new ProjectProperties(window);
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace ps
