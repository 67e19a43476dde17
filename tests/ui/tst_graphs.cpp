// SPDX-License-Identifier: Apache-2.0
#include "tests/ui/paintedtexts.h"
#include "tests/ui/rowtesting.h"
#include "ui/graphs/graphview.h"
#include "ui/graphs/sampleseries.h"
#include "ui/graphs/stackview.h"
#include "ui/theme/numbers.h"
#include "ui/theme/theme.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QSet>
#include <QtGui/QAccessible>
#include <QtTest/QSignalSpy>

#include <algorithm>
#include <random>
#include <set>

using namespace ps;
using namespace ps::testing;

class TestGraphs : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void ticksAreNice_data();
  void ticksAreNice();
  void noSpikeIsLost();
  void joinedSamplesKeepExtremes();
  void theTimeOfTheLastSampleReplacesIt();
  void labelsKeepTheDigitsOfTheAxis_data();
  void labelsKeepTheDigitsOfTheAxis();
  void graphPaintsASpike();
  void graphZoomsPansAndFits();
  void graphSeeks();
  void ticksTellApart_data();
  void ticksTellApart();
  void labelsKeepClearOfTheTitle_data();
  void labelsKeepClearOfTheTitle();
  void everyLineIsNamed_data();
  void everyLineIsNamed();
  void namesOfMarkersLieBesideLabels();
  void stackAddsUp();
  void labelsOfAStackCanBeReadOverIt();
  void whatMeltsIsHatched();
  void unitsTakePrefixes();
  void nothingIsNoData();
  void paintingDoesNotGrowWithSamples();
  void seriesAddUp();
  void valuesKeepTheirWidth();
  void decadesHaveTicks();
  void whatIsLostStacksDownwards();
  void aCurveIsComparedWithItsReference();
  void graphsAreAccessible();
};

void TestGraphs::ticksAreNice_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<int>("most");
  QTest::addColumn<double>("step");
  QTest::addColumn<int>("decimals");
  QTest::newRow("minute") << 0.0 << 60.0 << 7 << 10.0 << 0;
  QTest::newRow("celsius") << -14.0 << 130.0 << 3 << 50.0 << 0;
  QTest::newRow("tenths") << 0.0 << 1.0 << 5 << 0.25 << 2;
  QTest::newRow("small") << 0.0 << 3e-6 << 4 << 1e-6 << 6;
  QTest::newRow("large") << 0.0 << 7e6 << 4 << 2e6 << 0;
}

void TestGraphs::ticksAreNice() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(int, most);
  QFETCH(double, step);
  QFETCH(int, decimals);
  const Ticks ticks = niceTicks(low, high, most);
  QVERIFY2(std::abs(ticks.step - step) < 1e-9 * step, qPrintable(QString::number(ticks.step)));
  QCOMPARE(ticks.decimals, decimals);
  QVERIFY(ticks.count >= 1 && ticks.count <= most);
  QVERIFY(ticks.first >= low - 1e-9 * step && ticks.at(ticks.count - 1) <= high + 1e-9 * step);
  QCOMPARE(niceTicks(1, 1, 5).count, 0);
  QCOMPARE(niceTicks(0, kNaN, 5).count, 0);
}

/// Extents of random ranges agree with a plain walk over all samples.
void TestGraphs::noSpikeIsLost() {
  std::mt19937 random(7);
  GraphView graph;
  const int series = graph.addSeries(QStringLiteral("a"));
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) {
    values.push_back(static_cast<double>(random() % 1000) / 1000 + (random() % 997 == 0 ? 50 : 0));
    graph.append(series, i / 60.0, values.back());
  }
  for (int trial = 0; trial < 500; ++trial) {
    size_t first = random() % values.size(), last = random() % values.size();
    if (first > last) std::swap(first, last);
    ++last;
    const auto [low, high] = std::minmax_element(values.begin() + static_cast<ptrdiff_t>(first),
                                                 values.begin() + static_cast<ptrdiff_t>(last));
    // Half a sample before the first and the last: the range is half open.
    const auto extent =
        graph.extent(series, (static_cast<double>(first) - 0.5) / 60, (static_cast<double>(last) - 0.5) / 60);
    QCOMPARE(extent.first, *low);
    QCOMPARE(extent.second, *high);
  }
}

