// SPDX-License-Identifier: Apache-2.0
// How an engine goes by the tracks of its project. Why it does so after each frame and not before: what a state holds
// is then a matter of the document and of the time alone, so that one who goes on from it does as one who never
// stopped.
#include "core/base/error.h"
#include "core/simulation/compile.h"
#include "core/simulation/engineimpl.h"

namespace ps {

double Engine::Impl::slack() const { return keySlack(numberOf(project.solver.parameters, solverParameters(), "dt")); }

void Engine::Impl::bindTracks(double time) {
  if (overlay.empty() && project.tracks.empty()) return;
  Touched dropped;
  overlay.lift(project);
  bindOverlay(dropped);
  overlay.lay(project);
  recompile(dropped);
  followTracks(time);
}

void Engine::Impl::bindOverlay(Touched& dropped) {
  overlay.bind(
      project, plugins, [this](const std::string& body) { return isFixed(body); }, dropped);
}

void Engine::Impl::followTracks(double time) {
  const double within = slack();
  if (!overlay.moves(project, time, within)) return;
  Touched touched;
  overlay.lift(project);
  const TrackOverlay before = overlay;
  overlay.advance(project, time, within, touched);
  overlay.lay(project);
  try {
    recompile(touched);
  } catch (const Error&) {
    overlay.lift(project);
    overlay = before;
    overlay.lay(project);
    recompile(touched);
    followEach(time);
  }
  if (touched.owners.contains(Owner::Body)) holdBodies();
  if (touched.owners.contains(Owner::Emitter)) flow.steer(*solver, project, compileSettings(project).dt);
}

void Engine::Impl::followEach(double time) {
  const double within = slack();
  for (size_t track = 0; track < overlay.size(); ++track) {
    Touched touched;
    overlay.lift(project);
    const TrackOverlay before = overlay;
    overlay.advance(project, track, time, within, touched);
    overlay.lay(project);
    try {
      recompile(touched);
    } catch (const Error& problem) {
      overlay.lift(project);
      overlay = before;
      overlay.refuse(project, track, time, within, problem.what());
      overlay.lay(project);
      recompile(touched);
    }
  }
}

void Engine::Impl::changeBeneath(const std::function<void(Touched&)>& change, const std::function<void()>& takeBack) {
  Touched touched;
  overlay.lift(project);
  const TrackOverlay before = overlay;
  try {
    change(touched);
    bindOverlay(touched);
    overlay.lay(project);
    recompile(touched);
  } catch (...) {
    overlay.lift(project);
    takeBack();
    overlay = before;
    overlay.lay(project);
    recompile(touched);
    throw;
  }
  followTracks(solver->time());
  if (touched.owners.contains(Owner::Body)) holdBodies();
}

void Engine::setTracks(const std::vector<Track>& tracks) {
  const std::vector<Track> before = m->project.tracks;
  m->changeBeneath([&](Touched&) { m->project.tracks = tracks; }, [&] { m->project.tracks = before; });
}

}  // namespace ps
