// SPDX-License-Identifier: Apache-2.0
// What the record of a run gives, and what it keeps when it is full.
#include "core/base/bytepacker.h"
#include "core/base/error.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/progress.h"
#include "core/base/storedfile.h"
#include "core/simulation/engine.h"
#include "core/simulation/namedmatter.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/runrecordimpl.h"
#include "core/simulation/sceneneed.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace ps {
namespace {

constexpr size_t kStateWord = 4;  // bytes: most of a state are floats

std::vector<std::byte> unpackedState(const PackedBytes& stream) {
  if (static_cast<double>(stream.rawSize()) > roomToGrow(memoryNow()))
    throw InputError("a recorded state takes more memory than there is");
  const std::string planes = stream.unpacked();
  std::vector<std::byte> state(planes.size());
  ByteUnpacker::words(reinterpret_cast<char*>(state.data()), planes.data(), planes.size(), kStateWord);
  return state;
}

}  // namespace

size_t RunRecord::Impl::bytes() const {
  size_t sum = counted->memory + KeptRun::bytes();
  for (const KeptRun& run : earlier) sum += run.bytes();
  return sum;
}

size_t RunRecord::Impl::stateBytes() const {
  size_t sum = 0;
  for (const State& state : states) sum += state.stream->kept();
  return sum;
}

/// Earlier runs go first, as wholes. States may take half of it: frames are what people look at.
void RunRecord::Impl::makeRoom() {
  std::unique_lock lock(mutex);
  const auto isLent = [this] { return lending.use_count() > 1; };  // what is given up then is freed by nobody
  while (!isLent() && stateBytes() > (budget.memory + budget.disk) / 2 && thinStates()) {
  }
  for (;;) {
    const bool disk = counted->disk > budget.disk;
    if (!disk && bytes() <= budget.memory) return;
    if (const auto oldest = disk ? nullptr : oldestInMemory()) {
      const std::string folder = budget.folder;
      lock.unlock();
      const bool made = moved(*oldest, folder);
      lock.lock();
      if (made) continue;
      diskFails = true;
    }
    if (isLent()) return;
    if (const auto run = oldestRunThatFrees(); run != earlier.end()) {
      drop(run);
      return;  // it is given back before anything more is packed
    }
    if (!thinFrames() && !thinStates()) return;
  }
}

/// What may go to the disk next; nullptr where that is nothing.
std::shared_ptr<const PackedBytes> RunRecord::Impl::oldestInMemory() {
  if (budget.disk == 0 || diskFails) return nullptr;
  const auto among = [&](const KeptRun& run, uint64_t first) -> std::shared_ptr<const PackedBytes> {
    for (const State& state : run.states) {
      if (state.stream->inMemory() > 0) return state.stream;
    }
    for (auto frame = run.frames.lower_bound(first); frame != run.frames.end(); ++frame) {
      if (&run == this) onDisk = frame->first;
      std::shared_ptr<const PackedBytes> found;
      frame->second->part->eachBytes([&](const std::shared_ptr<const PackedBytes>& packed) {
        if (!found && packed->inMemory() > 0) found = packed;
      });
      if (found) return found;
    }
    return nullptr;
  };
  auto oldest = among(*this, onDisk);
  for (const KeptRun& run : earlier) {
    if (!oldest) oldest = among(run, 0);
  }
  const bool fits = oldest && counted->disk + StoredFile::room(oldest->size()) <= budget.disk;
  return fits ? oldest : nullptr;
}

/// By the thread: a long run has many frames, and the disk takes its time.
void RunRecord::forgetDisk() {
  {
    const std::lock_guard lock(m->mutex);
    m->forgetsDisk = true;
  }
  m->wake.notify_one();
}

KeptRun* RunRecord::Impl::runOf(uint64_t wanted) {
  if (number == wanted) return this;
  const auto run = std::find_if(earlier.begin(), earlier.end(), [&](const KeptRun& r) { return r.number == wanted; });
  return run == earlier.end() ? nullptr : &*run;
}