/// Past the capacity neighbours are joined; memory stays bounded and every extreme stays.
void TestGraphs::joinedSamplesKeepExtremes() {
  SampleSeries series;
  const size_t count = 3 * SampleSeries::kCapacity;
  for (size_t i = 0; i < count; ++i) {
    const bool spike = i == 12345 || i == count - 777;
    series.append(static_cast<double>(i), i == 500000   ? kNaN
                                          : spike       ? 99
                                          : i == 300001 ? -99
                                                        : std::sin(static_cast<double>(i)));
  }
  QVERIFY(series.size() <= SampleSeries::kCapacity);
  const auto all = series.extent(0, series.size());
  QCOMPARE(all.high, 99.0);
  QCOMPARE(all.low, -99.0);
  const auto early = series.extent(series.indexAt(12000), series.indexAt(13000));
  QCOMPARE(early.high, 99.0);
  const auto calm = series.extent(series.indexAt(20000), series.indexAt(290000));
  QVERIFY(calm.high <= 1 && calm.low >= -1);
  QCOMPARE(series.lastValue(), std::sin(static_cast<double>(count - 1)));
  series.append(5, 1000);  // earlier than the last: ignored
  QCOMPARE(series.extent(0, series.size()).high, 99.0);
}

/// What was edited at a frame that is drawn already takes the place of its older values, in blocks and in joined
/// samples too.
void TestGraphs::theTimeOfTheLastSampleReplacesIt() {
  SampleSeries series;
  series.append(0, 5);
  series.append(0, -3);
  QCOMPARE(series.size(), size_t{1});
  QCOMPARE(series.lastValue(), -3.0);
  QCOMPARE(series.extent(0, 1).high, -3.0);
  series.append(0, kNaN);
  QVERIFY(series.extent(0, 1).empty());
  for (size_t i = 1; i < 3 * SampleSeries::kBlock; ++i) series.append(static_cast<double>(i), 1);
  series.append(series.lastTime(), 70);
  QCOMPARE(series.extent(0, series.size()).high, 70.0);
  series.append(series.lastTime(), 2);
  QCOMPARE(series.extent(0, series.size()).high, 2.0);
  for (size_t i = series.size(); i <= SampleSeries::kCapacity + 1; ++i) series.append(static_cast<double>(i), 1);
  QVERIFY(series.size() < SampleSeries::kCapacity);  // joined: the last sample stands for two
  const auto last = static_cast<double>(SampleSeries::kCapacity + 1);
  series.append(last, 90);
  series.append(last, 3);
  QCOMPARE(series.extent(0, series.size()).high, 3.0);
  QCOMPARE(series[series.size() - 1].low, 1.0);
  QCOMPARE(series[series.size() - 1].high, 3.0);
  series.append(last - 1, 90);  // earlier than the last: ignored
  QCOMPARE(series.extent(0, series.size()).high, 3.0);
}

void TestGraphs::labelsKeepTheDigitsOfTheAxis_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<double>("value");
  QTest::addColumn<QString>("text");
  QTest::newRow("nearly zero on tens") << -12.0 << 14.0 << -5.23e-4 << QStringLiteral("0.0");
  QTest::newRow("tens") << -12.0 << 60.0 << 43.21 << QStringLiteral("43.2");
  QTest::newRow("hundreds") << 0.0 << 600.0 << 431.26 << QStringLiteral("431.3");
  QTest::newRow("thousands") << 0.0 << 6000.0 << 4312.6 << QStringLiteral("4\u202F313");
  QTest::newRow("a hundred, closely") << 100.0 << 100.5 << 100.257 << QStringLiteral("100.3");
  QTest::newRow("parts") << 0.0 << 1.0 << 0.4567 << QStringLiteral("0.457");
  QTest::newRow("millionths") << 0.0 << 3e-6 << 2.5e-6 << QStringLiteral("2.50 × 10⁻⁶");
}

