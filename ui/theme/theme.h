// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <QtCore/QByteArray>
#include <QtCore/QString>
#include <QtGui/QColor>
#include <QtGui/QFont>
#include <QtGui/QPalette>

#include <array>
#include <vector>

class QApplication;

namespace ps {

/// The colours of the interface; names as in resources/theme/tokens.json. No other file of the program holds a colour.
enum class Token {
  Window,
  Panel,
  Header,
  Field,
  Raised,
  RaisedEdge,
  Hover,
  Selection,
  Line,
  Line2,
  Text,
  Text2,
  Muted,
  Disabled,
  ControlEdge,
  Accent,
  OnAccent,
  SliderFill,
  Warning,
  Error,
  Ok,
  Info,
  Keyframe,
  Curve,
  WarningGround,
  ErrorGround,
  Overlay,
  Shadow,
  Handle,
  HandleEdge,
  FieldEdge,
  FieldEdgeHover,
  Track,
  TrackEdge,
  AxisX,
  AxisY,
  AxisZ,
  AxisHover,
  Count
};

/// What a text is for; decides size and weight.
enum class TextRole { Normal, Small, Medium, Time, Heading, Title, Symbol };

/// One look of the program: colours, colour series and fonts. A plain value; the one in force is `current()`.
class Theme {
 public:
  /// Reads `:/theme/tokens.json`. Throws Error that names the missing or malformed token.
  static Theme load(bool dark);
  /// The same from given text (tests, and a theme of one's own).
  static Theme parse(const QByteArray& tokens, bool dark);
  /// The theme in force; dark before the first apply().
  static const Theme& current();
  /// Makes this theme the one in force: fonts, style, palette and style sheet, set once on the application.
  static void apply(QApplication& application, bool dark);
  /// Name of a token in tokens.json: "slider_fill".
  static const char* name(Token token);

  bool dark() const { return m_dark; }
  QColor colour(Token token) const { return m_colours[static_cast<size_t>(token)]; }
  QColor operator[](Token token) const { return colour(token); }
  /// Colour of the n-th plotted line; after the last one they begin anew, to be drawn dashed (seriesDashed).
  QColor series(int index) const;
  bool seriesDashed(int index) const { return index >= static_cast<int>(m_series.size()); }

  static QFont font(TextRole role);
  QPalette palette() const;
  QString styleSheet() const;

 private:
  bool m_dark = true;
  std::array<QColor, static_cast<size_t>(Token::Count)> m_colours;
  std::vector<QColor> m_series;
};

/// Contrast of two opaque colours, 1 to 21 (WCAG 2.2, relative luminance of sRGB).
double contrast(const QColor& a, const QColor& b);

/// Letter that tells a phase apart without its colour: S M L B G.
QString phaseLetter(api::Phase phase);
/// "solid", "melting", "liquid", "boiling", "gas".
QString phaseName(api::Phase phase);

}  // namespace ps