/// Some frames at a time: who looks at one meanwhile waits for no more. Runs may come and go in between.
void RunRecord::Impl::emptyDisk() {
  std::unique_lock lock(mutex);
  std::set<uint64_t> emptied;
  const auto next = [&]() -> KeptRun* {
    if (!emptied.contains(number)) return this;
    const auto run = std::find_if(earlier.begin(), earlier.end(),
                                  [&](const KeptRun& kept) { return !emptied.contains(kept.number); });
    return run == earlier.end() ? nullptr : &*run;
  };
  while (const KeptRun* run = next()) {
    const uint64_t each = run->number;
    emptied.insert(each);
    for (std::optional<uint64_t> from = 0; from;) {
      KeptRun* still = runOf(each);
      KeptRun gone;
      from = still ? forgetDiskOf(*still, *from, gone) : std::nullopt;
      lock.unlock();
      gone = {};
      lock.lock();
    }
  }
}

/// Of the frames from a number on as many as one turn looks at. Returns the number to go on from.
std::optional<uint64_t> RunRecord::Impl::forgetDiskOf(KeptRun& run, uint64_t from, KeptRun& gone) {
  constexpr size_t kTurn = 1000;
  const auto lies = [](const std::shared_ptr<const PackedBytes>& packed) {
    return packed->kept() > 0 && packed->inMemory() == 0;
  };
  const auto anyLies = [&](const PackedFrame& frame) {
    bool any = false;
    frame.part->eachBytes([&](const auto& packed) { any = any || lies(packed); });
    return any;
  };
  const State first = run.states.empty() ? State() : run.states.front();
  const auto stays = std::stable_partition(run.states.begin(), run.states.end(), [&](const State& state) {
    return state.stream == first.stream || !lies(state.stream);
  });
  gone.states.assign(stays, run.states.end());
  run.states.erase(stays, run.states.end());
  auto frame = run.frames.lower_bound(from);
  for (size_t k = 0; k < kTurn && frame != run.frames.end(); ++k) {
    const auto next = std::next(frame);
    const bool end = frame == run.frames.begin() || next == run.frames.end();
    if (!end && anyLies(*frame->second)) {
      gone.frames.emplace(*frame);
      run.eraseFrame(frame);
    }
    frame = next;
  }
  return frame == run.frames.end() ? std::nullopt : std::optional(frame->first);
}

bool RunRecord::Impl::moved(const PackedBytes& packed, const std::string& folder) {
  try {
    if (!file) file = StoredFile::nameless(folder);
    packed.moveTo(file);
    return true;
  } catch (const Error& problem) {
    log(LogLevel::Warning, std::string("The recording stays in memory: ") + problem.what());
    return false;
  }
}

std::vector<KeptRun>::iterator RunRecord::Impl::oldestRunThatFrees() {
  const bool any = headsAreMuch();
  return std::find_if(earlier.begin(), earlier.end(), [any](const KeptRun& run) {
    return any || run.frames.rbegin()->first >= run.adopted ||
           std::any_of(run.states.begin(), run.states.end(),
                       [](const State& state) { return state.stream->kept() > 0; });
  });
}

/// One of the older half; the oldest and the newest stay. What was among the newest the last time may be as coarse as
/// the rest already is before the rest gets coarser.
bool RunRecord::Impl::thinFrames() {
  const auto first = headsAreMuch() ? frames.begin() : frames.lower_bound(adopted);
  const auto count = std::distance(first, frames.end());
  if (count < 3) return false;
  for (;;) {
    for (auto frame = frames.upper_bound(std::max(sweep, first->first));
         frame != frames.end() && frame->first < sweepEnd; ++frame) {
      if (frame->first % stride == 0) continue;
      sweep = frame->first;
      erased = true;
      eraseFrame(frame);
      return true;
    }
    if (!erased) stride *= 2;
    erased = false;
    sweep = 0;
    sweepEnd = std::next(first, (count + 1) / 2)->first;
    if (stride > 2 * frames.rbegin()->first + 2) break;  // all that are left there are multiples of it
  }
  stride = 1;
  eraseFrame(std::next(first));
  return true;
}