void TestGraphs::labelsKeepTheDigitsOfTheAxis() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(double, value);
  QFETCH(QString, text);
  QCOMPARE(curveText(niceTicks(low, high, 5), value), text);
}

/// One sample among 20,000 that is 40 times higher than the others reaches the top of the picture.
void TestGraphs::graphPaintsASpike() {
  GraphView graph;
  const int series = graph.addSeries(QStringLiteral("a"));
  for (int i = 0; i < 20000; ++i) graph.append(series, i / 60.0, i == 9876 ? 40 : 0);
  graph.resize(500, 150);
  const QImage image = graph.grab().toImage();
  const QColor colour = Theme::current().series(0);
  const QRectF plot = graph.plotRect();
  const double ratio = image.devicePixelRatio();
  const int x = static_cast<int>((plot.left() + plot.width() * 9876.0 / 20000) * ratio);
  int reached = image.height();
  for (int y = 0; y < image.height(); ++y) {
    for (int i = -2; i <= 2; ++i) {
      const QColor pixel = image.pixelColor(x + i, y);
      if (std::abs(pixel.blue() - colour.blue()) < 60 && std::abs(pixel.red() - colour.red()) < 60)
        reached = std::min(reached, y);
    }
  }
  // The scale leaves 12 % of the span below and a fifth above the data.
  QVERIFY2(reached < (plot.top() + 0.25 * plot.height()) * ratio, qPrintable(QString::number(reached)));
}

void TestGraphs::graphZoomsPansAndFits() {
  GraphView graph;
  const int series = graph.addSeries(QStringLiteral("a"));
  for (int i = 0; i <= 600; ++i) graph.append(series, i / 10.0, i);
  graph.setDuration(90);
  graph.resize(500, 150);
  show(graph, 500);
  QCOMPARE(graph.range(), (std::pair<double, double>{0, 90}));
  QSignalSpy told(&graph, &Plot::rangeChanged);
  const QPointF middle = graph.plotRect().center();
  wheel(graph, middle, 120);
  QVERIFY(!graph.isFitted());
  QVERIFY(std::abs(graph.range().second - graph.range().first - 72) < 1e-9);       // 0.8 of 90
  QVERIFY(std::abs((graph.range().second + graph.range().first) / 2 - 45) < 0.2);  // about the pointer, to a pixel
  const double before = graph.range().first;
  QTest::mousePress(&graph, Qt::LeftButton, {}, middle.toPoint());
  const QPointF to = middle + QPointF(50, 0);
  QMouseEvent move(QEvent::MouseMove, to, graph.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&graph, &move);
  QTest::mouseRelease(&graph, Qt::LeftButton, {}, to.toPoint());
  const double perPixel = 72 / graph.plotRect().width();
  QVERIFY(std::abs(graph.range().first - (before - 50 * perPixel)) < perPixel);
  QCOMPARE(told.count(), 2);
  QTest::mouseDClick(&graph, Qt::LeftButton, {}, middle.toPoint());
  QVERIFY(graph.isFitted());
  QCOMPARE(graph.range().second, 90.0);
  graph.append(series, 120, 1);
  QCOMPARE(graph.range().second, 120.0);  // the fitted range grows with the data
}

