// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "tests/shared/localnumbers.h"
#include "ui/theme/icon.h"
#include "ui/theme/legend.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/resources.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"

#include <QtCore/QDebug>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QRegularExpression>
#include <QtGui/QFontInfo>
#include <QtGui/QFontMetricsF>
#include <QtGui/QImage>
#include <QtGui/QPainter>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QDialog>
#include <QtWidgets/QDialogButtonBox>
#include <QtWidgets/QStyleOption>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace ps;

namespace {

api::ParameterDeclaration declaration(const char* unit, const char* shown = "", double scale = 1, double offset = 0) {
  api::ParameterDeclaration d{};
  d.key = "key";
  d.label = "Label";
  d.unit = unit;
  d.displayUnit = shown;
  d.displayScale = scale;
  d.displayOffset = offset;
  d.maximum = 1;
  d.hardMaximum = 1e30;
  return d;
}

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

/// Sight without one of the three cones, in linear sRGB: Machado, Oliveira and Fernandes, "A Physiologically-based
/// Model for Simulation of Color Vision Deficiency", IEEE TVCG 15 (2009) 1291, the matrices of severity 1.
struct Sight {
  const char* name;
  Matrix matrix;
};
constexpr std::array<Sight, 3> kSights{
    {{"protan", {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
     {"deutan", {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
     {"tritan",
      {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}}};
constexpr Matrix kEveryCone{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Triple times(const Matrix& matrix, const Triple& v) {
  Triple out{};
  for (size_t i = 0; i < 3; ++i) out[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  return out;
}

/// OKLab (Ottosson 2020) of a colour as it is seen.
Triple seen(const QColor& colour, const Matrix& sight) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  Triple rgb = times(sight, {linear(colour.redF()), linear(colour.greenF()), linear(colour.blueF())});
  for (double& part : rgb) part = std::clamp(part, 0.0, 1.0);
  Triple cones = times({{{0.4122214708, 0.5363325363, 0.0514459929},
                         {0.2119034982, 0.6806995451, 0.1073969566},
                         {0.0883024619, 0.2817188376, 0.6299787005}}},
                       rgb);
  for (double& part : cones) part = std::cbrt(part);
  return times({{{0.2104542553, 0.7936177850, -0.0040720468},
                 {1.9779984951, -2.4285922050, 0.4505937099},
                 {0.0259040371, 0.7827717662, -0.8086757660}}},
               cones);
}

/// Distance in OKLab, times 100.
double difference(const QColor& a, const QColor& b, const Matrix& sight) {
  const Triple one = seen(a, sight), other = seen(b, sight);
  return 100 * std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
}

/// Of any two.
double leastDifference(const std::vector<QColor>& colours, const Matrix& sight) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < colours.size(); ++i) {
    for (size_t k = 0; k < i; ++k) least = std::min(least, difference(colours[i], colours[k], sight));
  }
  return least;
}

std::vector<QColor> stopsOf(const char* map) {
  std::vector<QColor> colours;
  for (const auto& [position, colour] : colourMap(QString::fromLatin1(map)).stops) colours.push_back(colour);
  return colours;
}

std::vector<QColor> seriesOf(bool dark) {
  const Theme theme = Theme::load(dark);
  std::vector<QColor> colours;
  for (int i = 0; !theme.seriesDashed(i); ++i) colours.push_back(theme.series(i));
  return colours;
}

/// A selector of the style sheet, with the colours that it sets; transparent counts as none.
struct SheetRule {
  QString selector;
  QColor text, ground;
};

std::vector<SheetRule> rulesOf(QString sheet) {
  static const QRegularExpression comment(QStringLiteral("/\\*.*?\\*/"),
                                          QRegularExpression::DotMatchesEverythingOption),
      block(QStringLiteral("([^{}]+)\\{([^{}]*)\\}"));
  const auto colourIn = [](const QString& body, const char* property) {
    const QRegularExpression set(QStringLiteral("(?:^|[;\\s])%1:\\s*(#[0-9a-fA-F]+)").arg(QLatin1String(property)));
    return QColor(set.match(body).captured(1));
  };
  std::vector<SheetRule> rules;
  for (auto match = block.globalMatch(sheet.remove(comment)); match.hasNext();) {
    const QRegularExpressionMatch found = match.next();
    for (const QString& selector : found.captured(1).split(QLatin1Char(',')))
      rules.push_back(
          {selector.trimmed(), colourIn(found.captured(2), "color"), colourIn(found.captured(2), "background")});
  }
  return rules;
}

/// Of the rule of this selector, else of the nearest one that it narrows ("QPushButton:hover": "QPushButton").
QColor inForce(const std::vector<SheetRule>& rules, const QString& selector, QColor SheetRule::*part,
               QColor otherwise) {
  qsizetype nearest = 0;
  for (const SheetRule& rule : rules) {
    const qsizetype size = rule.selector.size();
    const bool narrowed = selector.startsWith(rule.selector) &&
                          (size == selector.size() || QStringLiteral(":[#").contains(selector[size]));
    if (!narrowed || size < nearest || !(rule.*part).isValid()) continue;
    nearest = size;
    otherwise = rule.*part;
  }
  return otherwise;
}

}  // namespace

class TestTheme : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void contrastSuffices_data();
  void contrastSuffices();
  void textsOfTheSheetAreRead_data();
  void textsOfTheSheetAreRead();
  void colourBlindSightTellsColoursApart_data();
  void colourBlindSightTellsColoursApart();
  void sightIsSimulated();
  void phasesAreToldApartInGrey();
  void guidesAreInTheAccent();
  void seriesAreVisible();
  void contrastIsWcags();
  void badTokensAreNamed_data();
  void badTokensAreNamed();
  void styleSheetHasNoPlaceholderLeft();
  void digitsAreAsWideAsOneAnother();
  void boxesAreAsWideAsTheirWidestText();
  void buttonsOfDialogsHaveWordsOnly();
  void theRingOfATabStandsAroundItsText();
  void iconsTintAndStaySharp();
  void iconsStaySharpAtEveryScale_data();
  void iconsStaySharpAtEveryScale();
  void numbersAreFormatted_data();
  void numbersAreFormatted();
  void prefixesKeepNumbersShort();
  void narrowFieldsTakeAPrefix();
  void absoluteZeroStandsForNone();
  void theLastSecondStandsForNever();
  void aPastedPageIsNoNumber();
  void whatATypedNumberMakesIsFinite();
  void anExponentHasNoGroups();
  void numbersBeyondAllRangesAreShown();
  void errorsBelowRoundingAreNotSpelledOut();
  void fieldsKeepTheirDecimals_data();
  void fieldsKeepTheirDecimals();
  void typedTextIsUnderstood_data();
  void typedTextIsUnderstood();
  void typedNonsenseIsRefused_data();
  void typedNonsenseIsRefused();
  void unitsAreUnderstood_data();
  void unitsAreUnderstood();
  void whatIsShownCanBeTyped();
  void pivotSitsOnTheMeltingPoint();
  void legendShowsItsMarks();
  void legendMarksNearAnEndAreShown();
  void prefixesAreForUnitsThatTakeThem();
  void dialogsHaveMargins();
};

void TestTheme::contrastSuffices_data() {
  QTest::addColumn<int>("foreground");
  QTest::addColumn<int>("background");
  QTest::addColumn<double>("least");
  const auto add = [](Token foreground, std::initializer_list<Token> grounds, double least) {
    for (const Token ground : grounds) {
      QTest::addRow("%s on %s", Theme::name(foreground), Theme::name(ground))
          << static_cast<int>(foreground) << static_cast<int>(ground) << least;
    }
  };
  using enum Token;
  add(Text, {Window, Panel, Header, Field, Raised, Hover, Selection, ErrorGround, WarningGround}, 4.5);
  add(Text2, {Window, Panel, Header, Field, Raised, Hover, Selection, ErrorGround, WarningGround}, 4.5);
  add(Muted, {Panel, Field, Header}, 4.5);
  add(Accent, {Panel, Field, WarningGround}, 4.5);
  add(OnAccent, {Accent}, 4.5);
  add(Warning, {Panel, Field, WarningGround}, 4.5);
  add(Token::Error, {Panel, Field, ErrorGround}, 4.5);
  for (const Token token : {Ok, Info, Curve, Keyframe}) add(token, {Panel}, 4.5);
  for (const Token token : {Warning, Token::Error, Ok, Info}) add(token, {Window}, 4.5);  // status line
  // Marks: WCAG 2.2, 1.4.11 asks 3 of what must be seen to use a control.
  add(ControlEdge, {Panel, Field}, 3);
  add(SliderFill, {Panel, Field}, 3);
  add(Accent, {Window, Selection}, 3);
  add(Curve, {Field}, 3);
  add(Keyframe, {Field}, 3);
  for (const Token token : {AxisX, AxisY, AxisZ, AxisHover}) add(token, {Window, Panel}, 3);  // below an overlay, too
}

void TestTheme::contrastSuffices() {
  QFETCH(int, foreground);
  QFETCH(int, background);
  QFETCH(double, least);
  for (const bool dark : {true, false}) {
    const Theme theme = Theme::load(dark);
    const double ratio = contrast(theme[static_cast<Token>(foreground)], theme[static_cast<Token>(background)]);
    QVERIFY2(ratio >= least, qPrintable(QStringLiteral("%1 theme: %2").arg(dark ? "dark" : "light").arg(ratio)));
  }
}

/// Every rule of the style sheet, of what is not disabled: its text on its ground, each from the rule itself or from
/// the one that it narrows, else text on a panel.
void TestTheme::textsOfTheSheetAreRead_data() {
  QTest::addColumn<bool>("dark");
  QTest::newRow("dark") << true;
  QTest::newRow("light") << false;
}

void TestTheme::textsOfTheSheetAreRead() {
  QFETCH(bool, dark);
  const Theme theme = Theme::load(dark);
  const std::vector<SheetRule> rules = rulesOf(theme.styleSheet());
  QVERIFY(rules.size() > 80);
  int hovers = 0;
  for (const SheetRule& rule : rules) {
    const auto says = [&rule](const char* word) { return rule.selector.contains(QLatin1String(word)); };
    if (says(":disabled") || says("QScrollBar") || says("QProgressBar") || says("separator"))
      continue;  // the rest: bare
    const QColor text = inForce(rules, rule.selector, &SheetRule::text, theme[Token::Text]);
    const QColor ground = inForce(rules, rule.selector, &SheetRule::ground, theme[Token::Panel]);
    const double ratio = contrast(text, ground);
    QVERIFY2(ratio >= 4.5, qPrintable(QStringLiteral("%1: %2").arg(rule.selector).arg(ratio)));
    hovers += says(":hover") && rule.ground.isValid() ? 1 : 0;
  }
  QVERIFY(hovers >= 5);
}

/// The figures for which the maps were made, whole numbers: a difference of 11.9 is 12.
void TestTheme::colourBlindSightTellsColoursApart_data() {
  QTest::addColumn<std::vector<QColor>>("colours");
  QTest::addColumn<double>("figure");
  QTest::newRow("temperature") << stopsOf("temperature") << 12.0;
  QTest::newRow("density error") << stopsOf("density_error") << 10.0;
  QTest::newRow("phase") << stopsOf("phase") << 7.0;  // hence letters, too
  QTest::newRow("series, dark") << seriesOf(true) << 13.0;
  QTest::newRow("series, light") << seriesOf(false) << 13.0;
}

void TestTheme::colourBlindSightTellsColoursApart() {
  QFETCH(std::vector<QColor>, colours);
  QFETCH(double, figure);
  for (const Sight& sight : kSights) {
    const double least = leastDifference(colours, sight.matrix);
    QVERIFY2(std::round(least) >= figure, qPrintable(QStringLiteral("%1: %2").arg(sight.name).arg(least)));
  }
}

/// A red and a green as light as one another are one brown to who lacks a cone for either; grey is grey to all.
void TestTheme::sightIsSimulated() {
  const QColor red(0xC0, 0x50, 0x50), green(0x7A, 0x7A, 0x48), grey(0x80, 0x80, 0x80);
  QVERIFY(difference(red, green, kEveryCone) > 15);
  QVERIFY(difference(red, green, kSights[0].matrix) < 7 && difference(red, green, kSights[1].matrix) < 2);
  QVERIFY(difference(red, green, kSights[2].matrix) > 15);
  QVERIFY(std::abs(difference(Qt::black, Qt::white, kEveryCone) - 100) < 0.01);  // OKLab's lightness is 0 to 1
  for (const Sight& sight : kSights) {
    const Triple one = seen(grey, sight.matrix), other = seen(grey, kEveryCone);
    for (size_t k = 0; k < 3; ++k) QVERIFY(std::abs(one[k] - other[k]) < 1e-4);
  }
}

/// By letters: each another one, and dark or light enough on its colour, as a legend chooses.
void TestTheme::phasesAreToldApartInGrey() {
  const ColourMap& map = colourMap(QStringLiteral("phase"));
  QCOMPARE(map.classes.size(), map.stops.size());
  QStringList letters;
  for (const auto& [letter, name] : map.classes) letters << letter;
  QCOMPARE(letters.removeDuplicates(), 0);
  for (const bool dark : {true, false}) {
    const Theme theme = Theme::load(dark);
    for (const auto& [position, colour] : map.stops) {
      const double ratio = std::max(contrast(colour, theme[dark ? Token::Window : Token::Text]),
                                    contrast(colour, theme[dark ? Token::Text : Token::Panel]));
      QVERIFY2(ratio >= 3, qPrintable(QStringLiteral("%1: %2").arg(colour.name()).arg(ratio)));  // of marks
    }
  }
}

/// The renderer reads no tokens: the accent stands among the colours of its scene as well, once for each theme.
void TestTheme::guidesAreInTheAccent() {
  const QByteArray maps = themeResource(QStringLiteral("theme/maps.json"));
  const QJsonObject scene = QJsonDocument::fromJson(maps).object()[QStringLiteral("scene")].toObject();
  for (const bool dark : {true, false}) {
    const QColor accent = Theme::load(dark)[Token::Accent];
    const QJsonObject look = scene[dark ? QStringLiteral("dark") : QStringLiteral("light")].toObject();
    QCOMPARE(QColor(look[QStringLiteral("guide")].toString()), accent);
    QCOMPARE(maps.toUpper().count(accent.name().toUpper().toLatin1()), qsizetype{1});
  }
}

void TestTheme::seriesAreVisible() {
  for (const bool dark : {true, false}) {
    const Theme theme = Theme::load(dark);
    for (int i = 0; !theme.seriesDashed(i); ++i) QVERIFY(contrast(theme.series(i), theme[Token::Field]) >= 3);
    int first = 0;
    while (!theme.seriesDashed(first)) ++first;
    QCOMPARE(theme.series(first), theme.series(0));  // then the same, dashed
  }
}

void TestTheme::contrastIsWcags() {
  QCOMPARE(contrast(Qt::black, Qt::white), 21.0);
  QCOMPARE(contrast(Qt::white, Qt::white), 1.0);
  // The example of WCAG's technique G18: #777777 on white is 4.48 to two decimals.
  QVERIFY(std::abs(contrast(QColor(0x77, 0x77, 0x77), Qt::white) - 4.48) < 0.005);
}

void TestTheme::badTokensAreNamed_data() {
  QTest::addColumn<QByteArray>("json");
  QTest::addColumn<QByteArray>("named");
  QTest::newRow("no JSON") << QByteArray("{") << QByteArray("tokens.json");
  QTest::newRow("missing") << QByteArray("{\"dark\": {}}") << QByteArray("/dark/window");
  QTest::newRow("no colour") << QByteArray("{\"dark\": {\"window\": \"blueish\"}}") << QByteArray("/dark/window");
  QTest::newRow("a number") << QByteArray("{\"dark\": {\"window\": 7}}") << QByteArray("/dark/window");
}

void TestTheme::badTokensAreNamed() {
  QFETCH(QByteArray, json);
  QFETCH(QByteArray, named);
  try {
    Theme::parse(json, true);
    QFAIL("accepted");
  } catch (const ps::Error& error) {
    QVERIFY2(QByteArray(error.what()).contains(named), error.what());
  }
}

void TestTheme::styleSheetHasNoPlaceholderLeft() {
  for (const bool dark : {true, false}) {
    QString sheet = Theme::load(dark).styleSheet();
    sheet.remove(0, sheet.indexOf(QStringLiteral("*/")));
    QVERIFY(sheet.size() > 2000);
    QVERIFY2(!sheet.contains(QLatin1Char('@')), qPrintable(sheet.mid(sheet.indexOf(QLatin1Char('@')), 30)));
  }
}

void TestTheme::digitsAreAsWideAsOneAnother() {
  for (const TextRole role : {TextRole::Normal, TextRole::Small, TextRole::Medium, TextRole::Time, TextRole::Heading}) {
    const QFont font = Theme::font(role);
    QCOMPARE(QFontInfo(font).family(), QStringLiteral("PhaseSketch UI"));
    const QFontMetricsF metrics(font);
    const double one = metrics.horizontalAdvance(QStringLiteral("1111.1"));
    // A hundredth of a pixel: metrics are rounded to 26.6 fixed point per glyph.
    QVERIFY(std::abs(metrics.horizontalAdvance(QStringLiteral("8408.7")) - one) < 0.1);
  }
  QCOMPARE(QFontInfo(Theme::font(TextRole::Symbol)).family(), QStringLiteral("PhaseSketch Symbols"));
}

void TestTheme::boxesAreAsWideAsTheirWidestText() {
  QComboBox box;
  box.setSizeAdjustPolicy(QComboBox::AdjustToContents);
  box.addItems({QStringLiteral("Matter"), QStringLiteral("Temperature of matter")});
  const int before = box.sizeHint().width();
  box.setCurrentIndex(1);
  box.addItem(QStringLiteral("Speed"));  // it measures anew
  QCOMPARE(before, box.sizeHint().width());
}

void TestTheme::buttonsOfDialogsHaveWordsOnly() {
  const QDialogButtonBox box(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
  for (const QAbstractButton* button : box.buttons()) QVERIFY(button->icon().isNull());
}

void TestTheme::theRingOfATabStandsAroundItsText() {
  struct Bar : QTabBar {
    /// What is painted of the first tab, above the line below it.
    QRect painted(QStyle::State more) {
      QStyleOptionTab option;
      initStyleOption(&option, 0);
      option.state |= more;
      QImage picture(size(), QImage::Format_ARGB32_Premultiplied);
      picture.fill(Qt::transparent);
      QPainter painter(&picture);
      style()->drawControl(QStyle::CE_TabBarTab, &option, &painter, this);
      painter.end();
      QRect all;
      for (int y = 0; y < height() - 3; ++y) {
        for (int x = 0; x < width(); ++x) {
          if (picture.pixelColor(x, y).alpha() > 128) all |= QRect(x, y, 1, 1);
        }
      }
      return all;
    }
  };
  Bar bar;
  bar.addTab(QStringLiteral("Tune"));
  bar.ensurePolished();
  bar.setTabText(0, QStringLiteral("Tune"));  // it measures anew
  bar.resize(bar.sizeHint());
  const QRect text = bar.painted({});
  QVERIFY(!text.isEmpty());
  // The ring is 2 px wide and leaves at least one.
  const QRect ring = bar.painted(QStyle::State_HasFocus | QStyle::State_KeyboardFocusChange);
  QVERIFY2(ring.contains(text.adjusted(-3, -3, 3, 3)), qPrintable(QDebug::toString(ring) + QDebug::toString(text)));
}

void TestTheme::iconsTintAndStaySharp() {
  QVERIFY(iconNames().contains(QStringLiteral("play")));
  for (const QString& name : iconNames()) {
    const QImage image = iconPixmap(name, QColor(200, 100, 50), 16, 2).toImage();
    QCOMPARE(image.width(), 32);
    int drawn = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const QColor pixel = image.pixelColor(x, y);
        if (pixel.alpha() < 200) continue;
        ++drawn;
        // Premultiplied storage rounds a channel by up to 2 at these alphas.
        QVERIFY2(std::abs(pixel.red() - 200) <= 3 && std::abs(pixel.blue() - 50) <= 3, qPrintable(name));
      }
    }
    QVERIFY2(drawn > 12, qPrintable(name + QStringLiteral(" draws nothing")));
    QVERIFY2(image.pixelColor(0, 0).alpha() == 0, qPrintable(name + QStringLiteral(" touches the corner")));
  }
  QVERIFY(icon(QStringLiteral("no-such-icon")).isNull());
}

void TestTheme::iconsStaySharpAtEveryScale_data() {
  QTest::addColumn<double>("scale");
  for (const double scale : {1.0, 1.25, 1.5, 2.0, 3.0}) QTest::addRow("%g %%", 100 * scale) << scale;
}

/// Wherever one stands it is laid on device pixels, drawn for their number and not scaled: each pixel is that of the
/// picture of its size.
void TestTheme::iconsStaySharpAtEveryScale() {
  QFETCH(double, scale);
  const QColor colour = Theme::current()[Token::Text];
  const int pixels = static_cast<int>(std::lround(16 * scale));
  for (const QString& name : iconNames()) {
    QImage canvas(QSize(1, 1) * static_cast<int>(std::ceil(24 * scale)), QImage::Format_ARGB32_Premultiplied);
    canvas.setDevicePixelRatio(scale);
    canvas.fill(Qt::transparent);
    QPainter painter(&canvas);
    const QPointF at(3.3, 4.6);
    const QPointF device(snapped(painter, at.x()) * scale, snapped(painter, at.y()) * scale);
    paintIcon(painter, QRectF(at, QSizeF(16, 16)), name, colour);
    painter.end();
    QVERIFY(std::abs(device.x() - std::round(device.x())) + std::abs(device.y() - std::round(device.y())) < 1e-9);
    QImage own = iconPixmap(name, colour, 16, scale).toImage().convertToFormat(canvas.format());
    QCOMPARE(own.size(), QSize(pixels, pixels));
    QImage shown = canvas.copy(QRect(device.toPoint(), own.size()));
    own.setDevicePixelRatio(1);
    shown.setDevicePixelRatio(1);
    QVERIFY2(shown == own, qPrintable(name));
    QVERIFY2(own != iconPixmap(name, colour, 16, scale + 0.5).toImage().scaled(own.size()), qPrintable(name));
  }
}

void TestTheme::numbersAreFormatted_data() {
  QTest::addColumn<double>("value");
  QTest::addColumn<QString>("four");
  QTest::addColumn<QString>("brief");
  const auto row = [](double value, const char* four, const char* brief) {
    QTest::newRow(qPrintable(QString::number(value, 'g', 12)))
        << value << QString::fromUtf8(four) << QString::fromUtf8(brief);
  };
  row(0, "0", "0");
  row(120, "120.0", "120");
  row(24594, "24 590", "24 590");
  row(1000, "1 000", "1 000");
  row(999.96, "1 000", "1 000");
  row(293.15, "293.2", "293.2");  // the double beside it lies below
  row(-293.15, "−293.2", "−293.2");
  row(293.149, "293.1", "293.1");
  row(-0.9, "−0.9000", "−0.9");
  row(0.5, "0.5000", "0.5");
  row(3e-6, "3.000 × 10⁻⁶", "3 × 10⁻⁶");
  row(-9.3e9, "−9.300 × 10⁹", "−9.3 × 10⁹");
  row(1234567, "1 235 000", "1 235 000");
  row(12345678, "1.235 × 10⁷", "1.235 × 10⁷");
  row(0.001, "0.001000", "0.001");
  row(0.00099999, "0.001000", "0.001");
  row(6.02e23, "6.020 × 10²³", "6.02 × 10²³");
  row(std::numeric_limits<double>::quiet_NaN(), "—", "—");
  row(std::numeric_limits<double>::infinity(), "—", "—");
}

void TestTheme::numbersAreFormatted() {
  QFETCH(double, value);
  QFETCH(QString, four);
  QFETCH(QString, brief);
  // Rows write groups with plain spaces; around the multiplication sign stand plain spaces in both.
  const auto spaced = [](QString text) { return text.replace(QChar(0x202F), QLatin1Char(' ')); };
  QCOMPARE(spaced(formatNumber(value)), four);
  QCOMPARE(spaced(formatShort(value)), brief);
  if (value == 24594) {
    QVERIFY(formatNumber(value).contains(QChar(0x202F)));
    QCOMPARE(spaced(formatFixed(value)), QStringLiteral("24 594"));
    QCOMPARE(spaced(formatFixed(1e300)), QString::fromUtf8("1 × 10³⁰⁰"));
    QCOMPARE(formatFixed(-0.04, 1), QStringLiteral("0.0"));  // no minus before zero
  }
  QCOMPARE(spaced(formatQuantity(3e-6, QStringLiteral("m"))), QString::fromUtf8("3 × 10⁻⁶ m"));
}

void TestTheme::prefixesKeepNumbersShort() {
  const auto text = [](double value, const char* unit) { return formatPrefixed(value, QString::fromUtf8(unit)); };
  QCOMPARE(text(76395660.018, "J"), QStringLiteral("76.40 MJ"));
  QCOMPARE(text(141000, "g"), QStringLiteral("141.0 kg"));
  QCOMPARE(text(1.54, "g"), QStringLiteral("1.540 g"));
  QCOMPARE(text(0.00154, "g"), QStringLiteral("1.540 mg"));
  QCOMPARE(text(999.96, "J"), QStringLiteral("1.000 kJ"));  // as it is rounded
  QCOMPARE(text(-2500, "J"), QString::fromUtf8("−2.500 kJ"));
  QCOMPARE(text(0, "J"), QStringLiteral("0 J"));
  QCOMPARE(text(-1e-12, "J"), QStringLiteral("0 J"));
  QCOMPARE(text(std::numeric_limits<double>::quiet_NaN(), "J"), QString::fromUtf8("— J"));
}

void TestTheme::narrowFieldsTakeAPrefix() {
  const auto text = [](const api::ParameterDeclaration& d, double stored) {
    const FieldText shown = shortField(d, stored);
    return shown.value + QLatin1Char(' ') + shown.unit;
  };
  const api::ParameterDeclaration viscosity = declaration("Pa·s", "mPa·s", 1e3), density = declaration("kg/m³"),
                                  area = declaration("m²");
  QCOMPARE(text(viscosity, 3970), QString::fromUtf8("3.97 kPa·s"));
  QCOMPARE(text(viscosity, 1e-3), QString::fromUtf8("1 mPa·s"));
  QCOMPARE(text(viscosity, 1e15), QString::fromUtf8("1\u202f000 TPa·s"));
  QCOMPARE(text(density, 12000), formatField(density, 12000) + QString::fromUtf8(" kg/m³"));  // there is no kkg
  QCOMPARE(text(area, 12000), formatField(area, 12000) + QString::fromUtf8(" m²"));           // km² is another thing
}

void TestTheme::errorsBelowRoundingAreNotSpelledOut() {
  QCOMPARE(formatError(1e-16), QStringLiteral("< 10⁻⁹"));
  QCOMPARE(formatError(-9.9e-10), QStringLiteral("< 10⁻⁹"));
  QCOMPARE(formatError(-2.4e-9), formatShort(2e-9));
  QCOMPARE(formatError(0.031), QStringLiteral("0.03"));
  QCOMPARE(formatError(0), QStringLiteral("0"));
}

void TestTheme::fieldsKeepTheirDecimals_data() {
  QTest::addColumn<double>("minimum");
  QTest::addColumn<double>("maximum");
  QTest::addColumn<bool>("logarithmic");
  QTest::addColumn<double>("value");
  QTest::addColumn<QString>("text");
  QTest::newRow("temperature") << -50.0 << 300.0 << false << 120.0 << "120.0";
  QTest::newRow("zero") << -50.0 << 300.0 << false << 0.0 << "0.0";
  QTest::newRow("fraction") << 0.0 << 1.0 << false << 0.62 << "0.620";
  QTest::newRow("density, whole") << 100.0 << 3000.0 << false << 917.0 << "917";
  QTest::newRow("density, typed") << 100.0 << 3000.0 << false << 999.8 << "999.8";
  QTest::newRow("modulus") << 1e-3 << 100.0 << true << 9.3 << "9.30";
  QTest::newRow("factor") << 1.0 << 1000.0 << true << 200.0 << "200";
}

void TestTheme::fieldsKeepTheirDecimals() {
  QFETCH(double, minimum);
  QFETCH(double, maximum);
  QFETCH(bool, logarithmic);
  QFETCH(double, value);
  QFETCH(QString, text);
  api::ParameterDeclaration d = declaration("");
  d.minimum = minimum;
  d.maximum = maximum;
  d.scale = logarithmic ? api::Scale::Logarithmic : api::Scale::Linear;
  QCOMPARE(formatField(d, value), text);
}

void TestTheme::absoluteZeroStandsForNone() {
  api::ParameterDeclaration d = declaration("K", "°C", 1, -273.15);
  d.maximum = 3500;
  d.hardMaximum = 1e4;
  QCOMPARE(formatValue(d, 0), QStringLiteral("none"));
  QCOMPARE(formatValue(d, 273.15), QStringLiteral("0.0 °C"));
  for (const char* text : {"none", " None "}) {
    const Typed typed = parseTyped(QString::fromUtf8(text), d, 300);
    QVERIFY2(typed.problem.isEmpty() && typed.value == 0, text);
  }
  d.hardMinimum = 1;  // a body has a temperature
  QVERIFY(!formatValue(d, 0).contains(QStringLiteral("none")));
  QVERIFY(!parseTyped(QStringLiteral("none"), d, 300).problem.isEmpty());
  QCOMPARE(formatValue(declaration("m"), 0), QStringLiteral("0.000 m"));
}

/// Each of its ends is tried as the end of a number: by the square of its length, ten seconds for a pasted page.
void TestTheme::aPastedPageIsNoNumber() {
  const Typed typed = parseTyped(QString(32000, QLatin1Char('7')), declaration("m"), 1);
  QCOMPARE(typed.problem, QStringLiteral("“77777777777777777777…” is too long for a number"));
  QVERIFY(parseTyped(QString(150, QLatin1Char('7')), declaration("m"), 1).problem.isEmpty());
}

/// Each number in them is one, the value would be none.
void TestTheme::whatATypedNumberMakesIsFinite() {
  for (const char* text : {"/1e-320", "*1e308", "1e308 GPa"}) {
    const QString problem = parseTyped(QString::fromUtf8(text), declaration("Pa"), 1e10).problem;
    QCOMPARE(problem, QString::fromUtf8("“%1” is too large for a number").arg(QString::fromUtf8(text)));
  }
  QVERIFY(!parseTyped(QStringLiteral("1e308"), declaration("m", "mm", 1e-3), 1).problem.isEmpty());
  QVERIFY(!parseTyped(QStringLiteral("1e308 cm"), declaration("m", "mm", 1e3), 1).problem.isEmpty());
}

/// A unit may begin as a power of ten goes on.
void TestTheme::anExponentHasNoGroups() {
  const api::ParameterDeclaration expansion = declaration("1/K", "10⁻⁶/K", 1e6);
  const QString shown = formatValue(expansion, 47480);
  QCOMPARE(shown, QString::fromUtf8("4.748 × 10¹⁰ 10⁻⁶/K"));
  QCOMPARE(parseTyped(shown, expansion, 0).value, 47480.0);
  QVERIFY(!parseNumber(QString::fromUtf8("10² 000")));
}

void TestTheme::numbersBeyondAllRangesAreShown() {
  api::ParameterDeclaration d = declaration("Pa", "kPa", 1e300);
  d.scale = api::Scale::Logarithmic;
  QCOMPARE(formatField(d, 1e300), QStringLiteral("—"));
}

void TestTheme::theLastSecondStandsForNever() {
  api::ParameterDeclaration d = declaration("s");
  d.maximum = 60;
  d.hardMaximum = 1e9;
  QCOMPARE(formatValue(d, 1e9), QStringLiteral("never"));
  QCOMPARE(formatValue(d, 10), QStringLiteral("10.0 s"));
  const Typed typed = parseTyped(QStringLiteral("Never"), d, 10);
  QVERIFY2(typed.problem.isEmpty() && typed.value == 1e9, qPrintable(typed.problem));
  d.hardMaximum = 100;  // a time that is always there
  QVERIFY(!parseTyped(QStringLiteral("never"), d, 10).problem.isEmpty());
  d.leastWord = "at once";
  d.hardMinimum = 0;
  QCOMPARE(formatValue(d, 0), QStringLiteral("at once"));
  QCOMPARE(formatValue(d, 10), QStringLiteral("10.0 s"));
  QCOMPARE(parseTyped(QStringLiteral("At once"), d, 10).value, 0.0);
  QVERIFY(!formatBound(d, 0).contains(QStringLiteral("once")));  // "must be at least 0 s"
}

void TestTheme::typedTextIsUnderstood_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("unit");  // stored | shown | scale | offset
  QTest::addColumn<double>("value");
  const auto row = [](const char* text, const char* unit, double value) {
    QTest::newRow(qPrintable(QString::fromUtf8(text) + QStringLiteral(" in ") + QString::fromUtf8(unit)))
        << QString::fromUtf8(text) << QString::fromUtf8(unit) << value;
  };
  const char* celsius = "K|°C|1|-273.15";
  row("25", celsius, 298.15);
  row("25 °C", celsius, 298.15);
  row("25°C", celsius, 298.15);
  row("25 C", celsius, 298.15);
  row("300 K", celsius, 300);
  row("77 °F", celsius, 298.15);
  row("−10", celsius, 263.15);
  row("*2", celsius, 313.15);  // 20 °C twice is 40 °C
  row("/2", celsius, 283.15);
  row("×2", celsius, 313.15);
  row("+10", celsius, 303.15);
  row("+10 °C", celsius, 303.15);  // a difference of temperatures has no zero
  row("+18 °F", celsius, 303.15);
  row("+-10 K", celsius, 283.15);
  row("1/3", "|||", 1.0 / 3);
  row("1,5", "|||", 1.5);
  row("1.5", "|||", 1.5);
  row("2*(3+4)", "|||", 14);
  row("-(2-5)", "|||", 3);
  row("2^3", "|||", 8);
  row("1e-3", "|||", 1e-3);
  row("3 × 10⁻⁶", "|||", 3e-6);
  row("24 594", "|||", 24594);
  row("2.5 GPa", "Pa|GPa|1e-9|0", 2.5e9);
  row("2500 MPa", "Pa|GPa|1e-9|0", 2.5e9);
  row("9.3", "Pa|GPa|1e-9|0", 9.3e9);
  row("1 bar", "Pa|kPa|1e-3|0", 1e5);
  row("5 mm", "m|mm|1e3|0", 5e-3);
  row("0,5 cm", "m|mm|1e3|0", 5e-3);
  row("2 kJ/(kg K)", "J/(kg·K)||1|0", 2000);
  row("0.6 W/m·K", "W/(m·K)||1|0", 0.6);
  row("50 %", "|%|100|0", 0.5);
  row("1.3 mPa·s", "Pa·s|mPa·s|1e3|0", 1.3e-3);
  row("200 ×", "|×|1|0", 200);
  row("2 min", "s||1|0", 120);
}

void TestTheme::typedTextIsUnderstood() {
  QFETCH(QString, text);
  QFETCH(QString, unit);
  QFETCH(double, value);
  const QStringList parts = unit.split(QLatin1Char('|'));
  const QByteArray stored = parts[0].toUtf8(), shown = parts[1].toUtf8();
  const double scale = parts[2].isEmpty() ? 1 : parts[2].toDouble();
  const api::ParameterDeclaration d =
      declaration(stored.constData(), shown.constData(), scale, parts.value(3).toDouble());
  // "kJ/(kg K)": a space multiplies only inside a unit.
  const QString typed = QString(text).replace(QStringLiteral("(kg K)"), QStringLiteral("(kg·K)"));
  const auto understood = [&] {
    const Typed result = parseTyped(typed, d, 293.15);
    QVERIFY2(result.problem.isEmpty(), qPrintable(result.problem));
    // Conversion costs a few roundings of double.
    QVERIFY2(std::abs(result.value - value) <= 1e-12 * std::abs(value),
             qPrintable(QString::number(result.value, 'g', 17)));
  };
  understood();
  if (QTest::currentTestFailed()) return;
  for (const char* name : kNumberLocales) {
    const LocalNumbers local(QString::fromLatin1(name));
    QVERIFY2(local.problem().isEmpty(), qPrintable(local.problem()));
    understood();
    if (QTest::currentTestFailed()) return;
  }
}

void TestTheme::typedNonsenseIsRefused_data() {
  QTest::addColumn<QString>("text");
  for (const char* text :
       {"", "abc", "1 2", "1..2", "1,2.3", "1 m", "--", "*", "/0", "*x", "(1", "1/0", "nan", "inf", "1e999", "0x10",
        "1 °C/", "((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((1", "25 furlongs"}) {
    QTest::newRow(text) << QString::fromUtf8(text);
  }
}

void TestTheme::typedNonsenseIsRefused() {
  QFETCH(QString, text);
  const Typed result = parseTyped(text, declaration("K", "°C", 1, -273.15), 300);
  QVERIFY2(!result.problem.isEmpty(), qPrintable(QString::number(result.value)));
}

void TestTheme::unitsAreUnderstood_data() {
  QTest::addColumn<QString>("text");
  QTest::addColumn<QString>("same");
  QTest::addColumn<double>("factor");
  QTest::newRow("conductivity") << "W/m·K"
                                << "W/(m·K)" << 1.0;
  QTest::newRow("joule") << "J"
                         << "N·m" << 1.0;
  QTest::newRow("pascal") << "Pa"
                          << "N/m²" << 1.0;
  QTest::newRow("exponent") << "s^-2"
                            << "1/s²" << 1.0;
  QTest::newRow("raised minus") << "K⁻¹"
                                << "1/K" << 1.0;
  QTest::newRow("litre") << "L"
                         << "m³" << 1e-3;
  QTest::newRow("mega") << "MPa"
                        << "Pa" << 1e6;
  QTest::newRow("milli") << "mPa·s"
                         << "Pa·s" << 1e-3;
  QTest::newRow("minute is no milli-inch") << "min"
                                           << "s" << 60.0;
  QTest::newRow("surface tension") << "mN/m"
                                   << "J/m²" << 1e-3;
}

void TestTheme::unitsAreUnderstood() {
  QFETCH(QString, text);
  QFETCH(QString, same);
  QFETCH(double, factor);
  const auto a = parseUnit(text), b = parseUnit(same);
  QVERIFY(a && b);
  QCOMPARE(a->dimension, b->dimension);
  QVERIFY(std::abs(a->scale / b->scale - factor) < 1e-12 * factor);
  QVERIFY(!parseUnit(QStringLiteral("furlong")));
  QVERIFY(!parseUnit(QStringLiteral("m/s/s")));
}

/// Whatever a field shows can be copied and typed back.
void TestTheme::whatIsShownCanBeTyped() {
  const api::ParameterDeclaration d = declaration("Pa", "kPa", 1e-3);
  for (const double value : {101325.0, 1e-4, -5.0, 3.2e12, 24594000.0, 0.0}) {
    const Typed back = parseTyped(formatQuantity(toDisplay(d, value), QStringLiteral("kPa"), 8), d, 0);
    QVERIFY2(back.problem.isEmpty(), qPrintable(back.problem));
    QVERIFY(std::abs(back.value - value) <= 1e-7 * std::abs(value));  // eight digits
  }
}

void TestTheme::pivotSitsOnTheMeltingPoint() {
  const ColourMap& map = colourMap(QStringLiteral("temperature"));
  QCOMPARE(map.pivot, 0.36);
  QCOMPARE(legendPosition(map, {-14, 120}, 0, 0), 0.36);
  QCOMPARE(legendPosition(map, {-14, 120}, 0, -7), 0.18);  // both sides linear
  QCOMPARE(legendPosition(map, {-14, 120}, 0, 60), 0.68);
  // Outside of the range it keeps its colour: what has melted is never shown as what has not.
  QCOMPARE(legendPosition(map, {10, 20}, 0, 10), 0.68);
  QCOMPARE(legendPosition(map, {1500, 1600}, 0, 1500), 0.68);  // and half of its side's colours are left
  QCOMPARE(legendPosition(map, {10, 20}, 0, 20), 1.0);
  QCOMPARE(legendPosition(map, {-20, -10}, 0, -10), 0.18);
  QCOMPARE(legendPosition(map, {-20, -10}, 0, -20), 0.0);
  QCOMPARE(legendPosition(map, {-14, 120}, 0, 500), 1.0);
  QCOMPARE(map.at(0.36), QColor(0x8D, 0xC2, 0xE6));
  QCOMPARE(colourMap(QStringLiteral("phase")).classes.size(), size_t{5});
  QVERIFY_EXCEPTION_THROWN(colourMap(QStringLiteral("none")), ps::Error);
}

void TestTheme::legendShowsItsMarks() {
  const ColourMap& map = colourMap(QStringLiteral("temperature"));
  const auto painted = [&map](const std::vector<LegendMark>& marks) {
    const LegendText text{QStringLiteral("Temperature"), QStringLiteral("°C")};
    QImage image(legendSize(map, text).toSize(), QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::black);
    QPainter painter(&image);
    paintLegend(painter, QRectF(QPointF(0, 0), image.size()), map, {-14, 120}, text, marks, 0);
    painter.end();
    return image;
  };
  const QImage without = painted({}), with = painted({{0, QStringLiteral("melts")}});
  QVERIFY(without != with);
  QVERIFY(painted({{900, QStringLiteral("boils")}}) == without);   // beyond the range: not drawn
  QVERIFY(painted({{9.81e-5, QStringLiteral("melts")}}) == with);  // not a power of ten: nobody sees the difference
  QVERIFY(painted({{1.5, QStringLiteral("melts")}}) != with);
  // The bar is dark blue at the bottom and dark red at the top.
  const QColor bottom = without.pixelColor(16, without.height() - 14), top = without.pixelColor(16, 38);
  QVERIFY(bottom.blue() > bottom.red() && top.red() > top.blue());
  QVERIFY(legendSize(map, {QStringLiteral("A label of a plugin that is long"), {}}).width() > without.width());
  QVERIFY(legendSize(map, {QStringLiteral("Heat"), QStringLiteral("MJ/(kg·K·m²)")}).width() > without.width());
}

/// Beside the number at the end of the scale, never in its place, and none in the place of another.
void TestTheme::legendMarksNearAnEndAreShown() {
  const ColourMap& map = colourMap(QStringLiteral("temperature"));
  const LegendText text{QStringLiteral("Temperature"), QStringLiteral("°C")};
  const QSize size(160, 260);
  const auto painted = [&](const std::vector<LegendMark>& marks) {
    QImage image(size, QImage::Format_ARGB32_Premultiplied);
    image.fill(Qt::black);
    QPainter painter(&image);
    paintLegend(painter, QRectF(QPointF(0, 0), size), map, {-10, 100}, text, marks, 0);
    painter.end();
    return image;
  };
  const QRectF bar = legendBar(QRectF(QPointF(0, 0), size), map);
  const QRect high(static_cast<int>(bar.right()) + 13, static_cast<int>(bar.top()) - 7, 90, 13),
      low(high.left(), static_cast<int>(bar.bottom()) - 6, 90, 13);
  const QImage without = painted({});
  for (const double value : {100.0, 99.97, 97.0, -10.0, -9.5}) {
    const QImage with = painted({{value, QStringLiteral("boils")}});
    QVERIFY2(with != without, qPrintable(QString::number(value)));
    QVERIFY(with.copy(high) == without.copy(high));
    QVERIFY(with.copy(low) == without.copy(low));
  }
  const QImage one = painted({{99, QStringLiteral("melts")}}),
               both = painted({{98, QStringLiteral("melts")}, {99, QStringLiteral("boils")}});
  QVERIFY(both != one && both.copy(high) == one.copy(high));
}

void TestTheme::prefixesAreForUnitsThatTakeThem() {
  const auto prefixed = [](double value, const char* unit) {
    const UnitPrefix prefix = prefixFor(value, QString::fromUtf8(unit));
    return QString::number(value / prefix.factor) + QLatin1Char(' ') + prefix.symbol + QString::fromUtf8(unit);
  };
  QCOMPARE(prefixed(334000, "J/kg"), QStringLiteral("334 kJ/kg"));
  QCOMPARE(prefixed(0.002, "W"), QStringLiteral("2 mW"));
  QCOMPARE(prefixed(12000, "kg/m³"), QStringLiteral("12000 kg/m³"));
  QCOMPARE(prefixed(5000, "m²"), QStringLiteral("5000 m²"));
  QCOMPARE(prefixed(5000, "smoots"), QStringLiteral("5000 smoots"));
  QCOMPARE(prefixed(5000, ""), QStringLiteral("5000 "));
}

/// Panels lie edge to edge; what Qt builds by itself does not.
void TestTheme::dialogsHaveMargins() {
  QWidget panel;
  QDialog dialog;
  const QVBoxLayout inPanel(&panel), inDialog(&dialog);
  QCOMPARE(inPanel.contentsMargins(), QMargins(0, 0, 0, 0));
  QCOMPARE(inDialog.contentsMargins(), QMargins(12, 12, 12, 12));
}

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme::apply(application, true);
  TestTheme test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_theme.moc"
