// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/globjects.h"
#include "ui/render/uniforms.h"

#include <array>
#include <cstdint>
#include <list>
#include <memory>

namespace ps::render {

/// Where in a framebuffer a picture goes; tells pictures of one size apart.
struct PicturePlace {
  uint32_t framebuffer = 0;
  int x = 0, y = 0;  ///< pixels
  bool operator==(const PicturePlace&) const = default;
};

/// The inner targets of pictures of one size. Pictures drawn one after the other share them, but for the background,
/// which stays as long as its picture is seen from the same place.
struct Layers {
  struct Background {
    PicturePlace place;
    FrameUniforms uniforms{};  ///< for which it was drawn
    Texture picture{GL_RGBA8, GL_NEAREST};
  };
  static constexpr size_t kBackgrounds = 4;

  /// That of a picture, or one to be drawn, with uniforms of zero.
  Background& backgroundOf(const PicturePlace& place);

  int width = 0, height = 0;
  std::array<bool, 4> drawn{};  ///< the driver has shown that it can: liquid, vapour, an outline, a ghost
  uint64_t used = 0;            ///< when, in draws
  Texture surface{GL_RGBA8, GL_NEAREST}, normal{GL_RGB10_A2, GL_NEAREST}, distance{GL_R32F, GL_NEAREST};
  Texture triangles{GL_R32UI, GL_NEAREST};  ///< where surfaces are computed
  Texture depth{GL_DEPTH24_STENCIL8, GL_NEAREST}, open{GL_R8, GL_LINEAR};
  Texture picture{GL_RGBA8, GL_LINEAR}, behind{GL_RGBA8, GL_LINEAR}, finished{GL_RGBA8, GL_NEAREST};
  Texture fluid{GL_R32F, GL_NEAREST}, fluidOther{GL_R32F, GL_NEAREST}, fluidColour{GL_RGBA16F, GL_LINEAR};
  Texture fluidClear{GL_R16F, GL_LINEAR}, fluidNormal{GL_RGB10_A2, GL_LINEAR};
  Texture fluidDepth{GL_DEPTH_COMPONENT24, GL_NEAREST};
  Texture steam{GL_RGBA16F, GL_LINEAR}, mask{GL_R8, GL_LINEAR};
  Texture ghost{GL_R32F, GL_NEAREST}, ghostDepth{GL_DEPTH_COMPONENT24, GL_NEAREST};
  std::list<Background> backgrounds;  ///< the one used last comes first
};

/// Layers by size, so that views of different sizes can take turns without new storage each time.
class LayerPool {
 public:
  static constexpr size_t kSizes = 3;     ///< kept at once: a view, an eye, a film
  static constexpr uint64_t kIdle = 120;  ///< draws after which a size that nobody asked for goes

  Layers& at(int width, int height);                ///< pixels; stays valid until the next call
  const Layers* find(int width, int height) const;  ///< nullptr when there are none yet
  void drop(const Layers& layers);
  size_t size() const { return m_layers.size(); }

 private:
  std::list<Layers> m_layers;
  uint64_t m_draws = 0;
};

}  // namespace ps::render
