// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/address.h"
#include "core/simulation/snapshot.h"

#include <QtCore/QString>

namespace ps {

struct EngineEvent;

/// With a full stop.
QString sentence(const QString& text);
/// "1 body", "2 bodies".
QString countText(size_t count, const QString& one, const QString& many);
/// "≈ 1 240 particles": how many there would be.
QString particlesAhead(double count);
/// "2 h 20 min", "41 min", "38 s": spans of time as people say them.
QString spanText(double seconds);
/// s for which work goes on, of which `done` (0..1) took `seconds`; -1 where it is too early to tell.
double secondsLeft(double seconds, double done);
/// "37 %, 8 s left"; "37 %" where `left` is negative.
QString progressText(double done, double left);
/// "00:42.00": minutes, seconds, hundredths.
QString clockText(double seconds);
/// Whether there is matter that phases count: what is held in place is not among it.
bool hasMatter(const FrameStats& stats);
/// What went wrong and what to do about it, for a notice; of anything but Settled.
struct FailureText {
  QString title, text;
  bool lost = false;  ///< matter left the scene
};
FailureText failureText(const EngineEvent& event);
/// "water.youngs_modulus" as the address material/water/youngs_modulus; nothing when it has no owner. `bodies`:
/// Snapshot::bodyIds, by which the limit counts.
std::optional<Address> limitAddress(const Limit& limit, const std::vector<std::string>* bodies);
/// "Young's modulus: the solver reaches 42.0 MPa of 9.3 GPa at this step." `declaration`: of its address; nullptr where
/// it has none.
QString limitText(const Limit& limit, const api::ParameterDeclaration* declaration);
/// The same in a few words, for the status line.
QString limitNote(const Limit& limit, const api::ParameterDeclaration* declaration);

}  // namespace ps
