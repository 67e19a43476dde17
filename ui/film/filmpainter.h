// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/film/framesink.h"
#include "ui/render/camera.h"
#include "ui/render/renderer.h"

#include <memory>
#include <optional>
#include <set>
#include <string>

namespace ps {

class PluginRegistry;

struct FilmChoices {
  std::string out;  ///< see makeFrameSink()
  double framesPerSecond = 60;
  PictureSize size;
  Look look;
  std::optional<Camera> camera;          ///< else the project's own; else one that shows what the first frame has
  std::optional<ViewSection> section{};  ///< in place of the look's, as that camera sees it
};

/// Draws frames of one project's run into a film or a folder, without a display; for the thread that made it.
class FilmPainter {
 public:
  /// Both must outlive it. Throws as makeFrameSink(), and Error where nothing can be drawn.
  FilmPainter(const Project& project, const PluginRegistry& plugins, FilmChoices choices);
  /// `frame` numbers the picture. Walls and air are as the project's tracks have them then; its hidden bodies are left
  /// out.
  void draw(const SnapshotPtr& snapshot, long frame);
  /// Of pictures.
  size_t finish();

 private:
  const Project& m_project;
  const PluginRegistry& m_plugins;
  FilmChoices m_choices;
  std::set<std::string> m_hidden;
  RenderScene m_scene;
  HeadlessContext m_context;
  std::unique_ptr<Renderer> m_renderer;
  std::unique_ptr<FrameSink> m_sink;
  size_t m_pictures = 0;
};

}  // namespace ps
