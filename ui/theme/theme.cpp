// SPDX-License-Identifier: Apache-2.0
#include "ui/theme/theme.h"

#include "core/base/error.h"
#include "ui/theme/psstyle.h"
#include "ui/theme/resources.h"

#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QRegularExpression>
#include <QtGui/QFontDatabase>
#include <QtWidgets/QApplication>
#include <QtWidgets/QToolTip>

#include <algorithm>
#include <cmath>

// Q_INIT_RESOURCE cannot stand in a namespace; the call keeps the linker from dropping a static library's resources.
static void initThemeResources() { Q_INIT_RESOURCE(theme); }

namespace ps {
namespace {

constexpr std::array<const char*, static_cast<size_t>(Token::Count)> kNames = {
    "window",         "panel",        "header",  "field",  "raised", "raised_edge", "hover",        "selection",
    "line",           "line2",        "text",    "text2",  "muted",  "disabled",    "control_edge", "accent",
    "on_accent",      "slider_fill",  "warning", "error",  "ok",     "info",        "keyframe",     "curve",
    "warning_ground", "error_ground", "overlay", "shadow", "handle", "handle_edge", "field_edge",   "field_edge_hover",
    "track",          "track_edge",   "axis_x",  "axis_y", "axis_z", "axis_hover"};

Theme& storage() {
  static Theme theme = Theme::load(true);
  return theme;
}

QColor parseColour(const QJsonValue& value, const QString& where) {
  const QColor colour(value.toString());
  if (!value.isString() || !colour.isValid()) {
    throw Error("tokens.json:/" + where.toStdString() + ": must be a colour like \"#1E2125\"");
  }
  return colour;
}

void addFonts() {
  static bool done = false;
  if (done) return;
  done = true;
  for (const char* file : {"PhaseSketchUI-Regular.otf", "PhaseSketchUI-Medium.otf", "PhaseSketchUI-SemiBold.otf",
                           "PhaseSketchSymbols-Italic.ttf"}) {
    if (QFontDatabase::addApplicationFont(QStringLiteral(":/fonts/") + QLatin1String(file)) < 0) {
      throw Error(std::string("The font ") + file + " of the program cannot be loaded");
    }
  }
}

}  // namespace

QByteArray themeResource(const QString& path) {
  initThemeResources();
  QFile file(QStringLiteral(":/") + path);
  if (!file.open(QIODevice::ReadOnly)) throw Error("The program lacks its file " + path.toStdString());
  return file.readAll();
}

const char* Theme::name(Token token) { return kNames[static_cast<size_t>(token)]; }

Theme Theme::load(bool dark) { return parse(themeResource(QStringLiteral("theme/tokens.json")), dark); }

Theme Theme::parse(const QByteArray& tokens, bool dark) {
  QJsonParseError problem;
  const QJsonDocument document = QJsonDocument::fromJson(tokens, &problem);
  if (document.isNull()) throw Error("tokens.json: " + problem.errorString().toStdString());
  const QString look = dark ? QStringLiteral("dark") : QStringLiteral("light");
  const QJsonObject colours = document.object()[look].toObject();
  Theme theme;
  theme.m_dark = dark;
  for (size_t i = 0; i < kNames.size(); ++i) {
    const QString token = QLatin1String(kNames[i]);
    theme.m_colours[i] = parseColour(colours[token], look + QLatin1Char('/') + token);
  }
  const QJsonArray series = colours[QStringLiteral("series")].toArray();
  for (qsizetype i = 0; i < series.size(); ++i) {
    theme.m_series.push_back(parseColour(series[i], QStringLiteral("%1/series/%2").arg(look).arg(i)));
  }
  if (theme.m_series.empty()) throw Error("tokens.json:/" + look.toStdString() + "/series: must list colours");
  return theme;
}

const Theme& Theme::current() { return storage(); }

void Theme::apply(QApplication& application, bool dark) {
  storage() = load(dark);
  addFonts();
  QApplication::setFont(font(TextRole::Normal));
  QToolTip::setFont(font(TextRole::Normal));
  if (!application.property("psStyle").toBool()) {
    QApplication::setStyle(new PsStyle);
    application.setProperty("psStyle", true);
  }
  QApplication::setPalette(current().palette());
  application.setStyleSheet(current().styleSheet());
}

QColor Theme::series(int index) const {
  const int count = static_cast<int>(m_series.size());
  return m_series[static_cast<size_t>(((index % count) + count) % count)];
}

QFont Theme::font(TextRole role) {
  QFont font(QStringLiteral("PhaseSketch UI"));
  font.setStyleStrategy(QFont::PreferAntialias);
  font.setHintingPreference(QFont::PreferNoHinting);
  font.setPixelSize(12);
  switch (role) {
    case TextRole::Normal:
      break;
    case TextRole::Small:
      font.setPixelSize(11);
      break;
    case TextRole::Medium:
      font.setWeight(QFont::Medium);
      break;
    case TextRole::Time:
      font.setPixelSize(13);
      font.setWeight(QFont::Medium);
      break;
    case TextRole::Heading:
      font.setPixelSize(14);
      font.setWeight(QFont::DemiBold);
      break;
    case TextRole::Title:
      font.setPixelSize(18);
      font.setWeight(QFont::DemiBold);
      break;
    case TextRole::Symbol:
      font.setFamily(QStringLiteral("PhaseSketch Symbols"));
      font.setItalic(true);
      font.setPixelSize(13);
      break;
  }
  return font;
}

QPalette Theme::palette() const {
  const Theme& t = *this;
  QPalette palette;
  palette.setColor(QPalette::Window, t[Token::Panel]);
  palette.setColor(QPalette::Base, t[Token::Field]);
  palette.setColor(QPalette::AlternateBase, t[Token::Header]);
  palette.setColor(QPalette::Button, t[Token::Raised]);
  palette.setColor(QPalette::ToolTipBase, t[Token::Header]);
  palette.setColor(QPalette::Highlight, t[Token::Selection]);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText,
                          QPalette::HighlightedText, QPalette::BrightText}) {
    palette.setColor(role, t[Token::Text]);
    palette.setColor(QPalette::Disabled, role, t[Token::Disabled]);
  }
  palette.setColor(QPalette::PlaceholderText, t[Token::Muted]);
  palette.setColor(QPalette::Link, t[Token::Accent]);
  palette.setColor(QPalette::LinkVisited, t[Token::Accent]);
  palette.setColor(QPalette::Light, t[Token::Hover]);
  palette.setColor(QPalette::Midlight, t[Token::Line2]);
  palette.setColor(QPalette::Mid, t[Token::Line]);
  palette.setColor(QPalette::Dark, t[Token::Window]);
  palette.setColor(QPalette::Shadow, t[Token::Window]);
  return palette;
}