void TestGraphs::graphSeeks() {
  GraphView graph;
  graph.append(graph.addSeries(QStringLiteral("a")), 0, 1);
  graph.setDuration(60);
  graph.resize(500, 150);
  show(graph, 500);
  QSignalSpy asked(&graph, &TimePlot::seekRequested);
  QTest::mouseClick(&graph, Qt::LeftButton, {}, graph.plotRect().center().toPoint());
  QCOMPARE(asked.count(), 1);
  QVERIFY(std::abs(asked[0][0].toDouble() - 30) < 60 / graph.plotRect().width());
}

void TestGraphs::ticksTellApart_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::newRow("plain") << -10.0 << 20.0;
  QTest::newRow("hardly anything around minus ten") << -10.000002 << -9.999998;
  QTest::newRow("quarters") << 0.0 << 1.0;
  QTest::newRow("millionths") << 0.0 << 3e-6;
  QTest::newRow("a little around a million") << 1.0000001e6 << 1.0000004e6;
  QTest::newRow("millions") << 0.0 << 2.4e7;
  QTest::newRow("both sides") << -2.5e-5 << 2.5e-5;
}

void TestGraphs::ticksTellApart() {
  QFETCH(double, low);
  QFETCH(double, high);
  const Ticks ticks = niceTicks(low, high, 5);
  QVERIFY(ticks.count >= 2);
  QSet<QString> texts;
  for (int i = 0; i < ticks.count; ++i) {
    const QString text = tickText(ticks, i);
    texts.insert(text);
    const auto read = parseNumber(text);
    QVERIFY2(read && std::abs(*read - ticks.at(i)) < 1e-6 * ticks.step + 1e-15 * std::abs(high), qPrintable(text));
  }
  QCOMPARE(texts.size(), ticks.count);
}

void TestGraphs::labelsKeepClearOfTheTitle_data() {
  QTest::addColumn<int>("height");
  for (const int height : {80, 112, 132, 260}) QTest::addRow("%d", height) << height;
}

/// Where the title stands, nothing but the title and the grid is painted: not the highest line, nor the label at its
/// end.
void TestGraphs::labelsKeepClearOfTheTitle() {
  QFETCH(int, height);
  const auto picture = [&](const QString& title) {
    GraphView graph;
    graph.setTitle(title);
    for (int s = 0; s < 5; ++s) {
      const int series = graph.addSeries(QStringLiteral("Line %1").arg(s));
      for (int i = 0; i <= 10; ++i) graph.append(series, 0.3 * i, 100 - s + 0.1 * i);
    }
    graph.setDuration(60);
    graph.resize(440, height);
    return graph.grab().toImage();
  };
  const QImage with = picture(QStringLiteral("Temperature, °C")), without = picture({});
  const QColor ground = Theme::current()[Token::Field], grid = Theme::current()[Token::Line];
  int changed = 0;
  for (int y = 0; y < with.height(); ++y) {
    for (int x = 0; x < with.width(); ++x) {
      if (with.pixel(x, y) == without.pixel(x, y)) continue;
      ++changed;
      QVERIFY(without.pixelColor(x, y) == ground || without.pixelColor(x, y) == grid);
    }
  }
  QVERIFY(changed > 100);
}

void TestGraphs::everyLineIsNamed_data() {
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("lines");
  QTest::addColumn<QString>("name");
  QTest::addColumn<bool>("fits");
  QTest::newRow("one below the other") << 260 << 8 << "Line %1" << true;
  QTest::newRow("in columns") << 112 << 8 << "Line %1" << true;
  QTest::newRow("of long names") << 112 << 16 << "Mean temperature of the iron ball, line %1" << false;
  QTest::newRow("more than there is room for") << 80 << 40 << "Line %1" << false;
  QTest::newRow("no room at all") << 44 << 2 << "Line %1" << false;
}

