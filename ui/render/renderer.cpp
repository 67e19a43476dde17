// SPDX-License-Identifier: Apache-2.0
#include "ui/render/passes.h"

#include "core/base/error.h"
#include "ui/render/camera.h"
#include "ui/render/glstate.h"
#include "ui/render/prepared.h"
#include "ui/render/viewframe.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace ps {
namespace {

std::string sizeText(const PictureSize& size) {
  return std::to_string(size.width) + " × " + std::to_string(size.height) + " pixels";
}

/// The first OpenGL error that waits, and none waits afterwards. A lost context reports for ever: enough is enough.
GLenum takeErrors() {
  const GLenum first = glGetError();
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
  }
  return first;
}

/// What a renderer tells OpenGL, where only one thread may do so at a time. Seen with Mesa 22.3's llvmpipe, where the
/// headset and the window draw at once: now and then one of them falls in the driver's rasterizer, or never comes back.
class Turn {
 public:
  explicit Turn(const render::Quality& quality) {
    static std::mutex mutex;
    if (quality.takesTurns) m_lock = std::unique_lock(mutex);
  }
  ~Turn() {
    if (m_lock) glFinish();  // nothing is left for the driver's own threads
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::unique_lock<std::mutex> m_lock;
};

}  // namespace

struct Renderer::Impl {
  // The state is put back after the constructor's passes are made, so that a context in use stays as it was.
  static std::unique_ptr<render::Passes> makePasses(PixelWork work) {
    if (epoxy_gl_version() < 43)
      throw Error("the graphics driver offers OpenGL " + std::to_string(epoxy_gl_version() / 10) + "." +
                  std::to_string(epoxy_gl_version() % 10) + "; the view needs 4.3 or newer");
    const render::GlState state;
    return std::make_unique<render::Passes>(work);
  }
  explicit Impl(PixelWork work) : passes(makePasses(work)) {}

  std::unique_ptr<render::Passes> passes;
  render::LayerPool pool;
  render::Prepared prepared;
  render::ViewFrame frame;  // kept for its memory
};

Renderer::Renderer(PixelWork work) : m(std::make_unique<Impl>(work)) {}
Renderer::~Renderer() = default;

void Renderer::checkSize(const PictureSize& size) const {
  const int most = m->passes->largestPicture() / render::innerScale(size);
  if (std::max(size.width, size.height) <= most) return;
  throw Error("a picture of " + sizeText(size) + " is larger than the " + std::to_string(most) +
              " pixels a side that this graphics driver draws" + (size.still ? " with smooth edges" : "") +
              "; ask for a smaller one");
}

void Renderer::prepare(const Snapshot& now, const Snapshot* previous, double blend, const RenderScene& scene,
                       const Look& look) {
  m->prepared.fill(now, previous, blend, scene, look);
  const Turn turn(m->passes->quality());
  const render::GlState state;
  m->passes->prepare(m->prepared);
}

Preparation::Preparation() : m(std::make_unique<render::Prepared>()) {}
Preparation::~Preparation() = default;

void Preparation::make(const Snapshot& now, const Snapshot* previous, double blend, const RenderScene& scene,
                       const Look& look) {
  m->fill(now, previous, blend, scene, look);
}

void Renderer::take(Preparation& preparation) {
  if (!preparation.m->ready) throw Error("there is nothing to take of what was never made");
  std::swap(m->prepared, *preparation.m);
  m->prepared.takeProps(*preparation.m);
  const render::GlState state;
  m->passes->prepare(m->prepared);
}

void Renderer::timePasses(std::vector<PassTime>* times) { m->passes->timePasses(times); }

void Renderer::show(const Props& props) {
  m->prepared.show(props);
  const render::GlState state;
  m->passes->show(props);
}

void Renderer::draw(const Eye& eye, const RenderTarget& target) {
  if (target.size.width < 1 || target.size.height < 1) return;
  if (!m->prepared.ready) throw Error("there is no picture of what was never prepared");
  checkSize(target.size);
  render::ViewFrame& frame = m->frame;
  frame.fill(m->prepared, eye, target, m->passes->quality());

  const Turn turn(m->passes->quality());
  const render::GlState state;
  const render::Instances& drawn = m->prepared.instances;
  const std::array wanted{drawn.liquids() > 0, drawn.vapours > 0, drawn.outlined > 0, drawn.ghosts > 0};
  const render::Layers* known = m->pool.find(frame.width, frame.height);
  bool first = !known;
  for (size_t i = 0; i < wanted.size(); ++i) first = first || wanted[i] > known->drawn[i];
  if (first) takeErrors();  // whoever drew before left them
  render::Layers& layers = m->pool.at(frame.width, frame.height);
  m->passes->draw(m->prepared, frame, layers);
  if (!first) return;
  // Asked once per size: what fails with these targets fails in the first frame, and asking makes the processor wait.
  if (const GLenum error = takeErrors(); error != GL_NO_ERROR) {
    m->pool.drop(layers);
    throw Error("the graphics driver " +
                (error == GL_OUT_OF_MEMORY ? "has no memory" : "reports error " + std::to_string(error)) +
                " for a picture of " + sizeText(target.size) + "; ask for a smaller one");
  }
  for (size_t i = 0; i < wanted.size(); ++i) layers.drawn[i] = layers.drawn[i] || wanted[i];
}

void Renderer::drawDepth(const RenderTarget& target, size_t panels) {
  const render::Layers* drawn = m->pool.find(m->frame.width, m->frame.height);
  if (!drawn) throw Error("there are no depths of what was never drawn");
  const Turn turn(m->passes->quality());
  const render::GlState state;
  m->passes->drawDepth(m->prepared, m->frame, *drawn, target, panels);
}

}  // namespace ps
