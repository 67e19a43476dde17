// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"

#include <QtCore/QObject>

#include <set>
#include <string>

namespace ps {

class Notices;
class Session;

/// Tells when an edit makes a body begin as solid grains that nothing holds together, as water does that is set to
/// −10 °C, and offers what holds them. Who wants sand closes it; bodies that come or are opened so are not told.
class LooseMatter : public QObject {
  Q_OBJECT
 public:
  LooseMatter(Session& session, Notices& notices, QObject* parent = nullptr);

 private:
  void onChanged(const ChangeEvent& event);
  void look(const std::string& id);
  bool isLoose(const Body& body) const;
  void tell(const Body& body);

  Session& m_session;
  Notices& m_notices;
  std::set<std::string> m_known;  ///< bodies, by id
  std::set<std::string> m_loose;  ///< those of them that are so
};

}  // namespace ps