/// In the plot, each apart from the others; where there is no room for a whole name, by the tip.
void TestGraphs::everyLineIsNamed() {
  QFETCH(int, height);
  QFETCH(int, lines);
  QFETCH(QString, name);
  QFETCH(bool, fits);
  GraphView graph;
  graph.setTitle(QStringLiteral("Temperature, °C"));
  QStringList names;
  for (int s = 0; s < lines; ++s) {
    names << name.arg(s, 2, 10, QLatin1Char('0'));
    const int series = graph.addSeries(names.last());
    for (int i = 0; i <= 10; ++i) graph.append(series, 0.3 * i, 100 - s + 0.1 * i);
  }
  graph.resize(440, height);
  std::vector<QRectF> places;
  for (const PaintedText& text : paintedBy(graph)) {
    const bool whole = names.contains(text.text), cut = text.text.endsWith(QChar(0x2026));
    if (!whole && !cut) continue;
    const QRectF place = text.place.adjusted(0, 2, 0, -2);  // lines of letters may touch
    QVERIFY(graph.plotRect().adjusted(0, 0, 4, 4).contains(place));
    for (const QRectF& other : places) QVERIFY2(!place.intersects(other), qPrintable(text.text));
    places.push_back(place);
  }
  if (fits) QCOMPARE(places.size(), static_cast<size_t>(lines));
  QCOMPARE(graph.toolTip(), fits ? QString() : names.join(QLatin1Char('\n')));
}

/// Labels of curves and layers, the title and names of markers lie apart; in a low plot markers lose theirs first.
void TestGraphs::namesOfMarkersLieBesideLabels() {
  const QString first = QStringLiteral("first drop"), line = QStringLiteral("Ice");
  PhaseStackView stack;
  GraphView graph;
  graph.setTitle(QStringLiteral("Temperature, °C"));
  const int series = graph.addSeries(line);
  for (int i = 0; i <= 10; ++i) {
    stack.append(i, {0.5, 0, 0.04, 0, 0});
    graph.append(series, i, 10.0 - i);  // its label ends in the corner where names begin
  }
  for (TimePlot* plot : {static_cast<TimePlot*>(&stack), static_cast<TimePlot*>(&graph)}) {
    plot->setMarkers({{8.9, first}, {9.1, QStringLiteral("second drop")}});
    plot->setPresentTime(9);
    for (const int height : {200, 60}) {
      plot->resize(420, height);
      bool named = false, labelled = false;
      std::vector<QRectF> places;
      for (const PaintedText& text : paintedBy(*plot)) {
        const QRectF place = text.place.adjusted(0, 2, 0, -2);     // lines of letters may touch
        if (!plot->plotRect().contains(place.center())) continue;  // numbers of axes
        for (const QRectF& other : places) QVERIFY2(!place.intersects(other), qPrintable(text.text));
        places.push_back(place);
        named = named || text.text == first;
        labelled = labelled || text.text == line || text.text.startsWith(QStringLiteral("solid"), Qt::CaseInsensitive);
      }
      QVERIFY(height == 60 || (named && labelled));
    }
  }
}

/// Looked back at, labels stand where the run goes on: on a ground of their own.
void TestGraphs::labelsOfAStackCanBeReadOverIt() {
  const auto coloured = [](double present) {
    EnergyStackView stack;
    for (double time = 0; time <= 10; time += 1) stack.append(time, {20, 20, 20, 20, 20}, 100);
    stack.resize(500, 220);
    stack.setPresentTime(present);
    const QImage image = stack.grab().toImage();
    const QRectF plot = stack.plotRect();
    const QRect after(static_cast<int>(plot.left() + 0.25 * plot.width()) + 30, static_cast<int>(plot.top()) + 20, 60,
                      static_cast<int>(plot.height()) - 40);
    int count = 0;
    for (int y = after.top(); y <= after.bottom(); ++y) {
      for (int x = after.left(); x <= after.right(); ++x) {
        for (int layer = 0; layer < 5; ++layer) count += image.pixelColor(x, y) == Theme::current().series(layer);
      }
    }
    return count;
  };
  // Five labels of 16 pixels.
  QVERIFY2(coloured(10) - coloured(2.5) > 0.8 * 5 * 16 * 60,
           qPrintable(QStringLiteral("%1 %2").arg(coloured(10)).arg(coloured(2.5))));
}

