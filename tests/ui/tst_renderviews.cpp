// SPDX-License-Identifier: Apache-2.0
// One prepare, many pictures: eyes, mirrors, thumbnails, films.
#include <epoxy/gl.h>

#include "core/base/error.h"
#include "tests/ui/renderscenes.h"
#include "ui/render/layers.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <cmath>

using namespace ps;
using namespace ps::testing;

namespace {

using Image = std::vector<uint8_t>;
constexpr int kSheetWidth = 800, kSheetHeight = 450;  // pixels

/// A framebuffer that several pictures are drawn into, filled with one colour.
struct Sheet {
  Sheet() {
    glGenFramebuffers(1, &framebuffer);
    glGenTextures(1, &picture);
    glBindTexture(GL_TEXTURE_2D, picture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSheetWidth, kSheetHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
    glClearColor(1, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }
  ~Sheet() {
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &picture);
  }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  /// Rows from the top, as renderImage() gives them.
  Image read(int x, int y, int width, int height) const {
    Image pixels(static_cast<size_t>(width * height * 4));
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glReadPixels(x, y, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    const auto row = static_cast<ptrdiff_t>(width) * 4;
    for (ptrdiff_t top = 0, bottom = height - 1; top < bottom; ++top, --bottom)
      std::swap_ranges(pixels.begin() + top * row, pixels.begin() + (top + 1) * row, pixels.begin() + bottom * row);
    return pixels;
  }
  GLuint framebuffer = 0, picture = 0;
};

Eye moved(const Eye& eye, double right) {
  Eye other = eye;
  other.view(0, 3) -= right;
  return other;
}

/// Left and right eyes of a headset 64 mm apart, whose windows reach farther out than in.
std::array<Eye, 2> eyesOf(const Camera& camera) {
  const Matrix4 view = viewMatrix(camera);
  const double near = nearPlane(camera), far = farPlane(camera);
  std::array<Eye, 2> eyes{eyeThrough(view, -0.6, 0.4, -0.5, 0.3, near, far),
                          eyeThrough(view, -0.4, 0.6, -0.5, 0.3, near, far)};
  for (const size_t i : {0u, 1u}) eyes[i] = moved(eyes[i], i ? 0.032 : -0.032);
  return eyes;
}

double meanDifference(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::abs(int{a[i]} - int{b[i]});
  return sum / static_cast<double>(a.size());
}

/// A block of 16 particles along each side, 0.32 m wide, around the middle; hot within, cold in its outer layers.
Snapshot block(api::Motion motion) {
  Snapshot s;
  constexpr int n = 16, skin = 4;
  for (int i = 0; i < n * n * n; ++i) {
    const std::array at{i % n, i / n % n, i / (n * n)};
    const bool outer = std::any_of(at.begin(), at.end(), [](int k) { return k < skin || k >= n - skin; });
    const auto along = [](int k) { return 0.02 * (k - (n - 1) / 2.0); };
    addParticle(s, {along(at[0]), along(at[1]), along(at[2])}, 0.0124, static_cast<uint32_t>(i), motion,
                outer ? 280 : 380);
  }
  return s;
}

}  // namespace

class TestRenderViews : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context = std::make_unique<HeadlessContext>(); }
  void cleanupTestCase() { m_context.reset(); }

  void onePrepareServesEveryView_data();
  void onePrepareServesEveryView();
  void aWindowBesideTheAxisShowsTheSame_data();
  void aWindowBesideTheAxisShowsTheSame();
  void preparedInOneContextDrawnInAnother();
  void propsAreShownBesides();
  void panelsAreShownOverTheScene();
  void nothingPreparedIsAnError();
  void sizesTakeTurnsWithoutNewStorage();
  void picturesKeepTheirBackground();
  void whatIsBuriedShowsFromAmongIt();
  void liquidIsAsThickFromNear();

 private:
  std::unique_ptr<HeadlessContext> m_context;
};

void TestRenderViews::onePrepareServesEveryView_data() {
  QTest::addColumn<QString>("colour");
  QTest::addColumn<bool>("dark");
  QTest::addColumn<bool>("still");
  QTest::newRow("matter") << QString("material") << true << false;
  QTest::newRow("light") << QString("material") << false << false;
  QTest::newRow("temperature") << QString("temperature") << true << false;
  QTest::newRow("a still") << QString("material") << true << true;
}

