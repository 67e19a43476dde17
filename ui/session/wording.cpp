// SPDX-License-Identifier: Apache-2.0
#include "ui/session/wording.h"

#include "core/simulation/events.h"
#include "ui/theme/numbers.h"
#include "ui/theme/units.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ps {
namespace {

constexpr double kTells = 0.02;  // share from which what is left can be told
constexpr int kRunning = 3;      // significant digits of what may change with every frame

/// All digits stay, zeros too, so that it keeps its width.
QString runningText(double shown, const QString& unit) {
  const QString number = formatNumber(shown, kRunning);
  return unit.isEmpty() ? number : number + QLatin1Char(' ') + unit;
}

}  // namespace

QString sentence(const QString& text) { return text.endsWith(QLatin1Char('.')) ? text : text + QLatin1Char('.'); }

QString countText(size_t count, const QString& one, const QString& many) {
  return formatFixed(static_cast<double>(count)) + QLatin1Char(' ') + (count == 1 ? one : many);
}

QString particlesAhead(double count) { return QStringLiteral("≈ %1 particles").arg(formatShort(count, 3)); }

QString spanText(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  if (whole < 60) return QStringLiteral("%1 s").arg(whole);
  const long long minutes = whole / 60, hours = minutes / 60, days = hours / 24;
  if (hours < 1) return QStringLiteral("%1 min %2 s").arg(minutes).arg(whole % 60);
  if (days < 1) return QStringLiteral("%1 h %2 min").arg(hours).arg(minutes % 60);
  return QStringLiteral("%1 d %2 h").arg(days).arg(hours % 24);
}

double secondsLeft(double seconds, double done) { return done > kTells ? seconds * (1 - done) / done : -1; }

QString progressText(double done, double left) {
  const QString text = formatFixed(100 * done, 0) + QStringLiteral(" %");
  return left < 0 ? text : text + QStringLiteral(", %1 left").arg(spanText(left));
}

QString clockText(double seconds) {
  const auto hundredths = static_cast<long long>(std::floor(std::max(0.0, seconds) * 100 + 1e-6));
  return QStringLiteral("%1:%2.%3")
      .arg(hundredths / 6000, 2, 10, QLatin1Char('0'))
      .arg(hundredths / 100 % 60, 2, 10, QLatin1Char('0'))
      .arg(hundredths % 100, 2, 10, QLatin1Char('0'));
}

bool hasMatter(const FrameStats& stats) {
  return std::any_of(stats.phases.begin(), stats.phases.end(), [](const PhaseAmount& phase) { return phase.mass > 0; });
}

FailureText failureText(const EngineEvent& event) {
  const auto has = [&](StepFlag flag) { return (event.flags & static_cast<StepFlags>(flag)) != 0; };
  const QString message = QString::fromStdString(event.message);
  const QString detail = message.isEmpty() ? QString() : message + QStringLiteral(". ");
  if (has(StepFlag::NotFinite)) {
    return {QStringLiteral("Paused: the step gave no usable numbers."),
            detail +
                QStringLiteral("The last good frame is kept. Undo the last change, or raise the substeps, then play.")};
  }
  if (has(StepFlag::Unphysical)) {
    return {
        QStringLiteral("Paused: the step gave what cannot be."),
        detail + QStringLiteral("The last good frame is kept. Undo the last change, or choose another plugin than the "
                                "one that is named, then play.")};
  }
  if (has(StepFlag::PluginFault)) {
    return {QStringLiteral("Paused: a plugin failed."),
            detail + QStringLiteral("Play goes on without it; Plugins shows what it said.")};
  }
  if (has(StepFlag::LostParticle)) {
    return {QStringLiteral("Matter left the scene."),
            detail + QStringLiteral("Close that side with a wall; where one stands, raise the substeps."), true};
  }
  if (has(StepFlag::Diverged)) {
    return {QStringLiteral("The liquid is squeezed more than the solver can mend."),
            detail + QStringLiteral("Raise the substeps, or choose a larger particle spacing.")};
  }
  if (has(StepFlag::EnergyOpen)) {
    return {QStringLiteral("The energy balance does not close."),
            detail + QStringLiteral("The thermal model loses heat; choose another under Solver.")};
  }
  if (event.kind == EngineEvent::Kind::Remark) return {QStringLiteral("Opened, with one remark."), sentence(message)};
  if (event.kind == EngineEvent::Kind::Stopped) {
    return {QStringLiteral("Paused: the simulation could not go on."),
            detail + QStringLiteral("Undo the last change, or go back to the start, then play.")};
  }
  return {QStringLiteral("That change could not be made."), message};
}