QString Theme::styleSheet() const {
  QString sheet = QString::fromUtf8(themeResource(QStringLiteral("theme/style.qss")));
  // Accent on `selection` is too faint in the light theme for text of this size; there, text itself.
  const QColor changed =
      contrast(colour(Token::Accent), colour(Token::Selection)) >= 4.5 ? colour(Token::Accent) : colour(Token::Text);
  sheet.replace(QStringLiteral("@changed_text"), changed.name());
  // Darker, so that what stands on it is read in the dark theme as on accent, and in the light one better.
  sheet.replace(QStringLiteral("@accent_hover"), colour(Token::Accent).darker(115).name());
  static const QRegularExpression placeholder(QStringLiteral("@([a-z_0-9]+)"));
  for (qsizetype from = 0;;) {
    const QRegularExpressionMatch match = placeholder.match(sheet, from);
    if (!match.hasMatch()) return sheet;
    const auto found = std::find_if(kNames.begin(), kNames.end(),
                                    [&](const char* token) { return match.captured(1) == QLatin1String(token); });
    from = match.capturedEnd();
    if (found == kNames.end()) continue;  // "@token" of the comment
    const QString text = m_colours[static_cast<size_t>(found - kNames.begin())].name();
    sheet.replace(match.capturedStart(), match.capturedLength(), text);
    from = match.capturedStart() + text.size();
  }
}

double contrast(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& colour) {
    const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
  };
  const double la = luminance(a), lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

QString phaseLetter(api::Phase phase) { return QStringLiteral("SMLBG").mid(static_cast<int>(phase), 1); }

QString phaseName(api::Phase phase) {
  constexpr std::array names = {"solid", "melting", "liquid", "boiling", "gas"};
  return QLatin1String(names[static_cast<size_t>(phase)]);
}

}  // namespace ps