/// Two eyes, a mirror at another place and a thumbnail of another size side by side in one framebuffer, and the first
/// eye once more: each is, bit by bit, what a renderer that never drew anything else makes of it.
void TestRenderViews::onePrepareServesEveryView() {
  QFETCH(QString, colour);
  QFETCH(bool, dark);
  QFETCH(bool, still);
  const Snapshot snapshot = everything();
  Shot shot;
  shot.look.colour = colour.toStdString();
  shot.look.dark = dark;
  shot.look.outline = BodyOutline{{0}, {1, 1, 0}, {0, 0, 0}};
  Camera above = shot.camera;
  above.elevation = 80;
  const auto eyes = eyesOf(shot.camera);
  const Sheet sheet;
  struct View {
    Eye eye;
    RenderTarget target;
  };
  const std::vector<View> views{{eyes[0], {sheet.framebuffer, 0, 0, {300, 240, still}}},
                                {eyes[1], {sheet.framebuffer, 301, 3, {300, 240, still}}},
                                {eyeOf(above, 120, 80), {sheet.framebuffer, 620, 17, {120, 80, still}}},
                                {eyeOf(above, 301, 199), {sheet.framebuffer, 11, 246, {301, 199, still}}},
                                {eyes[0], {sheet.framebuffer, 0, 0, {300, 240, still}}}};
  Renderer renderer;
  renderer.prepare(snapshot, nullptr, 1, tray(), shot.look);
  for (const View& view : views) renderer.draw(view.eye, view.target);
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  for (const View& view : views) {
    Renderer fresh;
    fresh.prepare(snapshot, nullptr, 1, tray(), shot.look);
    const RenderTarget& to = view.target;
    QVERIFY(sheet.read(to.x, to.y, to.size.width, to.size.height) == renderImage(fresh, view.eye, to.size));
  }
  QVERIFY(sheet.read(0, 0, 300, 240) != sheet.read(301, 3, 300, 240));
  // What lies between the pictures is as it was.
  for (const auto& [x, y, width, height] : {std::array{300, 0, 1, 240}, {301, 0, 440, 3}, {0, 446, kSheetWidth, 4}}) {
    const Image between = sheet.read(x, y, width, height);
    for (size_t i = 0; i < between.size(); i += 4) QVERIFY(between[i] == 255 && between[i + 1] == 0);
  }
}

void TestRenderViews::aWindowBesideTheAxisShowsTheSame_data() {
  QTest::addColumn<QString>("colour");
  QTest::newRow("matter") << QString("material");
  QTest::newRow("temperature") << QString("temperature");
}

/// Two windows of one size from one place, one around the line of sight and one beside it: where both look they show
/// the same, but for the pattern of dither and what lies beyond an edge for one of them, which is less than a level on
/// average. The wrong rays to the lit points, or a glow around the picture's middle, are several.
void TestRenderViews::aWindowBesideTheAxisShowsTheSame() {
  QFETCH(QString, colour);
  constexpr int kSide = 448, kAside = 160, kUp = 64;  // pixels; whole tiles, so that small layers have the same grid
  constexpr double kPixel = 0.7 / kSide;
  Shot shot;
  shot.look.colour = colour.toStdString();
  shot.camera.distance = 1.2;
  const Matrix4 view = viewMatrix(shot.camera);
  const double near = nearPlane(shot.camera), far = farPlane(shot.camera);
  Renderer renderer;
  renderer.prepare(everything(), nullptr, 1, tray(), shot.look);
  const auto seenThrough = [&](int aside, int up) {
    const double x = aside * kPixel, y = up * kPixel;
    return renderImage(renderer, eyeThrough(view, x - 0.35, x + 0.35, y - 0.35, y + 0.35, near, far),
                       {kSide, kSide, false});
  };
  const Image centred = seenThrough(0, 0), beside = seenThrough(kAside, kUp);
  Image expected, both;
  for (int y = kUp; y < kSide; ++y) {
    const auto row = [](const Image& image, int x, int line) {
      return image.begin() + (ptrdiff_t{line} * kSide + x) * 4;
    };
    expected.insert(expected.end(), row(centred, kAside, y - kUp), row(centred, 0, y - kUp + 1));
    both.insert(both.end(), row(beside, 0, y), row(beside, kSide - kAside, y));
  }
  const double difference = meanDifference(expected, both);
  QVERIFY2(difference < 1, qPrintable(QString::number(difference)));
}

