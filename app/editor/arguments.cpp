// SPDX-License-Identifier: Apache-2.0
#include "app/editor/arguments.h"

#include <cmath>

namespace ps {

const char* const kEditorUsage =
    "usage: phasesketch [PROJECT] [options]\n"
    "  --screenshot FILE.png  write a picture of the window and exit\n"
    "  --after SECONDS        how long to run before it (3)\n"
    "  --size WxH             size of the window\n"
    "  --theme dark|light\n"
    "  --list-plugins         plugins found, one per line, and exit\n"
    "  --version, --help\n";

namespace {

QSize parseSize(const QString& text) {
  const QStringList parts = text.split(QLatin1Char('x'));
  if (parts.size() != 2) return {};
  bool goodWidth = false, goodHeight = false;
  const QSize size(parts[0].toInt(&goodWidth), parts[1].toInt(&goodHeight));
  const bool sane = size.width() >= 320 && size.height() >= 240 && size.width() <= 16384 && size.height() <= 16384;
  return goodWidth && goodHeight && sane ? size : QSize();
}

/// Takes an option's value into `out`; "" or what is wrong.
QString assign(EditorArguments& out, const QString& option, const QString& value) {
  if (option == QLatin1String("--screenshot")) {
    out.screenshot = value;
  } else if (option == QLatin1String("--after")) {
    bool good = false;
    out.after = value.toDouble(&good);
    if (!good || !(out.after >= 0) || out.after > 86400)
      return QStringLiteral("--after: '%1' is not a number of seconds").arg(value);
  } else if (option == QLatin1String("--size")) {
    out.size = parseSize(value);
    if (!out.size.isValid()) return QStringLiteral("--size: '%1' is not a size like 1280x800").arg(value);
  } else {
    if (value != QLatin1String("dark") && value != QLatin1String("light"))
      return QStringLiteral("--theme: '%1' is neither dark nor light").arg(value);
    out.dark = value == QLatin1String("dark");
  }
  return {};
}

}  // namespace

EditorArguments parseArguments(const QStringList& arguments) {
  EditorArguments out;
  const QStringList withValue{QStringLiteral("--screenshot"), QStringLiteral("--after"), QStringLiteral("--size"),
                              QStringLiteral("--theme")};
  for (qsizetype i = 0; i < arguments.size() && out.problem.isEmpty(); ++i) {
    QString name = arguments[i], value;
    const qsizetype equals = name.startsWith(QLatin1String("--")) ? name.indexOf(QLatin1Char('=')) : -1;
    if (equals > 0) {
      value = name.mid(equals + 1);
      name.truncate(equals);
    }
    if (withValue.contains(name)) {
      if (equals < 0 && i + 1 >= arguments.size()) {
        out.problem = name + QStringLiteral(" needs a value");
      } else {
        out.problem = assign(out, name, equals < 0 ? arguments[++i] : value);
      }
    } else if (name == QLatin1String("--list-plugins")) {
      out.listPlugins = true;
    } else if (name == QLatin1String("--version")) {
      out.version = true;
    } else if (name == QLatin1String("--help") || name == QLatin1String("-h")) {
      out.help = true;
    } else if (name.startsWith(QLatin1Char('-'))) {
      out.problem = QStringLiteral("unknown option '%1'").arg(name);
    } else if (!out.project.isEmpty()) {
      out.problem = QStringLiteral("one project at a time, please: '%1' is the second").arg(name);
    } else {
      out.project = name;
    }
  }
  return out;
}

}  // namespace ps
