// SPDX-License-Identifier: Apache-2.0
// Swatches of materials: drawn from their matter, kept, and given up where there is no OpenGL.
#include "ui/film/sceneshot.h"
#include "ui/library/materialcard.h"
#include "ui/session/cachefolder.h"
#include "ui/session/swatches.h"
#include "ui/theme/paint.h"

#include <QtCore/QDateTime>
#include <QtCore/QDir>
#include <QtCore/QElapsedTimer>
#include <QtCore/QFileInfo>
#include <QtCore/QProcess>
#include <QtCore/QStandardPaths>
#include <QtGui/QPainter>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <algorithm>
#include <limits>
#include <memory>

using namespace ps;

namespace {

constexpr int kSide = 64;     // pixels
constexpr int kLong = 30000;  // ms; software rendering on a busy machine
constexpr int kFaint = 16;    // of 255, below which nobody sees a pixel
constexpr double kClear = 1;  // clearness of water
const QColor kRed(204, 38, 38), kBlue(38, 64, 204);

LibraryEntry entryOf(const QColor& colour, api::Phase phase, double clearness = 0) {
  LibraryEntry entry;
  entry.colour = colour;
  entry.values.properties = {{"color_red", colour.redF()},
                             {"color_green", colour.greenF()},
                             {"color_blue", colour.blueF()},
                             {"clearness", clearness}};
  entry.bands = {{0, std::numeric_limits<double>::infinity(), phase}};
  return entry;
}

Swatch sample(const QColor& colour, api::Phase phase, double clearness = 0) {
  return swatchOf(entryOf(colour, phase, clearness));
}

/// What a card has in the swatch's place, on a ground of its own.
QImage painted(const Swatch& swatch, Swatches& swatches) {
  QImage image(kSide, kSide, QImage::Format_RGB32);
  image.fill(Qt::gray);
  QPainter painter(&image);
  paintSwatch(painter, image.rect(), swatch, swatches);
  return image;
}

QImage flat(const QColor& colour) {
  QImage image(kSide, kSide, QImage::Format_RGB32);
  image.fill(Qt::gray);
  QPainter painter(&image);
  constexpr double kEdge = kSide / 11.0;
  paintBall(painter, QRectF(image.rect()).adjusted(kEdge, kEdge, -kEdge, -kEdge), colour);
  return image;
}

struct Sum {
  double red = 0, green = 0, blue = 0, share = 0;  ///< share: of the picture that is covered, 0..1
};
Sum sumOf(const QImage& picture) {
  Sum sum;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QRgb pixel = picture.pixel(x, y);  // not premultiplied
      const double hides = qAlpha(pixel) / 255.0;
      sum.red += hides * qRed(pixel), sum.green += hides * qGreen(pixel), sum.blue += hides * qBlue(pixel);
      sum.share += hides / (picture.width() * picture.height());
    }
  }
  return sum;
}

/// Of 255, the mean over pixels and channels.
double difference(const QImage& a, const QImage& b) {
  double sum = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      sum += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) + std::abs(qBlue(p) - qBlue(q)) +
             std::abs(qAlpha(p) - qAlpha(q));
    }
  }
  return sum / 4 / a.width() / a.height();
}

QString folder() { return QFileInfo(swatchPath({}, kSide)).path(); }
qsizetype keptPictures() { return QDir(folder()).entryList(QDir::Files).size(); }

}  // namespace