void TestGraphs::stackAddsUp() {
  PhaseStackView stack;
  stack.append(0, {1.0, 0, 0, 0, 0});
  stack.append(10, {0.25, 0.05, 0.5, 0.0, 0.2});
  QCOMPARE(stack.sampleCount(), size_t{2});
  stack.resize(400, 200);
  const QImage image = stack.grab().toImage();
  const QRectF plot = stack.plotRect();
  const double ratio = image.devicePixelRatio();
  // Just before the end, from the bottom up: solid to 0.25 of the total, then melting, liquid, gas.
  const auto at = [&](double share) {
    const double y = plot.bottom() - plot.height() * share * (1 - 22 / plot.height())  // the title has 22 pixels
        ;
    return image.pixelColor(static_cast<int>((plot.left() + 0.3 * plot.width()) * ratio), static_cast<int>(y * ratio));
  };
  // At 0.3 of the run solid is 0.775, liquid from 0.79 to 0.94 of the total.
  QCOMPARE(at(0.4), QColor(0x3A, 0x63, 0xB8));
  QCOMPARE(at(0.87), QColor(0x45, 0xC4, 0xB8));
  QCOMPARE(at(0.97), QColor(0xF5, 0xF1, 0xE6));
}

/// In grey what melts is as dark as what is solid: it is hatched.
void TestGraphs::whatMeltsIsHatched() {
  PhaseStackView stack;
  stack.append(0, {1.0, 1.0, 0, 0, 0});
  stack.append(10, {1.0, 1.0, 0, 0, 0});
  stack.resize(400, 200);
  const QImage image = stack.grab().toImage();
  const QRectF plot = stack.plotRect();
  const double ratio = image.devicePixelRatio();
  const auto colours = [&](double share) {
    std::set<QRgb> found;
    const auto y = static_cast<int>((plot.bottom() - (plot.height() - 22) * share) * ratio);
    for (int x = 0; x < 40; ++x) {
      for (int down = 0; down < 10; ++down)
        found.insert(image.pixel(static_cast<int>((plot.left() + 20) * ratio) + x, y + down));
    }
    return found;
  };
  QCOMPARE(colours(0.25).size(), size_t{1});
  QVERIFY(colours(0.75).size() > 1 && colours(0.75).contains(QColor(0xB5, 0x52, 0x8F).rgb()));
}

/// The axis takes the prefix that its values need, and says so; the read-out takes the one of each value.
void TestGraphs::unitsTakePrefixes() {
  PhaseStackView stack;
  stack.resize(400, 200);
  stack.append(0, {0.002, 0, 0, 0, 0});
  stack.grab();
  QCOMPARE(stack.axisTitle(), QStringLiteral("Mass by phase, g"));
  stack.append(1, {141, 0, 0.00154, 0, 0});
  stack.grab();
  QCOMPARE(stack.axisTitle(), QStringLiteral("Mass by phase, kg"));
  QVERIFY2(stack.summary().contains(QStringLiteral("141.0 kg")), qPrintable(stack.summary()));
  QVERIFY2(stack.summary().contains(QStringLiteral("1.540 g")), qPrintable(stack.summary()));
  GraphView graph;
  graph.resize(400, 200);
  graph.setTitle(QStringLiteral("Energy"));
  graph.setUnit(QStringLiteral("J"));
  graph.append(graph.addSeries(QStringLiteral("In matter")), 1, 76395660.018);
  graph.grab();
  QCOMPARE(graph.axisTitle(), QStringLiteral("Energy, MJ"));
  QVERIFY2(graph.summary().contains(QStringLiteral("In matter  76.40 MJ")), qPrintable(graph.summary()));
}