void TestRenderViews::preparedInOneContextDrawnInAnother() {
  Shot shot;
  Renderer renderer;
  const Image alone = renderImage(renderer, everything(), tray(), shot);
  HeadlessContext other(m_context.get());
  Snapshot later = everything();
  for (api::Float4& p : later.position) p.y += 0.05f;
  for (int i = 0; i < 3; ++i) {
    m_context->makeCurrent();
    renderer.prepare(later, nullptr, 1, tray(), shot.look);
    other.makeCurrent();
    const Image moved = renderImage(renderer, shot.eye(), shot.size);
    QVERIFY(moved != alone);
    renderer.prepare(everything(), nullptr, 1, tray(), shot.look);
    m_context->makeCurrent();
    QVERIFY(renderImage(renderer, shot.eye(), shot.size) == alone);
  }
  other.makeCurrent();
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  m_context->makeCurrent();
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

/// A square in the world's middle, seen from the front: it shows where nothing stands before it, in whatever is
/// prepared, until it is taken away; what is clear lets the ground through.
void TestRenderViews::propsAreShownBesides() {
  Shot shot;
  shot.camera = {{0, 0, 0}, 1, 0, 0, 35};
  const auto square = [](float z, float fourth) {
    const auto at = [&](float x, float y) { return MeshVertex{{x, y, z}, {0, 0, 1}, {0.9f, 0.1f, 0.1f, fourth}}; };
    const float s = 0.1f;
    return std::vector{at(-s, -s), at(s, -s), at(s, s), at(-s, -s), at(s, s), at(-s, s)};
  };
  const auto redness = [](const Image& image) {
    const size_t middle = (kHeight / 2 * kWidth + kWidth / 2) * 4;
    return int{image[middle]} - int{image[middle + 2]};
  };
  Renderer renderer;
  const Image without = renderImage(renderer, block(api::Motion::Solid), RenderScene{}, shot);
  renderer.show({square(0.3f, 0), {}, {}});
  QVERIFY(redness(ps::renderImage(renderer, shot.eye(), shot.size)) > 80);
  QVERIFY(redness(renderImage(renderer, block(api::Motion::Solid), RenderScene{}, shot)) > 80);
  renderer.show({{}, square(0.3f, 0.4f), {}});
  const int clear = redness(ps::renderImage(renderer, shot.eye(), shot.size));
  QVERIFY2(clear > redness(without) + 20 && clear < 160, qPrintable(QString::number(clear)));
  renderer.show({square(-0.3f, 0), square(-0.3f, 0.4f), {}});  // behind the block
  QVERIFY(redness(ps::renderImage(renderer, shot.eye(), shot.size)) == redness(without));
  renderer.show({});
  QVERIFY(ps::renderImage(renderer, shot.eye(), shot.size) == without);
}

/// A blue panel in the world's middle: over matter that is nearer, behind a red square in a hand, and not from behind.
void TestRenderViews::panelsAreShownOverTheScene() {
  Shot shot;
  shot.camera = {{0, 0, 0}, 1, 0, 0, 35};
  const auto image = std::make_shared<PanelImage>();
  image->width = image->height = 2;
  for (int k = 0; k < 4; ++k) image->pixels.insert(image->pixels.end(), {0, 0, 255, 255});
  const auto panel = [&](float z, double side) {
    const double s = 0.1;
    return Panel{{Vector3(-s * side, -s, z), {s * side, -s, z}, {s * side, s, z}, {-s * side, s, z}}, image};
  };
  const auto blueness = [&](const Props& props, Renderer& renderer) {
    renderer.show(props);
    const Image seen = ps::renderImage(renderer, shot.eye(), shot.size);
    const size_t middle = (kHeight / 2 * kWidth + kWidth / 2) * 4;
    return int{seen[middle + 2]} - int{seen[middle]};
  };
  Renderer renderer;
  const Image without = renderImage(renderer, block(api::Motion::Solid), RenderScene{}, shot);
  const auto corner = [](float x, float y) { return MeshVertex{{x, y, 0.3f}, {0, 0, 1}, {0.9f, 0.1f, 0.1f, 0}}; };
  const std::vector<MeshVertex> hand{corner(-0.1f, -0.1f), corner(0.1f, -0.1f), corner(0.1f, 0.1f),
                                     corner(-0.1f, -0.1f), corner(0.1f, 0.1f),  corner(-0.1f, 0.1f)};
  QVERIFY(blueness({{}, {}, {panel(0.2f, 1)}}, renderer) > 200);
  QVERIFY(blueness({{}, {}, {panel(-0.3f, 1)}}, renderer) > 200);  // the block is nearer
  QVERIFY(blueness({hand, {}, {panel(0.2f, 1)}}, renderer) < -80);
  renderer.show({{}, {}, {panel(0.2f, -1)}});  // its back
  QVERIFY(ps::renderImage(renderer, shot.eye(), shot.size) == without);
}

void TestRenderViews::nothingPreparedIsAnError() {
  Renderer renderer;
  const Shot shot;
  QVERIFY_EXCEPTION_THROWN(ps::renderImage(renderer, shot.eye(), shot.size), Error);
}

void TestRenderViews::sizesTakeTurnsWithoutNewStorage() {
  render::LayerPool pool;
  render::Layers& large = pool.at(320, 200);
  render::Layers& small = pool.at(160, 100);
  const std::array names{large.picture.name(), small.picture.name()};
  for (int i = 0; i < 10; ++i) {
    QVERIFY(&pool.at(320, 200) == &large && &pool.at(160, 100) == &small);
    QVERIFY(large.picture.name() == names[0] && small.picture.name() == names[1]);
    QVERIFY(large.picture.width() == 320 && small.picture.width() == 160);
  }
  // A window that is being resized asks for many sizes: the ones used last stay.
  for (int width = 100; width < 110; ++width) {
    pool.at(width, 100);
    QVERIFY(&pool.at(320, 200) == &large);
  }
  QCOMPARE(pool.size(), render::LayerPool::kSizes);
  QVERIFY(!pool.find(160, 100));
  for (uint64_t i = 0; i <= render::LayerPool::kIdle; ++i) pool.at(320, 200);
  QCOMPARE(pool.size(), size_t{1});
}

void TestRenderViews::picturesKeepTheirBackground() {
  render::LayerPool pool;
  render::Layers& layers = pool.at(64, 64);
  const auto drawn = [&](uint32_t framebuffer, int x) {
    auto& background = layers.backgroundOf({framebuffer, x, 0});
    const bool known = background.uniforms.size[0] > 0;
    background.uniforms.size[0] = 1;
    return known;
  };
  QVERIFY(!drawn(1, 0) && !drawn(1, 64) && !drawn(2, 0));
  QVERIFY(drawn(1, 0) && drawn(1, 64) && drawn(2, 0));
  for (uint32_t i = 10; i < 10 + render::Layers::kBackgrounds; ++i) QVERIFY(!drawn(i, 0));
  QVERIFY(!drawn(1, 0));
  QCOMPARE(layers.backgrounds.size(), render::Layers::kBackgrounds);
}

// What a view from outside never sees is not drawn for it, but an eye may be inside.
void TestRenderViews::whatIsBuriedShowsFromAmongIt() {
  Renderer renderer;
  Shot shot;
  shot.look.colour = "temperature";
  shot.look.rangeMinimum = 270, shot.look.rangeMaximum = 390;
  shot.camera.target = {0, 0, 0};
  const Snapshot s = block(api::Motion::Solid);
  // Red is what the map has for hot, blue for cold.
  const auto hot = [&](double distance) {
    shot.camera.distance = distance;
    const Image image = renderImage(renderer, s, RenderScene{}, shot);
    size_t count = 0;
    for (size_t i = 0; i < image.size(); i += 4) count += image[i] > image[i + 2] + 60;
    return static_cast<double>(count) / static_cast<double>(image.size() / 4);
  };
  QCOMPARE(hot(1), 0.0);
  const double inside = hot(0.03);
  QVERIFY2(inside > 0.9, qPrintable(QString::number(inside)));
}

// Its thickness is added up in fewer pixels where particles are large in the picture.
void TestRenderViews::liquidIsAsThickFromNear() {
  constexpr int scale = 5;
  Renderer renderer;
  Shot shot;
  shot.camera.target = {0, 0, 0};
  shot.camera.distance = 0.9;
  Snapshot s = block(api::Motion::Liquid);
  s.materialLook = {{0.9f, 0.6f, 0.2f, 1}};
  const Image small = renderImage(renderer, s, RenderScene{}, shot);
  shot.size = {scale * kWidth, scale * kHeight, false};
  const Image large = renderImage(renderer, s, RenderScene{}, shot);
  Image reduced(small.size());
  for (size_t y = 0; y < kHeight; ++y)
    for (size_t x = 0; x < kWidth; ++x)
      for (size_t k = 0; k < 4; ++k) {
        int sum = 0;
        for (size_t i = 0; i < scale * scale; ++i)
          sum += large[((scale * y + i / scale) * scale * kWidth + scale * x + i % scale) * 4 + k];
        reduced[(y * kWidth + x) * 4 + k] = static_cast<uint8_t>(sum / (scale * scale));
      }
  const double apart = meanDifference(small, reduced);
  QVERIFY2(apart < 2, qPrintable(QString::number(apart)));
}

QTEST_GUILESS_MAIN(TestRenderViews)
#include "tst_renderviews.moc"
