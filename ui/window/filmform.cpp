// SPDX-License-Identifier: Apache-2.0
#include "ui/window/filmform.h"

#include "core/base/progress.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/packedframe.h"
#include "ui/document/document.h"
#include "ui/film/filmpainter.h"
#include "ui/film/projectlook.h"
#include "ui/session/runwork.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/viewport/viewport.h"
#include "ui/window/filenames.h"

#include <QtCore/QFileInfo>
#include <QtCore/QStandardPaths>
#include <QtWidgets/QComboBox>

#include <utility>

namespace ps {
namespace {

constexpr std::pair<int, int> kSizes[] = {{1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}, {1080, 1080}};

/// Draws each frame that is meant, one that is not kept as the one before it.
size_t draw(const KeptRun& run, const FrameRange& range, FilmPainter& painter) {
  const std::vector<RangeFrame> frames = framesIn(run, range);
  beginStage("Drawing", 1, static_cast<double>(frames.size()));
  const FrameUnpacker unpacker;
  for (const RangeFrame& frame : frames) {
    painter.draw(unpacker.snapshot(*run.frames.at(frame.kept), 1), static_cast<long>(frame.wanted));
    advance(1);
  }
  return painter.finish();
}

}  // namespace

FilmForm::FilmForm(Session& session, const Viewport* view)
    : RunForm(session),
      m_view(view),
      m_format(addChoice(QStringLiteral("Format"), QStringLiteral("A film plays as fast as the run was."))),
      m_size(addChoice(QStringLiteral("Size"), QStringLiteral("In pixels."))),
      m_hasFfmpeg(!QStandardPaths::findExecutable(QStringLiteral("ffmpeg")).isEmpty()) {
  m_format->addItem(QStringLiteral("Film, MP4"), true);
  m_format->addItem(QStringLiteral("Pictures, PNG"), false);
  if (!m_hasFfmpeg) m_format->setCurrentIndex(1);
  for (const auto& [width, height] : kSizes)
    m_size->addItem(QStringLiteral("%1 × %2").arg(width).arg(height), QSize(width, height));
  if (view) m_size->addItem(QStringLiteral("As the view"), QSize());
  addRange();
}

bool FilmForm::film() const { return m_format->currentData().toBool(); }

PictureSize FilmForm::size() const {
  QSize chosen = m_size->currentData().toSize();
  if (chosen.isEmpty()) {
    const QSize view = (QSizeF(m_view->size()) * m_view->devicePixelRatioF()).toSize();
    chosen = {view.width() / 2 * 2, view.height() / 2 * 2};  // films need even sizes
  }
  return {.width = chosen.width(), .height = chosen.height(), .still = !film()};
}

QString FilmForm::suggestedPlace() const {
  return besideProject(film() ? QStringLiteral(".mp4") : QStringLiteral("-pictures"));
}

QString FilmForm::choosePlace() {
  if (film()) return fileToWrite(this, QStringLiteral("Save the film"), place(), QStringLiteral("Films (*.mp4)"));
  return folderToUse(this, QStringLiteral("Folder for the pictures"), QFileInfo(place()).path());
}

QString FilmForm::summary() const {
  const QString pictures = countText(frames(), QStringLiteral("picture"), QStringLiteral("pictures"));
  if (!film()) {
    return QStringLiteral("%1, from the view and %2").arg(pictures, colours()) +
           (replaces() ? QStringLiteral(" The folder has some of these names: they are replaced.") : QString());
  }
  if (!m_hasFfmpeg)
    return QStringLiteral("Films need the program ffmpeg, which is not installed. Install it, or choose pictures.");
  const double seconds = static_cast<double>(frames()) / framesPerSecond();
  return QStringLiteral("%1, %2 s, from the view and %3").arg(pictures, formatShort(seconds, 3), colours()) +
         (replaces() ? QStringLiteral(" The file there is replaced.") : QString());
}

QString FilmForm::fileNames() const { return film() ? QString() : QStringLiteral("frame-*.png"); }

/// A frame without the field is drawn in the colours of matter: nobody shall find that out from the film.
QString FilmForm::colours() const {
  const std::string& colour = session().document().project().view.colour;
  const FrameRange asked = range();
  if (colour == kMatterColour || !session().isReady()) return QStringLiteral("in the colours of now.");
  const FieldPtr field = session().fields().find(colour);
  const QString label = QString::fromStdString(field ? field->label : colour);
  const RunRecord& record = session().engine()->recording();
  const bool first = record.keepsField(asked.first, colour), last = record.keepsField(asked.last, colour);
  if (first && last) return QStringLiteral("in the colours of now.");
  return (first || last
              ? QStringLiteral("in the colours of now where %1 was recorded, elsewhere in those of matter.")
              : QStringLiteral("in the colours of matter: %1 was not recorded then. Go back to the start and run again "
                               "with this colour in the view to have it."))
      .arg(label);
}

bool FilmForm::isPossible() const { return !film() || m_hasFfmpeg; }

void FilmForm::begin() {
  const Project& project = session().document().project();
  FilmChoices choices{.out = place().toStdString(),
                      .framesPerSecond = framesPerSecond(),
                      .size = size(),
                      .look = m_view ? m_view->shownLook() : lookOf(project, *session().plugins(), project.view.colour),
                      .camera = {}};
  if (m_view)
    choices.camera = m_view->navigator().camera();
  else
    choices.section = project.view.section;
  session().work().start(
      {film() ? QStringLiteral("Film") : QStringLiteral("Pictures"), place(),
       [choices, project, asked = range(), where = place(), plugins = session().registry()](const KeptRun& run) {
         FilmPainter painter(project, *plugins, choices);
         return RunWork::Result{writtenText(draw(run, asked, painter), where)};
       }});
}

}  // namespace ps
