// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"

#include <QtCore/QString>

#include <map>
#include <string>
#include <vector>

namespace ps {

class Document;
class ParameterPanel;
struct EngineEvent;

/// The notes under rows: what is chosen and not installed, what a value should be and is not, what the solver cannot
/// reach, what waits for the next reset.
class RowNotes {
 public:
  RowNotes(const Document& document, std::vector<ParameterPanel*> panels);

  void clear();  ///< another project
  /// Whether the scene is made anew by itself, so that no value waits for a reset. Rows are told by what comes next.
  void setNothingWaits(bool nothing) { m_nothingWaits = nothing; }
  void setSnapshot(const Snapshot& snapshot);
  /// By Snapshot::revision: what was set in another run waits no longer. Rows are told by what comes next.
  void setRun(uint64_t revision);
  void onChanged(const ParameterChanged& change);
  /// What keeps the scene from being made stands under its row until there is a scene.
  void hear(const EngineEvent& event);
  /// Says all of them anew: substeps change what is reached, and rows may have been made anew.
  void show();

  /// Target of the link that resets the scene; other links are "ADDRESS=VALUE".
  static constexpr const char* kReset = "reset";

 private:
  struct Note {
    QString text;
    double delivered;
  };
  void addMissing(std::map<QString, Note>& notes) const;
  void addAdvice(std::map<QString, Note>& notes) const;
  void addLimits(std::map<QString, Note>& notes) const;
  void addWaiting(std::map<QString, Note>& notes) const;
  void addStarts(std::map<QString, Note>& notes) const;
  void noteWaiting(const ParameterChanged& change);
  QString linkOf(const std::string& use) const;
  QString costOf(const std::string& address) const;

  const Document& m_document;
  std::vector<ParameterPanel*> m_panels;
  std::vector<Limit> m_limits;  ///< of the last snapshot: a paused scene publishes none when rows are made anew
  std::shared_ptr<const std::vector<std::string>> m_bodies;
  uint64_t m_revision = 0;
  size_t m_particles = 0;    ///< that there are now
  bool m_knowsStart = true;  ///< see Snapshot::knowsStart
  bool m_nothingWaits = false;
  std::map<std::string, Value> m_made;  ///< by address: with what the present matter was made, where that has changed
  std::map<QString, Note> m_shown;
  QString m_culprit, m_problem;  ///< key of the row, and the sentence under it
};

}  // namespace ps
