// SPDX-License-Identifier: Apache-2.0
// What a row looks like in each of its states, dark and light: compared with pictures that are kept in
// tests/ui/pictures. With PS_KEEP_PICTURES=1 they are made anew, to be looked at before they are committed.
#include "tests/ui/rowtesting.h"
#include "ui/theme/theme.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtGui/QImage>
#include <QtGui/QPainter>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

using namespace ps;
using namespace ps::testing;

namespace {

constexpr int kWidth = 392;
constexpr int kClose = 24;          ///< of 255, by which a channel may differ: edges of letters
constexpr double kOthers = 0.001;   ///< of a row's pixels may differ by more: another version of the font's rasteriser
constexpr double kDistinct = 5e-4;  ///< of a row's pixels differ at least between two states: a diamond's inside

double shareThatDiffers(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) return 1;
  int others = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      const int far =
          std::max({std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)), std::abs(qBlue(p) - qBlue(q))});
      others += far > kClose ? 1 : 0;
    }
  }
  return static_cast<double>(others) / (a.width() * a.height());
}

/// As it stands in a panel, without what blinks.
QImage pictureOf(ParameterRow& row) {
  for (QLineEdit* edit : row.findChildren<QLineEdit*>()) edit->setReadOnly(true);
  QImage picture(row.size(), QImage::Format_RGB32);
  picture.fill(Theme::current()[Token::Panel]);
  row.render(&picture, {}, {}, QWidget::DrawChildren);
  return picture;
}

QImage below(const std::vector<QImage>& pictures) {
  int height = 0;
  for (const QImage& picture : pictures) height += picture.height();
  QImage sheet(kWidth, height, QImage::Format_RGB32);
  QPainter painter(&sheet);
  int top = 0;
  for (const QImage& picture : pictures) {
    painter.drawImage(0, top, picture);
    top += picture.height();
  }
  return sheet;
}

}  // namespace

class TestRowPictures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyStateLooksAsKept_data() {
    QTest::addColumn<bool>("dark");
    QTest::newRow("dark") << true;
    QTest::newRow("light") << false;
  }
  void everyStateLooksAsKept() {
    QFETCH(bool, dark);
    Theme::apply(*qApp, dark);
    const std::vector<QImage> pictures = picturesOfStates();
    const QString file =
        QStringLiteral(PS_SOURCE_DIR "/tests/ui/pictures/row-states-%1.png").arg(dark ? "dark" : "light");
    if (qEnvironmentVariableIsSet("PS_KEEP_PICTURES")) {
      QVERIFY(QDir().mkpath(QFileInfo(file).path()));
      QVERIFY(below(pictures).save(file));
    }
    const QImage kept(file);
    QVERIFY2(!kept.isNull(), qPrintable(file));
    int top = 0;
    std::vector<QImage> wanted;
    for (const QImage& picture : pictures) {
      wanted.push_back(kept.copy(0, top, kWidth, picture.height()).convertToFormat(QImage::Format_RGB32));
      top += picture.height();
    }
    QCOMPARE(top, kept.height());
    QStringList others;
    for (size_t k = 0; k < pictures.size(); ++k) {
      const double share = shareThatDiffers(pictures[k], wanted[k]);
      if (share > kOthers) others << QStringLiteral("%1: %2 %").arg(name(k)).arg(100 * share, 0, 'f', 2);
      // Nearer to its own than to any other, however little these are apart.
      for (size_t j = 0; j < wanted.size(); ++j) {
        if (j != k && shareThatDiffers(pictures[k], wanted[j]) <= share)
          others << QStringLiteral("%1 looks like %2").arg(name(k), name(j));
      }
    }
    if (!others.isEmpty()) below(pictures).save(QStringLiteral("row-states.png"));
    QVERIFY2(others.isEmpty(), qPrintable(others.join(QStringLiteral(", "))));
  }

  /// No two states are taken for one another.
  void statesAreToldApart() {
    Theme::apply(*qApp, true);
    const std::vector<QImage> pictures = picturesOfStates();
    for (size_t i = 0; i < pictures.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        const double share = shareThatDiffers(pictures[i], pictures[k]);
        QVERIFY2(share > kDistinct, qPrintable(QStringLiteral("%1 and %2: %3").arg(name(i), name(k)).arg(share)));
      }
    }
  }

 private:
  static QString name(size_t k) { return k == 0 ? QStringLiteral("rest") : QString::fromLatin1(kStates[k - 1].first); }
  /// At rest, then in each state.
  static std::vector<QImage> picturesOfStates() {
    std::vector<QImage> pictures;
    const auto take = [&pictures](const RowState* state) {
      ParameterRow row(model("conductivity"));
      QObject::connect(&row, &ParameterRow::curveRequested, &row, [] {});
      show(row, kWidth);
      rest(row);
      if (state) reach(row, *state);
      QTest::qWait(50);
      if (state && *state != RowState::Hover) {
        QHoverEvent leave(QEvent::HoverLeave, QPointF(-1, -1), QPointF(-1, -1), QPointF(20, 10));
        QApplication::sendEvent(&row, &leave);
      }
      pictures.push_back(pictureOf(row));
    };
    take(nullptr);
    for (const auto& [name, state] : kStates) take(&state);
    return pictures;
  }
};

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme::apply(application, true);
  TestRowPictures test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_rowpictures.moc"