/// Samples without a value, or of no mass at all, leave the plot to its sentence.
void TestGraphs::nothingIsNoData() {
  GraphView graph;
  graph.addSeries(QStringLiteral("Mean"), QStringLiteral("°C"));
  graph.setEmptyText(QStringLiteral("No matter yet"));
  PhaseStackView stack;
  stack.setEmptyText(QStringLiteral("No matter yet"));
  for (int k = 0; k < 5; ++k) {
    graph.append(0, k, std::nan(""));
    stack.append(k, {0, 0, 0, 0, 0});
  }
  QCOMPARE(graph.summary(), QStringLiteral("No matter yet"));
  QCOMPARE(stack.summary(), QStringLiteral("No matter yet"));
  graph.append(0, 5, 20.0);
  stack.append(5, {0, 0, 1, 0, 0});
  QVERIFY(graph.summary().contains(QStringLiteral("Mean")));
  QVERIFY(stack.summary() != QStringLiteral("No matter yet"));
}

/// What a column reads does not grow with the number of samples: a walk over all of them takes a hundred times as long.
/// Both are painted in turn, so that a busy machine slows both; only the ratio counts, of the fastest of several.
void TestGraphs::paintingDoesNotGrowWithSamples() {
  constexpr int kSeries = 20, kFew = 10'000, kMany = 1'000'000;
  const auto filled = [](GraphView& graph, int samples) {
    std::mt19937 random(3);
    for (int s = 0; s < kSeries; ++s) {
      graph.addSeries(QString::number(s));
      double value = s;
      for (int i = 0; i < samples; ++i) {
        value += (static_cast<double>(random() % 1000) - 499.5) * 1e-5;
        graph.append(s, i / 60.0, value);
      }
    }
    graph.resize(960, 160);
  };
  GraphView few, many;
  filled(few, kFew);
  filled(many, kMany);
  QImage image(960, 160, QImage::Format_ARGB32_Premultiplied);
  const auto painted = [&image](GraphView& graph) {
    QElapsedTimer timer;
    timer.start();
    graph.render(&image);
    return static_cast<double>(timer.nsecsElapsed()) / 1e6;
  };
  double least[] = {1e9, 1e9};
  for (int i = 0; i < 10; ++i) {
    least[0] = std::min(least[0], painted(few));
    least[1] = std::min(least[1], painted(many));
  }
  qInfo("20 series of 10,000 samples are painted in %.2f ms, of 1,000,000 in %.2f ms", least[0], least[1]);
  QVERIFY2(least[1] < 5 * least[0], "a hundred times the samples take five times as long");
}

/// Areas below a line, and the lowest value above 0 of it for a logarithmic axis.
void TestGraphs::seriesAddUp() {
  SampleSeries series;
  for (int i = 0; i <= 100; ++i) series.append(i, i - 10);
  QVERIFY(std::abs(series.integral(20, 40) - 20 * 20) < 1e-9);
  QVERIFY(std::abs(series.integral(20.5, 21.5) - 11) < 1e-9);
  QCOMPARE(series.extent(0, 101).positive, 1.0);
  QCOMPARE(series.extent(0, 5).positive, SampleSeries::Extent().positive);
  series.append(101, kNaN);
  series.append(102, 5);
  QVERIFY(std::abs(series.integral(99, 102) - 89.5) < 1e-9);  // a gap counts for nothing
}

/// A value of any size keeps its decimals, so that its digits stand still while it runs.
void TestGraphs::valuesKeepTheirWidth() {
  const Ticks axis = niceTicks(-12, 130, 5);
  for (const double value : {-9.876, 0.0, 9.876, 99.96, 123.4})
    QCOMPARE(curveText(axis, value).section(QLatin1Char('.'), 1).size(), 1);
  QVERIFY(curveTextWidth(axis, -12, 130) > 0);
}

