// SPDX-License-Identifier: Apache-2.0
#include "ui/window/loosematter.h"

#include "core/scene/shownname.h"
#include "core/simulation/declared.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"

#include <variant>

namespace ps {
namespace {

constexpr const char* kTopic = "loose";

QString topicOf(const std::string& id) { return QLatin1String(kTopic) + QLatin1Char('/') + QString::fromStdString(id); }

}  // namespace

LooseMatter::LooseMatter(Session& session, Notices& notices, QObject* parent)
    : QObject(parent), m_session(session), m_notices(notices) {
  connect(&session.document(), &Document::changed, this, &LooseMatter::onChanged);
  connect(&session, &Session::ready, this, [this] { onChanged(ProjectOpened()); });
}

void LooseMatter::onChanged(const ChangeEvent& event) {
  const auto* parameter = std::get_if<ParameterChanged>(&event);
  const auto* body = std::get_if<BodyChanged>(&event);
  if (parameter && parameter->address.owner == Owner::Body) return look(parameter->address.id);
  if (body) return look(body->id);
  if (!std::holds_alternative<ProjectOpened>(event)) return;
  for (const std::string& id : m_loose) m_notices.bar().close(topicOf(id));
  m_known.clear();
  m_loose.clear();
  for (const Body& one : m_session.document().project().bodies) look(one.id);
}

void LooseMatter::look(const std::string& id) {
  const Body* body = m_session.document().body(id);
  const bool known = m_known.contains(id), loose = body && isLoose(*body);
  if (!loose && m_loose.erase(id) > 0) m_notices.bar().close(topicOf(id));
  if (loose && m_loose.insert(id).second && known) tell(*body);
  if (body)
    m_known.insert(id);
  else
    m_known.erase(id);
}

bool LooseMatter::isLoose(const Body& body) const {
  const Document& document = m_session.document();
  const api::ParameterList list = bodyParameters();
  if (std::holds_alternative<VoxelShape>(body.shape)) return false;  // its strokes have temperatures of their own
  if (!m_session.isReady() || !body.constraints.empty() || toggleOf(body.parameters, list, "fixed")) return false;
  const std::string phase = choiceOf(body.parameters, list, "phase");
  if (phase != "automatic") return phase == "solid";
  const Value melts =
      valueAt(document.project(), document.plugins(), {Owner::Material, body.material, "melting_temperature"});
  const auto* melting = std::get_if<double>(&melts);
  return melting && numberOf(body.parameters, list, "temperature") < *melting;
}

void LooseMatter::tell(const Body& body) {
  const std::string structure = frozenStructure(*m_session.document().plugins());
  if (structure.empty()) return;
  m_notices.bar().show(topicOf(body.id), MessageLevel::Info,
                       QStringLiteral("“%1” begins as loose grains.").arg(QString::fromStdString(shownName(body))),
                       QStringLiteral("It is solid at its start, and nothing holds it together: it falls apart like "
                                      "sand once back at the start."),
                       {{QStringLiteral("Hold it together"),
                         [this, id = body.id, structure] { m_session.document().setStructure(id, structure); }}});
}

}  // namespace ps
