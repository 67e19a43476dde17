// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/autosave.h"

#include <QtCore/QString>

#include <map>

/// The files of a session in the autosave folder: `stem`.note says what it works on, `stem`.N.json is a copy of the
/// project as it was at change N, `stem`.psrec is its run, `stem`.lock is locked while the session runs. A copy is
/// written before the note that tells of it, and goes after the one that does not. Everything here reads or writes
/// files.
namespace ps::notes {

QString copyPath(const QString& stem, uint64_t change);
QString runPath(const QString& stem);        ///< of the recording of its run, where it ended in order
using Copies = std::map<uint64_t, QString>;  ///< of a session, by the change that they hold
/// All sessions that left a note or a copy, by stem. Reads the folder once, however many there are.
std::map<QString, Copies> sessions(const QString& directory);
/// Whatever can be read of it: a copy without a readable note is a copy all the same, of a nameless project.
AutosavedSession read(const QString& stem, const Copies& copies);
/// Throws Error.
void write(const AutosavedSession& session);
/// Before the file at `path` gets bytes of this size and hash, which hold the project as it was at `change`: when it
/// does, copies that are not newer are not to be offered any more.
void announceSave(const QString& stem, uint64_t change, const QString& path, const FileStamp& bytes);
void removeCopies(const QString& stem, uint64_t upTo);
void removeAll(const QString& stem);
/// Removes what programs left that were killed while they wrote, in the folder and beside the projects that its notes
/// name, copies that are not newer than their file, and runs that no note tells of.
void tidy(const QString& directory);

}  // namespace ps::notes