void TestGraphs::decadesHaveTicks() {
  const Ticks ticks = logTicks(0.02, 3000, 10);
  QCOMPARE(ticks.count, 5);
  QCOMPARE(tickText(ticks, 0), QStringLiteral("0.1"));
  QVERIFY(std::abs(ticks.at(4) - 1000) < 1e-9);
  QVERIFY(!logTicks(10, 30, 5).decades);
  ValueAxis axis;
  axis.logarithmic = true;
  axis.set({0.01, 100}, 5);
  QVERIFY(std::abs(axis.position(1) - 0.5) < 1e-12 && std::abs(axis.valueAt(0.75) - 10) < 1e-9);
  QVERIFY(axis.position(-1) < -100);
  axis.zoomAbout(0.5, 0.5);
  axis.set({0.01, 100}, 5);
  QVERIFY(std::abs(axis.low() - 0.1) < 1e-9 && std::abs(axis.high() - 10) < 1e-9);
}

/// Gains go up, losses down; the line says what they should add up to.
void TestGraphs::whatIsLostStacksDownwards() {
  EnergyStackView stack;
  stack.resize(500, 300);
  stack.append(0, {}, 0);
  stack.append(10, {.walls = 500, .air = -200}, 299.5);
  stack.grab();
  QVERIFY(stack.axes()[0].low() < -200 && stack.axes()[0].high() > 500);
  stack.setReading(0, 0.0);
  stack.setReading(1, 10.0);
  const std::vector<PlotLine> lines = stack.measured();
  QCOMPARE(lines[lines.size() - 2].value, QStringLiteral("300.0 J"));
  QCOMPARE(lines.back().value, QStringLiteral("−500 mJ"));
}

/// Between the cursors: how much it changes, how steeply, over what area, and how far its mean is from what is expected
/// of what stays beside that all the time.
void TestGraphs::aCurveIsComparedWithItsReference() {
  GraphView graph;
  graph.resize(500, 200);
  const int series = graph.addSeries(QStringLiteral("Water"), QStringLiteral("°C"));
  for (int second = 0; second <= 10; ++second) graph.append(series, second, 0.1 * second);
  graph.append(series, 20, 100);
  graph.setReferenceLines({{0, QStringLiteral("melts")}, {100, QStringLiteral("boils")}});
  graph.grab();
  graph.setReading(0, 0.0);
  graph.setReading(1, 10.0);
  const std::vector<PlotLine> lines = graph.measured();
  QCOMPARE(lines.size(), size_t{3});
  QCOMPARE(lines[0].name, QStringLiteral("A to B: 10.00 s"));
  QCOMPARE(lines[1].value, QStringLiteral("1.000 °C · 0.1000 °C/s · 5.000 °C·s"));
  QCOMPARE(lines[2].name, QStringLiteral("mean, melts at 0 °C"));
  QCOMPARE(lines[2].value, QStringLiteral("0.5000 °C, off by 0.50 °C"));
  graph.setReading(1, 20.0);
  QCOMPARE(graph.measured().size(), size_t{2});  // it has left what melts far behind
}

void TestGraphs::graphsAreAccessible() {
  GraphView graph;
  graph.setTitle(QStringLiteral("Temperature"));
  graph.setUnit(QStringLiteral("°C"));
  QAccessibleInterface* face = QAccessible::queryAccessibleInterface(&graph);
  QVERIFY(face);
  QCOMPARE(face->text(QAccessible::Name), QStringLiteral("Temperature, °C"));
  QCOMPARE(face->text(QAccessible::Value), QStringLiteral("Drag a probe here to plot it"));
  graph.append(graph.addSeries(QStringLiteral("Ice core")), 2, -0.9);
  QVERIFY(face->text(QAccessible::Value).contains(QStringLiteral("Ice core")));
  QVERIFY(face->text(QAccessible::Value).contains(QStringLiteral("−0.9000 °C")));
}

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme::apply(application, true);
  TestGraphs test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_graphs.moc"
