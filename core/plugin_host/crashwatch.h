// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

// Why a signal handler: a plugin that aborts or runs wild in a step takes the program along, and at the next start the
// scene would play and die again. Every call of a plugin says so in a variable of its thread (core/base/callee.h); a
// crash arrives on the thread that caused it, so the handler knows the culprit, and a crash of our own, or a process
// that is killed, accuses nobody. The handler writes a file that was made ready beforehand, and lets the signal do its
// work.
namespace ps {

class Quarantine;

/// From now on crashes inside a plugin's code are recorded. Several registries of one process may call it.
void watchForCrashes(const Quarantine& quarantine);
/// The program is ending: what crashes from here on does so because what it needs is gone, and accuses nobody.
void accuseNobody();
/// Does that at exit(), before what was made until now is taken down.
void accuseNobodyAtExit();
/// Makes the record of one plugin ready. One that came with the program has none: it is tried again at the next start.
void noteForCrashes(const Quarantine& quarantine, const std::string& id, const std::string& path);

/// Writes that record for a plugin that does not come back from a call: whoever ends the program now, it is not loaded
/// at the next start. False, and nothing happens, for one of which there is no record, and when the program is ending;
/// one that is being loaded has left its lock.
bool putInQuarantine(const std::string& id);
/// It has come back after all.
void takeFromQuarantine(const std::string& id);

}  // namespace ps