/// The one whose neighbours stand closest, the oldest of those; the first stays, from which all can be made again.
bool RunRecord::Impl::thinStates() {
  const auto frees = [this](size_t at) { return states[at].stream->kept() > 0; };
  size_t least = 0;
  if (states.size() > 1 && frees(states.size() - 1)) least = states.size() - 1;
  for (size_t k = std::max(states.size(), size_t{1}) - 1; k-- > 1;) {
    const auto gap = [this](size_t at) { return states[at + 1].frame - states[at - 1].frame; };
    if (frees(k) && (least == 0 || least + 1 == states.size() || gap(k) <= gap(least))) least = k;
  }
  if (least == 0) return false;
  states.erase(states.begin() + static_cast<std::ptrdiff_t>(least));
  return true;
}

RunRecord::Extent RunRecord::extent() const {
  const std::lock_guard lock(m->mutex);
  if (m->frames.empty()) return {};
  const auto& [first, oldest] = *m->frames.begin();
  const auto& [last, newest] = *m->frames.rbegin();
  return {first, last, oldest->stats.time, newest->stats.time, m->frames.size()};
}

std::optional<uint64_t> RunRecord::frameAt(double time) const {
  const std::lock_guard lock(m->mutex);
  const auto frame = m->KeptRun::frameAt(time);
  return frame == m->frames.end() ? std::nullopt : std::optional(frame->first);
}

SnapshotPtr RunRecord::earlierFrame(uint64_t run, double time) const {
  std::shared_ptr<const PackedFrame> packed;
  uint64_t revision = 0;
  {
    const std::lock_guard lock(m->mutex);
    for (const KeptRun& kept : m->earlier) {
      if (kept.number != run || time <= kept.apart || time > kept.frames.rbegin()->second->stats.time) continue;
      packed = kept.frameAt(time)->second;
    }
    revision = m->revision;
  }
  return packed ? m->unpacker.snapshot(*packed, revision) : nullptr;
}

std::optional<uint64_t> RunRecord::neighbour(uint64_t frame, int steps) const {
  const std::lock_guard lock(m->mutex);
  auto at = m->frames.lower_bound(frame);
  if (at == m->frames.end() || at->first != frame) return std::nullopt;
  for (; steps > 0; --steps) {
    if (++at == m->frames.end()) return std::nullopt;
  }
  for (; steps < 0; ++steps) {
    if (at == m->frames.begin()) return std::nullopt;
    --at;
  }
  return at->first;
}

SnapshotPtr RunRecord::frame(uint64_t number) const {
  std::shared_ptr<const PackedFrame> packed;
  uint64_t revision = 0;
  {
    const std::lock_guard lock(m->mutex);
    const auto found = m->frames.find(number);
    if (found == m->frames.end()) return nullptr;
    packed = found->second;
    revision = m->revision;
  }
  return m->unpacker.snapshot(*packed, revision);
}

bool RunRecord::keepsField(uint64_t frame, std::string_view name) const {
  const std::lock_guard lock(m->mutex);
  const auto found = m->frames.find(frame);
  if (found == m->frames.end()) return false;
  const auto& fields = found->second->part->key->fields;
  return everySnapshotHas(name) ||
         std::any_of(fields.begin(), fields.end(), [&](const FieldPtr& field) { return field->name == name; });
}

std::optional<RestorePoint> RunRecord::restorePoint(uint64_t frame) const {
  const std::lock_guard lock(m->mutex);
  return m->restorePoint(frame);
}

RunContent RunRecord::content() const {
  const std::lock_guard lock(m->mutex);
  return {*m, m->earlier, m->runs, m->lending, m->begun};
}

std::vector<RunRecord::EarlierRun> RunRecord::earlier() const {
  const std::lock_guard lock(m->mutex);
  std::vector<EarlierRun> runs;
  for (const KeptRun& run : m->earlier)
    runs.push_back({run.number, run.name, run.apart, run.frames.rbegin()->second->stats.time});
  return runs;
}

