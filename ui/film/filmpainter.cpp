// SPDX-License-Identifier: Apache-2.0
#include "ui/film/filmpainter.h"

#include "core/simulation/tracks.h"
#include "ui/film/hiddenbodies.h"
#include "ui/render/framing.h"

#include <algorithm>
#include <utility>

namespace ps {

FilmPainter::FilmPainter(const Project& project, const PluginRegistry& plugins, FilmChoices choices)
    : m_project(project),
      m_plugins(plugins),
      m_choices(std::move(choices)),
      m_hidden(hiddenBodies(project)),
      m_scene{project.environment} {
  if (const auto& own = project.view.camera; own && !m_choices.camera)
    m_choices.camera = Camera{own->target, own->distance, own->azimuth, own->elevation};
  m_context.makeCurrent();
  m_renderer = std::make_unique<Renderer>();
  m_renderer->checkSize(m_choices.size);
  m_sink = makeFrameSink(m_choices.out, m_choices.size.width, m_choices.size.height,
                         std::clamp(m_choices.framesPerSecond, 1e-3, 1000.0));
}

void FilmPainter::draw(const SnapshotPtr& whole, long frame) {
  const SnapshotPtr shown = withoutBodies(whole, m_hidden);
  const Snapshot& snapshot = *shown;
  const auto [width, height, still] = m_choices.size;
  // One view for the whole film: what it begins with.
  if (!m_choices.camera) m_choices.camera = cameraShowing(snapshot, m_scene.environment, width, height);
  if (m_choices.section) m_choices.look.section = sectionFor(*m_choices.section, frameOf(*m_choices.camera).forward);
  m_scene.environment = environmentAt(m_project, &m_plugins, snapshot.stats.time);
  m_renderer->prepare(snapshot, nullptr, 1, m_scene, m_choices.look);
  m_sink->add(renderImage(*m_renderer, eyeOf(*m_choices.camera, width, height), m_choices.size), frame);
  m_pictures = isPicture(m_choices.out) ? 1 : m_pictures + 1;  // the last is kept
}

size_t FilmPainter::finish() {
  m_sink->finish();
  return m_pictures;
}

}  // namespace ps
