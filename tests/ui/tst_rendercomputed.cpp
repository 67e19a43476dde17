// SPDX-License-Identifier: Apache-2.0
// Pictures that programs compute: as on graphics cards, by a processor here, which by itself would draw them.
#include <epoxy/gl.h>

#include "tests/ui/renderscenes.h"

#include <QtTest/QtTest>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace ps;
using namespace ps::testing;

namespace {

using Image = std::vector<uint8_t>;

/// A texture of one size, of storage that may change or not, in a framebuffer.
struct Sheet {
  Sheet(GLenum format, bool fixed, int width, int height) {
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    if (fixed)
      glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    else
      glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glClearColor(1, 0, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  ~Sheet() {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
  }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  Image read(int width, int height) const {
    Image pixels(static_cast<size_t>(width * height * 4));
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
  }
  GLuint framebuffer = 0, texture = 0;
};

Shot shotFrom(double distance) {
  Shot shot;
  shot.camera.target = {0, 0.1, 0};
  shot.camera.distance = distance;
  return shot;
}

/// A red square in a hand, which a block stands partly before.
Props hand() {
  const auto at = [](float x, float y) { return MeshVertex{{x, y, 0.08f}, {0, 0, 1}, {0.9f, 0.1f, 0.1f, 0}}; };
  return {{at(-0.2f, 0.1f), at(0.2f, 0.1f), at(0.2f, 0.3f), at(-0.2f, 0.1f), at(0.2f, 0.3f), at(-0.2f, 0.3f)}, {}, {}};
}

/// Clear liquid, which casts no shadow.
Snapshot puddle() {
  Snapshot s;
  s.materialLook = {{0.75f, 0.87f, 0.98f, 1}};
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k)
      addParticle(s, {i * 0.02 - 0.19, 0.01, k * 0.02 - 0.19}, 0.0124, static_cast<uint32_t>(20 * i + k),
                  api::Motion::Liquid, 300);
  return s;
}

Look ghostly() {
  Look look;
  auto other = std::make_shared<Snapshot>(everything());
  for (api::Float4& p : other->position) p.x += 0.12f;
  look.ghost = Ghost{other, {1, 0, 1}, {1, 1, 1}, 1.5f};
  look.outline = BodyOutline{{0}, {1, 1, 0}, {0, 0, 0}};
  return look;
}

Look cut() {
  Look look;
  look.section = Section{{Vector3(0, 0, -1), 0}};
  look.guides = {{{-0.4, 0.1, 0}, {0.4, 0.3, 0}, 1}};
  return look;
}

}  // namespace

class TestRenderComputed : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context = std::make_unique<HeadlessContext>(); }
  void cleanupTestCase() { m_context.reset(); }

  void picturesAreAsDrawn_data();
  void picturesAreAsDrawn();
  void whatWasThereBeforeLeavesNothing();
  void textureOfTheTargetIsWritten_data();
  void textureOfTheTargetIsWritten();
  void whatNobodySeesIsLeftOut_data();
  void whatNobodySeesIsLeftOut();
  void restoresWhatProgramsUse();
  void leavesNothingBehind();
  void passesTakeTime_data();
  void passesTakeTime();

 private:
  std::unique_ptr<HeadlessContext> m_context;
};