std::vector<FrameStats> RunRecord::stats() const {
  const std::lock_guard lock(m->mutex);
  std::vector<FrameStats> stats;
  for (const auto& [number, frame] : m->frames) stats.push_back(frame->stats);
  return stats;
}

std::vector<FrameStats> RunRecord::stats(uint64_t run) const {
  const std::lock_guard lock(m->mutex);
  std::vector<FrameStats> stats;
  for (const KeptRun& kept : m->earlier) {
    if (kept.number != run) continue;
    for (const auto& [number, frame] : kept.frames) stats.push_back(frame->stats);
  }
  return stats;
}

/// Of a run whose first state is still being packed: as it was handed over.
RunEdits RunRecord::documentEdits(std::optional<uint64_t> run) const {
  const std::lock_guard lock(m->mutex);
  const KeptRun* of = m.get();
  for (const KeptRun& kept : m->earlier) {
    if (kept.number == run) of = &kept;
  }
  RunEdits out;
  size_t from = 0;
  if (!of->states.empty()) {
    out.document = of->states.front().document;
    from = of->states.front().edits;
  } else if (of == m.get()) {
    out.document = m->document;
    from = m->documentEdits;
  }
  for (size_t k = from; k < of->edits.size(); ++k) {
    if (changesDocument(of->edits[k].edit)) out.edits.push_back(of->edits[k]);
  }
  return out;
}

uint64_t RunRecord::present() const {
  const std::lock_guard lock(m->mutex);
  return m->number;
}

void RunRecord::rename(uint64_t number, const std::string& name) {
  const std::lock_guard lock(m->mutex);
  if (m->number == number) m->name = name;
  for (KeptRun& run : m->earlier) {
    if (run.number == number) run.name = name;
  }
}

void RunRecord::Impl::drop(std::vector<KeptRun>::iterator run) {
  dropped.push_back(std::move(*run));
  earlier.erase(run);
}

void RunRecord::forgetRun(uint64_t number) {
  {
    const std::lock_guard lock(m->mutex);
    const auto run =
        std::find_if(m->earlier.begin(), m->earlier.end(), [&](const KeptRun& kept) { return kept.number == number; });
    if (run == m->earlier.end()) return;
    m->drop(run);
  }
  m->wake.notify_one();
}

RunRecord::Cost RunRecord::cost() const {
  const std::lock_guard lock(m->mutex);
  return {m->bytes(), m->counted->disk, m->states.size(), m->leftOut, m->stateSeconds, m->packSeconds};
}

std::shared_ptr<const PackedBytes> packedState(std::span<const std::byte> stream, ByteCount count) {
  BytePacker packer;
  packer.planes(reinterpret_cast<const char*>(stream.data()), stream.size(), kStateWord);
  return std::make_shared<const PackedBytes>(packer.bytes(), std::move(count));
}

std::unique_ptr<Engine> replayed(const RestorePoint& point, PluginRegistry& plugins) {
  if (t_progress) t_progress->expect(1);
  beginStage("Going back", 1, static_cast<double>(point.frame - point.from));
  const std::vector<std::byte> state = unpackedState(*point.stream);
  auto engine = std::make_unique<Engine>(*point.document, plugins, StateReader(state));
  engine->setNames(*point.names);
  auto edit = point.edits.begin();
  const auto applyEdits = [&] {
    for (; edit != point.edits.end() && edit->frame <= engine->solver().frame(); ++edit) {
      if (const auto* together = std::get_if<std::vector<SetParameter>>(&edit->edit))
        engine->setParameters(*together);
      else
        engine->apply(std::get<Command>(edit->edit));
    }
  };
  applyEdits();
  while (engine->solver().frame() < point.frame) {
    const uint64_t before = engine->solver().frame();
    const StepReport report = engine->step();
    if (engine->solver().frame() == before) throw Error("frame " + std::to_string(before) + ": " + report.message);
    advance(1);
    applyEdits();
  }
  return engine;
}

}  // namespace ps