std::optional<Address> limitAddress(const Limit& limit, const std::vector<std::string>* bodies) {
  if (const auto whole = Address::parse(limit.what)) return whole;
  const size_t dot = limit.what.rfind('.');  // ids may have some themselves: "org.example.cable"
  if (dot == 0 || dot == std::string::npos) return std::nullopt;
  const std::string owner = limit.what.substr(0, dot), key = limit.what.substr(dot + 1);
  for (const Owner one : {Owner::Solver, Owner::Environment, Owner::Thermal}) {
    if (owner == ownerName(one)) return Address{one, "", key};
  }
  if (limit.body < 0) return Address{Owner::Material, owner, key};
  const auto body = static_cast<size_t>(limit.body);
  if (!bodies || body >= bodies->size()) return std::nullopt;
  return Address{Owner::Constraint, (*bodies)[body], key, owner};
}

namespace {

/// "above 412 °C"
QString whereText(const std::array<double, 2>& kelvin) {
  const auto shown = [](double t) { return temperatureText(t, 0); };
  const auto [from, to] = kelvin;
  if (!(from > 0)) return std::isfinite(to) ? QStringLiteral("below %1").arg(shown(to)) : QStringLiteral("everywhere");
  if (!std::isfinite(to)) return QStringLiteral("above %1").arg(shown(from));
  return QStringLiteral("between %1 and %2").arg(shown(from), shown(to));
}

}  // namespace

QString limitNote(const Limit& limit, const api::ParameterDeclaration* declaration) {
  if (limit.what == kBalanceLimit)
    return QStringLiteral("heat balance open by %1")
        .arg(formatPrefixed(limit.delivered, QStringLiteral("J"), kRunning));
  if (limit.what == kSqueezeLimit)
    return QStringLiteral("liquid is %1 % too dense, solid matter on its way or squeezed may leave it no room")
        .arg(formatFixed(100 * limit.delivered, 0));
  if (limit.what == kGapLimit)
    return QStringLiteral("heat also conducts across a gap of %1, which is narrower than a particle")
        .arg(formatPrefixed(limit.asked, QStringLiteral("m"), kRunning));
  const QString what = limitText(limit, declaration).section(QLatin1Char(':'), 0, 0);
  if (limit.kelvin) return what + QStringLiteral(" leaves its range ") + whereText(*limit.kelvin);
  if (!limit.why.empty()) return what + QStringLiteral(": ") + QString::fromStdString(limit.why);
  return what + QStringLiteral(" is limited by the step");
}

QString limitText(const Limit& limit, const api::ParameterDeclaration* declaration) {
  if (declaration && limit.kelvin) {
    return QStringLiteral("%1: leaves its range %2, where matter is; %3 is used for %4. Change the curve or law")
        .arg(QString::fromUtf8(declaration->label), whereText(*limit.kelvin),
             formatValue(*declaration, limit.delivered), formatValue(*declaration, limit.asked));
  }
  const QString where =
      limit.why.empty() ? QStringLiteral("at this step") : QStringLiteral("here: ") + QString::fromStdString(limit.why);
  const QString unit = QString::fromStdString(limit.unit);
  if (declaration && limit.unit == declaration->unit) {
    return QStringLiteral("%1: the solver reaches %2 of %3 %4")
        .arg(QString::fromUtf8(declaration->label),
             runningText(toDisplay(*declaration, limit.delivered), displayUnit(*declaration)),
             formatValue(*declaration, limit.asked), where);
  }
  return QStringLiteral("%1: the solver reaches %2 of %3 %4")
      .arg(QString::fromUtf8(declaration ? declaration->label : limit.what.c_str()), runningText(limit.delivered, unit),
           formatQuantity(limit.asked, unit), where);
}

}  // namespace ps
