// SPDX-License-Identifier: Apache-2.0
#include "ui/session/autosavenote.h"

#include "core/base/hash.h"
#include "core/io/filelock.h"
#include "core/io/outputfile.h"
#include "core/io/recording.h"
#include "ui/session/savejob.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>

#include <algorithm>
#include <iterator>
#include <limits>

namespace ps::notes {
namespace {

constexpr const char* kEnds[] = {"", "replaced", "closed"};  // by SessionEnd
const QString kNote = QStringLiteral(".note"), kJson = QStringLiteral(".json"), kSaving = QStringLiteral("saving");

QJsonObject toJson(const ViewState& view) {
  QJsonObject json{{QStringLiteral("colour"), QString::fromStdString(view.colour)}};
  if (const auto& section = view.section) {
    const Vector3& p = section->through;
    json.insert(QStringLiteral("section"),
                QJsonObject{{QStringLiteral("across"), QString::fromStdString(section->across)},
                            {QStringLiteral("through"), QJsonArray{p[0], p[1], p[2]}},
                            {QStringLiteral("flipped"), section->flipped}});
  }
  if (!view.camera) return json;
  const Vector3& target = view.camera->target;
  json.insert(QStringLiteral("target"), QJsonArray{target[0], target[1], target[2]});
  json.insert(QStringLiteral("distance"), view.camera->distance);
  json.insert(QStringLiteral("azimuth"), view.camera->azimuth);
  json.insert(QStringLiteral("elevation"), view.camera->elevation);
  return json;
}

/// m; what is no number stays as in `otherwise`.
Vector3 placeOf(const QJsonValue& json, Vector3 otherwise) {
  const QJsonArray numbers = json.toArray();
  for (int i = 0; i < 3; ++i) otherwise[i] = numbers.at(i).toDouble(otherwise[i]);
  return otherwise;
}

ViewState viewOf(const QJsonObject& json) {
  ViewState view;
  view.colour = json.value(QStringLiteral("colour")).toString(QString::fromStdString(view.colour)).toStdString();
  if (json.contains(QStringLiteral("section"))) {
    const QJsonObject section = json.value(QStringLiteral("section")).toObject();
    ViewSection& kept = view.section.emplace();
    for (const char* axis : {"x", "y", "z"}) {
      if (section.value(QStringLiteral("across")).toString() == QLatin1String(axis)) kept.across = axis;
    }
    kept.through = placeOf(section.value(QStringLiteral("through")), kept.through);
    kept.flipped = section.value(QStringLiteral("flipped")).toBool();
  }
  if (!json.contains(QStringLiteral("target"))) return view;
  ViewCamera& camera = view.camera.emplace();
  const auto number = [&](const char* key, double& value) { value = json.value(QLatin1String(key)).toDouble(value); };
  camera.target = placeOf(json.value(QStringLiteral("target")), camera.target);
  number("distance", camera.distance);
  number("azimuth", camera.azimuth);
  number("elevation", camera.elevation);
  return view;
}

using Span = std::pair<double, double>;

QJsonValue toJson(const std::optional<Span>& span) {
  return span ? QJsonValue(QJsonArray{span->first, span->second}) : QJsonValue();
}

std::optional<Span> spanOf(const QJsonValue& json) {
  const QJsonValue first = json[0], last = json[1];
  return first.isDouble() && last.isDouble() ? std::optional(Span(first.toDouble(), last.toDouble())) : std::nullopt;
}

QJsonObject toJson(const GraphLook& look) {
  QJsonArray cursors, values;
  for (const std::optional<double>& at : look.cursors) cursors.append(at ? QJsonValue(*at) : QJsonValue());
  for (const std::optional<Span>& span : look.values) values.append(toJson(span));
  return {{QStringLiteral("cursors"), cursors},
          {QStringLiteral("range"), toJson(look.range)},
          {QStringLiteral("values"), values}};
}

GraphLook graphOf(const QJsonValue& json) {
  GraphLook look;
  const auto placeOf = [](const QJsonValue& at) { return at.isDouble() ? std::optional(at.toDouble()) : std::nullopt; };
  const QJsonValue cursors = json[QStringLiteral("cursors")];
  for (size_t which = 0; which < look.cursors.size(); ++which)
    look.cursors[which] = placeOf(cursors[static_cast<int>(which)]);
  look.range = spanOf(json[QStringLiteral("range")]);
  for (const QJsonValue& span : json[QStringLiteral("values")].toArray()) look.values.push_back(spanOf(span));
  return look;
}

constexpr const char* kKinds[] = {"scene", "group",  "body",  "emitter",     "sink",
                                  "wall",  "probes", "probe", "environment", "pin"};  // by OutlineKind

QJsonObject toJson(const LastLook& look) {
  QJsonArray selected;
  for (const SelectedItem& item : look.selected)
    selected.append(QJsonObject{{QStringLiteral("kind"), QLatin1String(kKinds[static_cast<size_t>(item.kind)])},
                                {QStringLiteral("id"), QString::fromStdString(item.id)}});
  QJsonObject json{{QStringLiteral("selected"), selected},
                   {QStringLiteral("material"), QString::fromStdString(look.material)},
                   {QStringLiteral("playing"), look.playing},
                   {QStringLiteral("run"), look.hasRun}};
  if (look.shownAt) json.insert(QStringLiteral("shownAt"), *look.shownAt);
  QJsonObject graphs;
  for (const auto& [id, graph] : look.graphs) graphs.insert(QString::fromStdString(id), toJson(graph));
  if (!graphs.isEmpty()) json.insert(QStringLiteral("graphs"), graphs);
  if (look.legend) json.insert(QStringLiteral("legend"), toJson(look.legend));
  if (!look.brush.empty()) json.insert(QStringLiteral("brush"), QString::fromStdString(look.brush));
  return json;
}

LastLook lookOf(const QJsonObject& json) {
  LastLook look;
  for (const QJsonValue& value : json.value(QStringLiteral("selected")).toArray()) {
    const QString name = value[QStringLiteral("kind")].toString();
    const auto kind = std::find(std::begin(kKinds), std::end(kKinds), name);
    if (kind == std::end(kKinds)) continue;
    look.selected.push_back({static_cast<OutlineKind>(std::distance(std::begin(kKinds), kind)),
                             value[QStringLiteral("id")].toString().toStdString()});
  }
  look.material = json.value(QStringLiteral("material")).toString().toStdString();
  look.playing = json.value(QStringLiteral("playing")).toBool(look.playing);
  look.hasRun = json.value(QStringLiteral("run")).toBool();
  const QJsonValue at = json.value(QStringLiteral("shownAt"));
  if (at.isDouble()) look.shownAt = at.toDouble();
  const QJsonObject cursors = json.value(QStringLiteral("cursors")).toObject();  // as older programs noted them
  for (auto graph = cursors.begin(); graph != cursors.end(); ++graph)
    look.graphs[graph.key().toStdString()] = graphOf(QJsonObject{{QStringLiteral("cursors"), graph.value()}});
  const QJsonObject graphs = json.value(QStringLiteral("graphs")).toObject();
  for (auto graph = graphs.begin(); graph != graphs.end(); ++graph)
    look.graphs[graph.key().toStdString()] = graphOf(graph.value());
  look.legend = spanOf(json.value(QStringLiteral("legend")));
  look.brush = json.value(QStringLiteral("brush")).toString().toStdString();
  return look;
}

// Numbers of 64 bits as text: JSON's are doubles.
QString text(uint64_t number) { return QString::number(number, 16); }
uint64_t number(const QJsonValue& value) { return value.toString().toULongLong(nullptr, 16); }

QJsonValue toJson(const FileStamp& stamp) {
  if (!stamp.known) return {};
  return QJsonObject{{QStringLiteral("size"), text(stamp.size)},
                     {QStringLiteral("inode"), text(stamp.inode)},
                     {QStringLiteral("time"), text(static_cast<uint64_t>(stamp.time))},
                     {QStringLiteral("hash"), text(stamp.hash)}};
}

FileStamp stampOf(const QJsonValue& value) {
  if (!value.isObject()) return {};
  const QJsonObject json = value.toObject();
  return {true, number(json[QStringLiteral("size")]), number(json[QStringLiteral("inode")]),
          static_cast<int64_t>(number(json[QStringLiteral("time")])), number(json[QStringLiteral("hash")])};
}

QJsonObject noteOf(const QString& stem) {
  QFile file(stem + kNote);
  return file.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(file.readAll()).object() : QJsonObject();
}

void put(const QString& stem, const QJsonObject& note) {
  writeFileAtomically((stem + kNote).toStdString(), QJsonDocument(note).toJson().toStdString());
}

/// Notes a file of a session: a copy by the change that it holds, which older programs did not say.
void addFile(std::map<QString, Copies>& sessions, const QDir& dir, const QString& name) {
  const QString stem = name.section(QLatin1Char('.'), 0, 0);
  Copies& copies = sessions[dir.filePath(stem)];
  if (!name.endsWith(kJson)) return;
  const QString change = name.mid(stem.size() + 1).chopped(4);  // "12." of "12.json", or ""
  bool good = change.isEmpty();
  const uint64_t n = good ? 0 : change.chopped(1).toULongLong(&good);
  if (good) copies[n] = dir.filePath(name);
}

/// Of one session.
Copies copiesOf(const QString& stem) {
  std::map<QString, Copies> found;
  const QFileInfo info(stem);
  for (const QString& name : info.dir().entryList({info.fileName() + QStringLiteral(".*json")}, QDir::Files))
    addFile(found, info.dir(), name);
  return found.empty() ? Copies() : found.begin()->second;
}

/// Whether the file that belongs to the copy holds the same work or later work by now.
bool isSaved(uint64_t change, const QJsonObject& note) {
  const QJsonObject saving = note.value(kSaving).toObject();
  if (saving.isEmpty() || change > number(saving[QStringLiteral("change")])) return false;
  const std::string path = saving[QStringLiteral("path")].toString().toStdString();
  return holdsStamped(path,
                      {true, number(saving[QStringLiteral("size")]), 0, 0, number(saving[QStringLiteral("hash")])});
}

/// Of sessions that were killed between writing a run and its note, or that were taken over since.
void removeStrayRuns(const QString& directory) {
  const QDir dir(directory);
  for (const QString& name : dir.entryList({QLatin1Char('*') + QLatin1String(kRecordingEnding)}, QDir::Files)) {
    const QString stem = dir.filePath(name).chopped(static_cast<int>(qstrlen(kRecordingEnding)));
    if (!QFile::exists(stem + kNote) && !FileLock::isHeld((stem + QStringLiteral(".lock")).toStdString()))
      QFile::remove(dir.filePath(name));
  }
}

}  // namespace

QString copyPath(const QString& stem, uint64_t change) {
  return stem + QLatin1Char('.') + QString::number(change) + kJson;
}

QString runPath(const QString& stem) { return stem + QLatin1String(kRecordingEnding); }

std::map<QString, Copies> sessions(const QString& directory) {
  std::map<QString, Copies> found;
  const QDir dir(directory);
  for (const QString& name : dir.entryList({QLatin1Char('*') + kNote, QLatin1Char('*') + kJson}, QDir::Files))
    addFile(found, dir, name);
  return found;
}

AutosavedSession read(const QString& stem, const Copies& all) {
  AutosavedSession session;
  session.stem = stem;
  const QJsonObject note = noteOf(stem);
  const uint64_t change = all.empty() ? 0 : all.rbegin()->first;
  const QString copy = all.empty() ? QString() : all.rbegin()->second;
  // A copy that is newer than the note was written when the program ended between the two.
  const bool unsaved = note.isEmpty() || note.value(QStringLiteral("unsaved")).toBool() ||
                       change > number(note.value(QStringLiteral("change")));
  if (!all.empty() && unsaved && !isSaved(change, note)) session.copy = copy;
  session.change = change;
  session.path = note.value(QStringLiteral("path")).toString();
  session.title = note.value(QStringLiteral("title")).toString(QFileInfo(stem).fileName());
  session.time = QDateTime::fromString(note.value(QStringLiteral("time")).toString(), Qt::ISODateWithMs);
  if (!session.time.isValid()) session.time = QFileInfo(copy.isEmpty() ? stem + kNote : copy).lastModified();
  session.file = stampOf(note.value(QStringLiteral("file")));
  session.view = viewOf(note.value(QStringLiteral("view")).toObject());
  session.look = lookOf(note.value(QStringLiteral("look")).toObject());
  const QString ended = note.value(QStringLiteral("ended")).toString();
  for (const SessionEnd end : {SessionEnd::Replaced, SessionEnd::Closed}) {
    if (ended == QLatin1String(kEnds[static_cast<size_t>(end)])) session.end = end;
  }
  return session;
}

void write(const AutosavedSession& session) {
  put(session.stem, {{QStringLiteral("path"), session.path},
                     {QStringLiteral("title"), session.title},
                     {QStringLiteral("time"), session.time.toString(Qt::ISODateWithMs)},
                     {QStringLiteral("ended"), QString::fromLatin1(kEnds[static_cast<size_t>(session.end)])},
                     {QStringLiteral("unsaved"), !session.copy.isEmpty()},
                     {QStringLiteral("change"), text(session.change)},
                     {QStringLiteral("file"), toJson(session.file)},
                     {QStringLiteral("view"), toJson(session.view)},
                     {QStringLiteral("look"), toJson(session.look)},
                     {kSaving, noteOf(session.stem).value(kSaving)}});
}

void announceSave(const QString& stem, uint64_t change, const QString& path, const FileStamp& bytes) {
  QJsonObject note = noteOf(stem);
  if (note.isEmpty() && copiesOf(stem).empty()) return;
  note.insert(kSaving, QJsonObject{{QStringLiteral("change"), text(change)},
                                   {QStringLiteral("path"), path},
                                   {QStringLiteral("size"), text(bytes.size)},
                                   {QStringLiteral("hash"), text(bytes.hash)}});
  put(stem, note);
}

void removeCopies(const QString& stem, uint64_t upTo) {
  for (const auto& [change, path] : copiesOf(stem)) {
    if (change <= upTo) QFile::remove(path);
  }
}

void removeAll(const QString& stem) {
  removeCopies(stem, std::numeric_limits<uint64_t>::max());
  for (const char* ending : {".note", ".lock", kRecordingEnding}) QFile::remove(stem + QLatin1String(ending));
}

void tidy(const QString& directory) {
  removeLeftParts(directory.toStdString(), {});
  QStringList paths;
  for (const auto& [stem, copies] : sessions(directory)) {
    const QJsonObject note = noteOf(stem);
    if (!copies.empty() && isSaved(copies.rbegin()->first, note) &&
        !FileLock::isHeld((stem + QStringLiteral(".lock")).toStdString()))
      removeCopies(stem, copies.rbegin()->first);
    paths << note.value(QStringLiteral("path")).toString()
          << note.value(kSaving).toObject().value(QStringLiteral("path")).toString();
  }
  removeStrayRuns(directory);
  paths.removeDuplicates();
  for (const QString& path : paths) {
    if (path.isEmpty()) continue;
    removeLeftParts(path.toStdString());
    const QString lock = lockPath(path);
    if (QFile::exists(lock) && !FileLock::isHeld(lock.toStdString())) QFile::remove(lock);
  }
}

}  // namespace ps::notes