void TestRenderComputed::picturesAreAsDrawn_data() {
  QTest::addColumn<QString>("kind");
  QTest::addColumn<double>("distance");
  QTest::addColumn<double>("elevation");
  QTest::addColumn<double>("mean");   // difference, levels of 255
  QTest::addColumn<double>("share");  // of channels that may be far off, %
  QTest::newRow("dark") << QString("dark") << 1.5 << 20.0 << 0.3 << 0.1;
  QTest::newRow("light") << QString("light") << 1.5 << 20.0 << 0.3 << 0.1;
  QTest::newRow("by temperature") << QString("temperature") << 1.5 << 20.0 << 0.3 << 0.1;
  QTest::newRow("a still") << QString("still") << 1.5 << 20.0 << 0.3 << 0.1;
  QTest::newRow("from below") << QString("dark") << 1.5 << -40.0 << 0.3 << 0.1;
  QTest::newRow("near") << QString("dark") << 0.35 << 20.0 << 0.3 << 0.1;
  QTest::newRow("from within") << QString("dark") << 0.02 << 20.0 << 0.3 << 1.0;
  QTest::newRow("liquid at the edge") << QString("edge") << 0.5 << 20.0 << 0.3 << 0.1;
  QTest::newRow("liquid beyond the edge") << QString("beyond") << 0.5 << 20.0 << 0.3 << 0.1;
  QTest::newRow("a hand") << QString("hand") << 1.0 << 10.0 << 0.3 << 0.1;
  QTest::newRow("backdrop") << QString("backdrop") << 1.5 << 20.0 << 0.3 << 0.1;
  QTest::newRow("section") << QString("section") << 1.5 << 20.0 << 0.3 << 0.1;
  // A processor smooths edges only where there may be some of the scene's own.
  QTest::newRow("ghost and outline") << QString("ghost") << 1.5 << 20.0 << 1.5 << 1.5;
}

/// Each pixel within rounding of the drawn one, but for edges: on average a quarter of a level or so.
void TestRenderComputed::picturesAreAsDrawn() {
  QFETCH(QString, kind);
  QFETCH(double, distance);
  QFETCH(double, elevation);
  QFETCH(double, mean);
  QFETCH(double, share);
  Shot shot = shotFrom(distance);
  if (kind == QStringLiteral("ghost")) shot.look = ghostly();
  if (kind == QStringLiteral("section")) shot.look = cut();
  if (kind == QStringLiteral("edge")) shot.camera.target = {0.3, 0.1, 0.1};
  if (kind == QStringLiteral("beyond")) shot.camera.target = {0.8, 0.1, 0};
  if (kind == QStringLiteral("backdrop")) shot.look.backdrop = std::array<float, 3>{0.3f, 0.5f, 0.3f};
  if (kind == QStringLiteral("temperature")) shot.look.colour = "temperature";
  shot.look.dark = kind != QStringLiteral("light");
  shot.camera.elevation = elevation;
  shot.size.still = kind == QStringLiteral("still");
  std::vector<Image> images;
  for (const PixelWork work : {PixelWork::Drawn, PixelWork::Computed, PixelWork::Computed}) {
    Renderer renderer(work);
    if (kind == QStringLiteral("hand")) renderer.show(hand());
    images.push_back(renderImage(renderer, everything(), tray(), shot));
  }
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  QVERIFY(images[1] == images[2]);  // whatever order the card went in
  double sum = 0, far = 0;
  for (size_t i = 0; i < images[0].size(); ++i) {
    const int off = std::abs(int{images[0][i]} - int{images[1][i]});
    sum += off;
    far += off > 40;
  }
  const auto count = static_cast<double>(images[0].size());
  QVERIFY2(sum / count < mean && 100 * far / count < share,
           qPrintable(QStringLiteral("%1 levels, %2 %").arg(sum / count).arg(100 * far / count)));
}