class TestSwatches : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { QStandardPaths::setTestModeEnabled(true); }
  void init() { QDir(folder()).removeRecursively(); }
  void cleanupTestCase() { QDir(folder()).removeRecursively(); }

  /// What nobody asked for in half a year, and what does not fit, the oldest first; what was left half written as well.
  void oldPicturesGo() {
    QVERIFY(QDir().mkpath(folder()));
    const auto put = [](const QString& name, int bytes, int days) {
      QFile file(folder() + QLatin1Char('/') + name);
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(QByteArray(bytes, 'x'));
      file.flush();
      file.setFileTime(QDateTime::currentDateTime().addDays(-days), QFileDevice::FileModificationTime);
    };
    put(QStringLiteral("new.png"), 100, 0);
    put(QStringLiteral("used.png"), 100, 40);
    put(QStringLiteral("large.png"), 100, 50);
    put(QStringLiteral("old.png"), 1, 200);
    useCached(folder() + QStringLiteral("/new.png"));
    tidyCache(folder(), {250, 180});
    const auto left = [] { return QDir(folder()).entryList(QDir::Files, QDir::Name); };
    QCOMPARE(left(), QStringList({QStringLiteral("new.png"), QStringLiteral("used.png")}));
    useCached(folder() + QStringLiteral("/used.png"));
    put(QStringLiteral("middle.png"), 100, 10);
    tidyCache(folder(), {250, 180});
    QCOMPARE(left(), QStringList({QStringLiteral("new.png"), QStringLiteral("used.png")}));
    put(QStringLiteral("old.png"), 1, 200);
    const Swatches swatches;
    QTRY_VERIFY(!QFile::exists(folder() + QStringLiteral("/old.png")));
  }

  /// On nothing, in its own colour, and so large that one sees it.
  void matterHasItsColour_data() {
    QTest::addColumn<QColor>("colour");
    QTest::addColumn<int>("phase");
    QTest::addColumn<double>("clearness");
    const auto solid = static_cast<int>(api::Phase::Solid), liquid = static_cast<int>(api::Phase::Liquid),
               gas = static_cast<int>(api::Phase::Gas);
    QTest::newRow("red solid") << kRed << solid << 0.0;
    QTest::newRow("blue solid") << kBlue << solid << 0.0;
    QTest::newRow("clear red solid") << kRed << solid << kClear;
    QTest::newRow("red liquid") << kRed << liquid << 0.0;
    QTest::newRow("blue liquid") << kBlue << liquid << 0.0;
    QTest::newRow("clear blue liquid") << kBlue << liquid << kClear;
    QTest::newRow("red gas") << kRed << gas << 0.0;
    QTest::newRow("blue gas") << kBlue << gas << kClear;
  }
  void matterHasItsColour() {
    QFETCH(QColor, colour);
    QFETCH(int, phase);
    QFETCH(double, clearness);
    const QImage picture = drawn(sample(colour, static_cast<api::Phase>(phase), clearness));
    QCOMPARE(picture.size(), QSize(kSide, kSide));
    int edge = 0;
    for (int k = 0; k < kSide; ++k) {
      for (const QPoint& at : {QPoint(k, 0), QPoint(k, kSide - 1), QPoint(0, k), QPoint(kSide - 1, k)})
        edge = std::max(edge, qAlpha(picture.pixel(at)));
    }
    QVERIFY2(edge < kFaint, qPrintable(QString::number(edge)));  // none is cut off
    const Sum sum = sumOf(picture);
    QVERIFY2(sum.share > 0.15 && sum.share < 0.85, qPrintable(QString::number(sum.share)));
    const bool red = colour == kRed;
    QVERIFY2(red ? sum.red > 1.2 * sum.blue : sum.blue > 1.2 * sum.red,
             qPrintable(QStringLiteral("%1 %2").arg(sum.red).arg(sum.blue)));
  }

  void statesAreToldApart() {
    const QImage solid = drawn(sample(kRed, api::Phase::Solid)), liquid = drawn(sample(kRed, api::Phase::Liquid)),
                 gas = drawn(sample(kRed, api::Phase::Gas));
    constexpr double kSeen = 8;  // of 255 over all of the picture
    QVERIFY(difference(solid, liquid) > kSeen);
    QVERIFY(difference(liquid, gas) > kSeen);
    QVERIFY(difference(solid, gas) > kSeen);
  }

  /// The ground is seen through water and not through milk.
  void clearMatterShowsItsGround() {
    const QPoint middle(kSide / 2, kSide / 2);
    const int dense = qAlpha(drawn(sample(kBlue, api::Phase::Liquid)).pixel(middle));
    const int clear = qAlpha(drawn(sample(kBlue, api::Phase::Liquid, kClear)).pixel(middle));
    QCOMPARE(dense, 255);
    QVERIFY2(clear > kFaint && clear < 255 - kFaint, qPrintable(QString::number(clear)));
    QCOMPARE(qAlpha(drawn(sample(kBlue, api::Phase::Solid)).pixel(middle)), 255);
  }

  /// To look at, where PS_TEST_PICTURES names a folder: many looks on the grounds of both themes, at 100 and 200 %.
  void pictureOfMany() {
    const QString pictures = qEnvironmentVariable("PS_TEST_PICTURES");
    if (pictures.isEmpty()) return;
    const QColor silver(0x8c, 0x91, 0x99), cream(0xf5, 0xe6, 0xc2), water(0xbf, 0xde, 0xfa), honey(0xde, 0x8c, 0x1a),
        wood(0x8c, 0x5c, 0x33), dark(0x4a, 0x29, 0x1a), air(0xdb, 0xeb, 0xfc);
    const std::vector<Swatch> all{sample(silver, api::Phase::Solid),      sample(cream, api::Phase::Solid, 0.6),
                                  sample(kRed, api::Phase::Solid),        sample(wood, api::Phase::Solid),
                                  sample(dark, api::Phase::Solid),        sample(kRed, api::Phase::Solid, 0.8),
                                  sample(water, api::Phase::Solid, 1),    sample(water, api::Phase::Liquid, 1),
                                  sample(honey, api::Phase::Liquid, 1),   sample(silver, api::Phase::Liquid, 0),
                                  sample(kBlue, api::Phase::Liquid, 0.5), sample(air, api::Phase::Gas, 1),
                                  sample(kRed, api::Phase::Gas)};
    QImage sheet(static_cast<int>(all.size()) * 90, 300, QImage::Format_RGB32);
    QPainter painter(&sheet);
    for (const int row : {0, 1}) {
      painter.fillRect(0, row * 150, sheet.width(), 150, row ? QColor(0xec, 0xef, 0xf2) : QColor(0x26, 0x29, 0x2d));
      for (size_t k = 0; k < all.size(); ++k) {
        for (const int side : {44, 88})
          painter.drawImage(static_cast<int>(k) * 90, row * 150 + (side == 44 ? 8 : 58), drawn(all[k], side));
      }
    }
    QVERIFY(sheet.save(pictures + QStringLiteral("/tst_swatches.png")));
  }

  /// A ball of its colour stands for it until then, and again when the material has changed.
  void theFlatSwatchStandsUntilThePictureCame() {
    Swatches swatches;
    QSignalSpy arrived(&swatches, &Swatches::arrived);
    for (const QColor& colour : {kRed, kBlue}) {
      const Swatch swatch = sample(colour, api::Phase::Solid);
      QCOMPARE(painted(swatch, swatches), flat(colour));
      QTRY_VERIFY_WITH_TIMEOUT(painted(swatch, swatches) != flat(colour), kLong);
    }
    QCOMPARE(arrived.size(), 2);
    const QImage red = painted(sample(kRed, api::Phase::Solid), swatches);
    QVERIFY(difference(red, painted(sample(kBlue, api::Phase::Solid), swatches)) > 8);
    QCOMPARE(arrived.size(), 2);  // neither was drawn once more
  }

  /// Whoever asks later gets what was drawn: another picture that is put in its place shows that none is made.
  void whatWasDrawnIsKept() {
    const Swatch swatch = sample(kRed, api::Phase::Solid);
    QImage first;
    {
      Swatches swatches;
      QTRY_VERIFY_WITH_TIMEOUT(!(first = swatches.of(swatch, kSide)).isNull(), kLong);
    }
    QCOMPARE(keptPictures(), 1);
    QCOMPARE(askedFor(swatch), first);
    QImage other(kSide, kSide, QImage::Format_ARGB32_Premultiplied);
    other.fill(Qt::green);
    QVERIFY(other.save(swatchPath(swatch, kSide)));
    QCOMPARE(askedFor(swatch), other);
    // What is no picture any more is drawn again.
    QFile broken(swatchPath(swatch, kSide));
    QVERIFY(broken.open(QIODevice::WriteOnly) && broken.write("broken") > 0);
    broken.close();
    QCOMPARE(askedFor(swatch), first);
    QCOMPARE(QImage(swatchPath(swatch, kSide)).size(), first.size());
  }

  /// A card that is in sight does not wait for those that were asked for before it.
  void whatIsAskedForLastComesFirst() {
    Swatches swatches;
    constexpr int kMany = 30;
    for (int k = 0; k < kMany; ++k) QVERIFY(swatches.of(numbered(k), kSide).isNull());
    QVERIFY(swatches.of(numbered(1), kSide).isNull());  // once more
    const qsizetype begun = keptPictures() + 1;         // before all were asked for, and the one that is being drawn
    QTRY_COMPARE_WITH_TIMEOUT(keptPictures(), kMany, kLong);
    const auto when = [](int number) { return QFileInfo(swatchPath(numbered(number), kSide)).lastModified(); };
    qsizetype earlier = 0;
    for (int k = 2; k < kMany - 1; ++k) earlier += when(k) < std::max(when(1), when(kMany - 1)) ? 1 : 0;
    QVERIFY2(earlier <= begun, qPrintable(QStringLiteral("%1 of %2").arg(earlier).arg(begun)));
  }

  /// The interface has 16 ms for a picture of its own. The shortest of many: others may have the processor meanwhile.
  void askingHoldsNobodyUp() {
    Swatches swatches;
    qint64 shortest = std::numeric_limits<qint64>::max();
    for (int k = 0; k < 10; ++k) {
      QElapsedTimer taken;
      taken.start();
      QVERIFY(swatches.of(numbered(k), 512).isNull());
      shortest = std::min(shortest, taken.elapsed());
    }
    QVERIFY2(shortest < 16, qPrintable(QString::number(shortest)));
  }

  /// The others are given up.
  void closingWaitsForOnePictureAlone() {
    constexpr int kMany = 400;
    auto swatches = std::make_unique<Swatches>();
    QSignalSpy arrived(swatches.get(), &Swatches::arrived);
    for (int k = 0; k < kMany; ++k) QVERIFY(swatches->of(numbered(k), kSide).isNull());
    QVERIFY(arrived.wait(kLong));
    const qsizetype before = keptPictures();
    swatches.reset();
    QVERIFY2(keptPictures() <= before + 2, qPrintable(QStringLiteral("%1 %2").arg(before).arg(keptPictures())));
  }

  /// In a process that finds no driver: the flat swatch stays, and nobody is told.
  void withoutOpenGlTheFlatSwatchStays() {
    if (qEnvironmentVariableIsEmpty("PS_WITHOUT_OPENGL")) {
      QProcess self;
      QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
      environment.insert(QStringLiteral("PS_WITHOUT_OPENGL"), QStringLiteral("1"));
      environment.insert(QStringLiteral("__EGL_VENDOR_LIBRARY_DIRS"), folder() + QStringLiteral("/none"));
      environment.insert(QStringLiteral("__EGL_VENDOR_LIBRARY_FILENAMES"), QString());
      self.setProcessEnvironment(environment);
      self.setProcessChannelMode(QProcess::MergedChannels);
      self.start(QCoreApplication::applicationFilePath(), {QString::fromLatin1(QTest::currentTestFunction())});
      QVERIFY(self.waitForFinished(kLong));
      const QByteArray said = self.readAll();
      QVERIFY2(self.exitStatus() == QProcess::NormalExit && self.exitCode() == 0, said.constData());
      QVERIFY2(!said.contains("QWARN") && !said.contains("failed:"), said.constData());
      return;
    }
    QVERIFY_THROWS_EXCEPTION(std::exception, HeadlessContext());  // there is none, indeed
    Swatches swatches;
    QSignalSpy arrived(&swatches, &Swatches::arrived);
    const Swatch swatch = sample(kRed, api::Phase::Solid);
    QCOMPARE(painted(swatch, swatches), flat(kRed));
    QTRY_VERIFY_WITH_TIMEOUT(!swatches.canDraw(), kLong);
    QCOMPARE(painted(swatch, swatches), flat(kRed));
    QCOMPARE(painted(sample(kBlue, api::Phase::Gas), swatches), flat(kBlue));
    QCOMPARE(arrived.size(), 0);
    QCOMPARE(keptPictures(), 0);
  }

 private:
  QImage drawn(const Swatch& swatch, int side = kSide) {
    if (!m_painter) m_painter = std::make_unique<ShotPainter>();
    return m_painter->cutOut(shotOf(swatch), {side, side});
  }
  QImage askedFor(const Swatch& swatch) {
    Swatches swatches;
    QImage picture;
    [&] { QTRY_VERIFY_WITH_TIMEOUT(!(picture = swatches.of(swatch, kSide)).isNull(), kLong); }();
    return picture;
  }
  static Swatch numbered(int number) {
    return sample(QColor::fromHsv(number % 360, 200, 200 - number / 10), api::Phase::Solid);
  }
  std::unique_ptr<ShotPainter> m_painter;
};

QTEST_MAIN(TestSwatches)
#include "tst_swatches.moc"
