// SPDX-License-Identifier: Apache-2.0
#include "core/base/utf8.h"

#include <QTest>

using namespace ps;

class TestUtf8 : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void textsEndWhereTheyStopBeingUtf8_data();
  void textsEndWhereTheyStopBeingUtf8();
  void cutsStandBetweenCharacters();
  void shownTextsAreOneSoundLine();
};

void TestUtf8::textsEndWhereTheyStopBeingUtf8_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<int>("sound");
  const auto row = [](const char* name, const QByteArray& text, int sound) { QTest::newRow(name) << text << sound; };
  row("empty", "", 0);
  row("letters", "ice", 3);
  row("every length", "a\u00e9\u20ac\U0001F9CA", 10);
  row("the last character", "\U0010FFFF", 4);
  row("beyond it", "a\xF4\x90\x80\x80", 1);
  row("surrogate", "a\xED\xA0\x80", 1);
  row("overlong slash", "a\xC0\xAF", 1);
  row("overlong, three bytes", "a\xE0\x80\xAF", 1);
  row("overlong, four bytes", "a\xF0\x80\x80\xAF", 1);
  row("bare continuation", "a\x80", 1);
  row("cut", "a\xE2\x82", 1);
  row("cut by a letter", "a\xE2\x82z", 1);
  row("no byte of UTF-8", "a\xFF", 1);
}

void TestUtf8::textsEndWhereTheyStopBeingUtf8() {
  QFETCH(QByteArray, text);
  QFETCH(int, sound);
  QCOMPARE(static_cast<int>(utf8Length(text.toStdString())), sound);
  QCOMPARE(QString::fromUtf8(text).contains(QChar::ReplacementCharacter), sound < text.size());
}

void TestUtf8::cutsStandBetweenCharacters() {
  QCOMPARE(cutText("abc", 3), std::string("abc"));
  QCOMPARE(cutText("abcd", 3), std::string("abc…"));
  QCOMPARE(cutText("a€b", 3), std::string("a…"));
  QCOMPARE(cutText("a€b", 4), std::string("a€…"));
  QCOMPARE(cutText("€", 1), std::string("…"));
}

void TestUtf8::shownTextsAreOneSoundLine() {
  QCOMPARE(shownText(std::string("a\nb\0c\x1b[1m", 9), 50), std::string("a b c [1m"));
  QCOMPARE(shownText("a\xE2\x82", 50), std::string("a\uFFFD\uFFFD"));
  QCOMPARE(shownText("€€€", 7), std::string("€€…"));
}

QTEST_APPLESS_MAIN(TestUtf8)
#include "tst_utf8.moc"