/// Neither a shadow, nor in lists of which there are none any more: each picture is as a renderer's first one.
void TestRenderComputed::whatWasThereBeforeLeavesNothing() {
  const Shot shot = shotFrom(1.2);
  const RenderScene stands = tray(), bare;
  const Snapshot all = everything(), liquid = puddle(), none;
  using Scene = std::pair<const Snapshot*, const RenderScene*>;
  Renderer renderer(PixelWork::Computed);
  for (const auto& [matter, scene] : {Scene{&all, &stands},
                                      {&liquid, &stands},
                                      {&liquid, &stands},
                                      {&none, &bare},
                                      {&all, &bare},
                                      {&liquid, &bare},
                                      {&all, &stands}}) {
    Renderer first(PixelWork::Computed);
    QVERIFY(renderImage(renderer, *matter, *scene, shot) == renderImage(first, *matter, *scene, shot));
  }
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

void TestRenderComputed::textureOfTheTargetIsWritten_data() {
  QTest::addColumn<uint>("format");
  QTest::addColumn<bool>("fixed");
  QTest::newRow("RGBA8") << uint{GL_RGBA8} << false;
  QTest::newRow("sRGB, as headsets have it") << uint{GL_SRGB8_ALPHA8} << true;
  QTest::newRow("sRGB that may change: a copy") << uint{GL_SRGB8_ALPHA8} << false;
}

/// Known or not, it gets the same picture at its place, bit by bit, and nothing around it.
void TestRenderComputed::textureOfTheTargetIsWritten() {
  QFETCH(uint, format);
  QFETCH(bool, fixed);
  constexpr int kWide = kWidth + 40, kHigh = kHeight + 30;
  Renderer renderer(PixelWork::Computed);
  const Shot shot = shotFrom(1.5);
  renderer.prepare(everything(), nullptr, 1, tray(), shot.look);
  std::vector<Image> images;
  for (const bool known : {false, true}) {
    const Sheet sheet(format, fixed, kWide, kHigh);
    renderer.draw(shot.eye(), {sheet.framebuffer, 17, 11, shot.size, known ? sheet.texture : 0});
    images.push_back(sheet.read(kWide, kHigh));
    const auto at = [&](int x, int y) { return images.back()[static_cast<size_t>(y * kWide + x) * 4 + 1]; };
    for (int x = 0; x < kWide; ++x) QVERIFY(at(x, 10) == 0 && at(x, 11 + kHeight) == 0);
    QVERIFY(at(16, 100) == 0 && at(17 + kWidth, 100) == 0 && at(17, 11) > 0 && at(16 + kWidth, 10 + kHeight) > 0);
  }
  QVERIFY(images[0] == images[1]);
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

void TestRenderComputed::whatNobodySeesIsLeftOut_data() {
  QTest::addColumn<bool>("computed");
  QTest::addColumn<bool>("ghost");
  for (const bool computed : {false, true})
    for (const bool ghost : {false, true})
      QTest::addRow("%s%s", computed ? "computed" : "drawn", ghost ? ", with a ghost" : "") << computed << ghost;
}

/// The left third of the picture, which its panel covers too, and a fleck that is too small for a tile: black, but for
/// an edge of two tiles at most; all the rest is as without a mask, but for what looks over the edge.
void TestRenderComputed::whatNobodySeesIsLeftOut() {
  QFETCH(bool, computed);
  QFETCH(bool, ghost);
  constexpr int kHidden = kWidth / 3, kEdge = 32, kOver = 16;  // pixels
  Shot shot = shotFrom(0.7);
  if (ghost) shot.look = ghostly();
  const Eye eye = eyeThrough(viewMatrix(shot.camera), -0.4, 0.5, -0.3, 0.2, 0.03, 10);
  const auto tangent = [&](double x) { return static_cast<float>(-0.4 + 0.9 * x / kWidth); };
  const float edge = tangent(kHidden);
  // Both senses of rotation; and far beyond the picture, as masks may reach.
  auto hidden = std::make_shared<HiddenTriangles>(HiddenTriangles{{-0.4f, -0.3f},
                                                                  {edge, -0.3f},
                                                                  {edge, 0.2f},
                                                                  {-2, 0.2f},
                                                                  {edge, 0.2f},
                                                                  {-0.4f, -0.3f},
                                                                  {-2, 0.2f},
                                                                  {-2, -0.3f},
                                                                  {-0.4f, -0.3f},
                                                                  {0.3f, 0},
                                                                  {0.31f, 0},
                                                                  {0.3f, 0.01f}});
  Renderer renderer(computed ? PixelWork::Computed : PixelWork::Drawn);
  renderer.show(hand());
  renderer.prepare(everything(), nullptr, 1, tray(), shot.look);
  std::vector<Image> images;
  for (const auto& mask : {std::shared_ptr<HiddenTriangles>(), hidden, hidden, std::shared_ptr<HiddenTriangles>()}) {
    const Sheet sheet(GL_RGBA8, true, kWidth, kHeight);
    renderer.draw(eye, {sheet.framebuffer, 0, 0, shot.size, sheet.texture, mask});
    images.push_back(sheet.read(kWidth, kHeight));
  }
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  QVERIFY(images[1] == images[2]);
  QVERIFY(images[0] == images[3]);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      for (int k = 0; k < 3; ++k) {
        const size_t at = static_cast<size_t>((y * kWidth + x) * 4 + k);
        const int whole = images[0][at], masked = images[1][at];
        const bool left = x < kHidden - kEdge, near = x < kHidden + kOver;
        QVERIFY2(left ? masked == 0 : near || masked == whole,
                 qPrintable(QStringLiteral("%1, %2: %3, %4").arg(x).arg(y).arg(masked).arg(whole)));
      }
}

void TestRenderComputed::restoresWhatProgramsUse() {
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
  glBufferData(GL_SHADER_STORAGE_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 2, buffer, 256, 512);
  const Sheet sheet(GL_RGBA8, false, 64, 64);
  glBindImageTexture(1, sheet.texture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
  {
    Renderer renderer(PixelWork::Computed);
    renderImage(renderer, everything(), tray(), shotFrom(1.5));
  }
  const auto is = [](GLenum name, GLuint index, GLint expected) {
    GLint value = -1;
    glGetIntegeri_v(name, index, &value);
    return value == expected;
  };
  GLint bound = 0;
  GLint64 start = 0, size = 0;
  glGetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &bound);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, 2, &start);
  glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, 2, &size);
  QCOMPARE(bound, static_cast<GLint>(buffer));
  QVERIFY(is(GL_SHADER_STORAGE_BUFFER_BINDING, 2, static_cast<GLint>(buffer)) && start == 256 && size == 512);
  QVERIFY(is(GL_SHADER_STORAGE_BUFFER_BINDING, 0, 0));
  QVERIFY(is(GL_IMAGE_BINDING_NAME, 1, static_cast<GLint>(sheet.texture)));
  QVERIFY(is(GL_IMAGE_BINDING_ACCESS, 1, GL_READ_WRITE) && is(GL_IMAGE_BINDING_NAME, 0, 0));
  QCOMPARE(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  glBindImageTexture(1, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, 0);
  glDeleteBuffers(1, &buffer);
}

void TestRenderComputed::leavesNothingBehind() {
  const Sheet sheet(GL_SRGB8_ALPHA8, true, kWidth, kHeight);
  const auto before = objectsInUse();
  {
    Renderer renderer(PixelWork::Computed);
    std::vector<PassTime> times;
    renderer.timePasses(&times);
    const Shot shot = shotFrom(1.5);
    renderer.prepare(everything(), nullptr, 1, tray(), ghostly());
    for (int i = 0; i < 3; ++i) renderer.draw(shot.eye(), {sheet.framebuffer, 0, 0, shot.size, sheet.texture});
  }
  QVERIFY(objectsInUse() == before);
}

void TestRenderComputed::passesTakeTime_data() {
  QTest::addColumn<bool>("computed");
  QTest::newRow("drawn") << false;
  QTest::newRow("computed") << true;
}

/// Each pass once, however often a picture was made, with a time that rises; nothing any more when nobody asks.
void TestRenderComputed::passesTakeTime() {
  QFETCH(bool, computed);
  Renderer renderer(computed ? PixelWork::Computed : PixelWork::Drawn);
  const Shot shot = shotFrom(1.5);
  std::vector<PassTime> times;
  renderer.timePasses(&times);
  renderImage(renderer, everything(), tray(), shot);
  const auto sum = [&] {
    double all = 0;
    for (const PassTime& time : times) all += time.milliseconds;
    return all;
  };
  const double once = sum();
  const size_t passes = times.size();
  renderImage(renderer, everything(), tray(), shot);
  const double twice = sum();
  QCOMPARE(times.size(), passes);
  QVERIFY(once > 0 && twice > once);
  std::set<std::string> names;
  for (const PassTime& time : times) names.insert(time.pass);
  QCOMPARE(names.size(), passes);
  for (const char* pass : {"matter uploaded", "view uploaded", "shadow", "surfaces", "occlusion", "light",
                           "liquid's light", "vapour", "final", "outline", "panels", "hidden parts"})
    QVERIFY2(names.count(pass), pass);
  renderer.timePasses(nullptr);
  renderImage(renderer, everything(), tray(), shot);
  QCOMPARE(sum(), twice);
}

QTEST_GUILESS_MAIN(TestRenderComputed)
#include "tst_rendercomputed.moc"
