// SPDX-License-Identifier: Apache-2.0
// Phases in the view, told apart without their colours: by how light they are, or by their pattern, whichever way the
// picture is made.
#include "tests/ui/renderscenes.h"
#include "ui/render/colourmap.h"

#include <QtTest/QtTest>

#include <cmath>
#include <vector>

using namespace ps;
using namespace ps::testing;

namespace {

constexpr double kSpacing = 0.02;
constexpr int kAcross = 30, kPart = 96;  // pixels around the middle that are looked at

/// A wall of one phase, upright and across the view.
Snapshot wall(api::Phase phase, api::Motion motion) {
  Snapshot s;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      addParticle(s, {(i - kAcross / 2) * kSpacing, 0.3 + (j - kAcross / 2) * kSpacing, 0}, 0.62 * kSpacing,
                  static_cast<uint32_t>(i * kAcross + j), motion);
      s.phase.back() = phase;
    }
  return s;
}

/// How light the pixels in the middle are, without colour.
std::vector<double> greys(PixelWork work, api::Phase phase, api::Motion motion, const std::string& colour) {
  Renderer renderer(work);
  Shot shot;
  shot.look.colour = colour;
  shot.camera = Camera{{0, 0.3, 0}, 1, 0, 0};
  const auto image = renderImage(renderer, wall(phase, motion), RenderScene{}, shot);
  std::vector<double> out;
  for (int y = (kHeight - kPart) / 2; y < (kHeight + kPart) / 2; ++y)
    for (int x = (kWidth - kPart) / 2; x < (kWidth + kPart) / 2; ++x) {
      const uint8_t* c = &image[4 * (static_cast<size_t>(y) * kWidth + static_cast<size_t>(x))];
      out.push_back((0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]) / 255);
    }
  return out;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Of two pictures, each made as light as the other: what is left is pattern.
double differenceOf(const std::vector<double>& a, const std::vector<double>& b) {
  const double meanA = meanOf(a), meanB = meanOf(b);
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::pow(a[i] / meanA - b[i] / meanB, 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

class TestRenderPhases : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_context = std::make_unique<HeadlessContext>(); }

  void patternsAreOfPhasesAlone() {
    using render::Pattern;
    QCOMPARE(render::patternOf("phase", 0), Pattern::Plain);
    QCOMPARE(render::patternOf("phase", 1), Pattern::Stripes);
    QCOMPARE(render::patternOf("phase", 2), Pattern::Dots);
    QCOMPARE(render::patternOf("phase", 3), Pattern::Checks);
    QCOMPARE(render::patternOf("phase", 4), Pattern::Plain);
    for (const float odd : {-1.f, 5.f, 1e9f, std::nanf("")}) QCOMPARE(render::patternOf("phase", odd), Pattern::Plain);
    QCOMPARE(render::patternOf("temperature", 1), Pattern::Plain);
  }

  void phasesAreToldApartInGrey_data() {
    QTest::addColumn<PixelWork>("work");
    QTest::addColumn<api::Motion>("motion");
    QTest::newRow("balls, drawn") << PixelWork::Drawn << api::Motion::Solid;
    QTest::newRow("balls, computed") << PixelWork::Computed << api::Motion::Solid;
    QTest::newRow("surfaces, drawn") << PixelWork::Drawn << api::Motion::Liquid;
    QTest::newRow("surfaces, computed") << PixelWork::Computed << api::Motion::Liquid;
  }
  void phasesAreToldApartInGrey() {
    QFETCH(PixelWork, work);
    QFETCH(api::Motion, motion);
    const api::Phase phases[] = {api::Phase::Solid, api::Phase::Melting, api::Phase::Liquid, api::Phase::Boiling,
                                 api::Phase::Gas};
    std::vector<std::vector<double>> pictures;
    for (const api::Phase phase : phases) pictures.push_back(greys(work, phase, motion, "phase"));
    for (size_t i = 0; i < pictures.size(); ++i)
      for (size_t j = 0; j < i; ++j) {
        const double a = meanOf(pictures[i]), b = meanOf(pictures[j]);
        const double lightness = std::max(a, b) / std::min(a, b), pattern = differenceOf(pictures[i], pictures[j]);
        QVERIFY2(
            lightness > 1.6 || pattern > 0.12,
            qPrintable(
                QStringLiteral("%1 and %2: %3 times as light, pattern %4").arg(i).arg(j).arg(lightness).arg(pattern)));
      }
    // Only colours of phases have patterns: by another field all phases are one picture.
    QVERIFY(differenceOf(greys(work, api::Phase::Solid, motion, "speed"),
                         greys(work, api::Phase::Boiling, motion, "speed")) < 1e-9);
  }

  /// But for edges, which are smoothed only where the scene may have some of its own.
  void bothWaysGiveOnePicture() {
    for (const api::Motion motion : {api::Motion::Solid, api::Motion::Liquid})
      for (const api::Phase phase : {api::Phase::Melting, api::Phase::Liquid, api::Phase::Boiling}) {
        const auto drawn = greys(PixelWork::Drawn, phase, motion, "phase");
        const auto computed = greys(PixelWork::Computed, phase, motion, "phase");
        double sum = 0;
        for (size_t i = 0; i < drawn.size(); ++i) sum += std::abs(drawn[i] - computed[i]);
        const double levels = 255 * sum / static_cast<double>(drawn.size());
        QVERIFY2(levels < 5, qPrintable(QStringLiteral("%1 levels").arg(levels)));
      }
  }

 private:
  std::unique_ptr<HeadlessContext> m_context;
};

QTEST_GUILESS_MAIN(TestRenderPhases)
#include "tst_renderphases.moc"
