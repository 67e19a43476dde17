// SPDX-License-Identifier: Apache-2.0
#include "ui/window/exportform.h"
#include "ui/window/filenames.h"

#include "core/plugin_host/registry.h"
#include "ui/document/document.h"
#include "ui/film/projectlook.h"
#include "ui/session/runwork.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"

#include <QtCore/QFileInfo>
#include <QtWidgets/QComboBox>

namespace ps {

ExportForm::ExportForm(Session& session)
    : RunForm(session),
      m_format(addChoice(QStringLiteral("Format"), QStringLiteral("Lengths in m, y up; SI units and kelvin."))) {
  for (const ExportFormat& row : exportFormats()) m_format->addItem(QString::fromUtf8(row.label));
  addRange();
}

const ExportFormat& ExportForm::format() const {
  return exportFormats()[static_cast<size_t>(m_format->currentIndex())];
}

QString ExportForm::suggestedPlace() const {
  return besideProject(QLatin1Char('-') + QString::fromLatin1(format().key));
}

QString ExportForm::choosePlace() {
  return folderToUse(this, QStringLiteral("Folder for the files"), QFileInfo(place()).path());
}

QString ExportForm::summary() const {
  const ExportFormat& chosen = format();
  QString text = QStringLiteral("%1, %2.").arg(countText(frames(), QStringLiteral("file"), QStringLiteral("files")),
                                               QString::fromUtf8(chosen.help));
  if (replaces()) text += QStringLiteral(" The folder has files of these names: they are replaced.");
  return text;
}

QString ExportForm::fileNames() const {
  return QString::fromLatin1(format().first) + QStringLiteral("-*.") + QString::fromLatin1(format().ending);
}

void ExportForm::begin() {
  const Project& project = session().document().project();
  const ExportChoices choices{
      place().toStdString(), {}, temperatureColours(lookOf(project, *session().plugins(), "temperature"))};
  session().work().start({QString::fromUtf8(format().label), place(),
                          [&chosen = format(), choices, asked = range(), where = place()](const KeptRun& run) {
                            return RunWork::Result{
                                writtenText(exportFrames(run, asked, *makeExporter(chosen, choices)), where)};
                          }});
}

}  // namespace ps
