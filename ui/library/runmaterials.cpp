// SPDX-License-Identifier: Apache-2.0
#include "ui/library/runmaterials.h"

#include "core/simulation/enginethread.h"
#include "core/simulation/runrecord.h"
#include "ui/document/document.h"
#include "ui/session/session.h"

#include <algorithm>

namespace ps {
namespace {

bool isMadeOf(const Project& project, const std::string& base) {
  return std::any_of(project.materials.begin(), project.materials.end(),
                     [&](const SceneMaterial& material) { return material.base == base; });
}

bool isMadeOf(const RunEdits& run, const std::string& base) {
  if (run.document && isMadeOf(*run.document, base)) return true;
  return std::any_of(run.edits.begin(), run.edits.end(), [&](const FrameEdit& each) {
    const auto* command = std::get_if<Command>(&each.edit);
    const auto* update = command ? std::get_if<UpdateProject>(command) : nullptr;
    return update && update->project && isMadeOf(*update->project, base);
  });
}

}  // namespace

bool runIsMadeOf(Session& session, const std::string& base) {
  if (isMadeOf(session.document().project(), base)) return true;
  if (!session.engine()) return false;
  const RunRecord& record = session.engine()->recording();
  if (isMadeOf(record.documentEdits(), base)) return true;
  const std::vector<RunRecord::EarlierRun> earlier = record.earlier();
  return std::any_of(earlier.begin(), earlier.end(), [&](const RunRecord::EarlierRun& run) {
    return isMadeOf(record.documentEdits(run.number), base);
  });
}

}  // namespace ps
