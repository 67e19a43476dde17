// SPDX-License-Identifier: Apache-2.0
// What heat carries from one frame to the next: the books, the energy that was reported last, the surfaces that were
// measured some frames ago, and what the model did with its pairs. All else is made anew every frame.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/solver/heat/heat.h"

#include <algorithm>

namespace ps {
namespace {
constexpr uint8_t kPutAside = 1, kPairLaw = 2;
constexpr const char* kSourcesAside = "heat/sources_put_aside";
constexpr const char* kCurves = "heat/curves";  ///< of the materials up to the last that particles are of

size_t materialsIn(const ParticleStore& store) {
  const uint32_t *first = store.material(), *last = first + store.size();
  return first == last ? 0 : size_t{*std::max_element(first, last)} + 1;
}
}  // namespace

template <class Ledger, class Visit>
void HeatStage::eachOf(Ledger& ledger, Visit&& visit) {
  visit(ledger.walls), visit(ledger.air), visit(ledger.radiation), visit(ledger.heaters);
  visit(ledger.sources), visit(ledger.exchanged), visit(ledger.airWarming);
}

void HeatStage::save(StateWriter& writer, const ParticleStore& store) const {
  constexpr size_t kAccounts = 7;
  writer.open("heat/ledger", StateType::Float64, kAccounts);
  eachOf(m_ledger, [&](const double& account) { writer.put(account); });
  writer.close();
  const double numbers[] = {m_delivered, m_pairRate, m_lastEnergy, m_time, m_thermalTime};
  writer.array("heat/numbers", std::span<const double>(numbers));
  writer.value("heat/counted", uint64_t{m_lastCount});
  writer.value("heat/marks", static_cast<uint8_t>((m_putAside ? kPutAside : 0) | (m_pairLaw ? kPairLaw : 0)));
  writer.texts(kSourcesAside, m_sources.aside());
  // Without a model nothing has been counted by any.
  const size_t curves = works() ? std::min(m_curves.size(), materialsIn(store)) : 0;
  writer.open(kCurves, StateType::Float64, curves * EnthalpyCurves::kNumbers);
  for (size_t k = 0; k < curves; ++k) writer.put(m_curves[k].number);
  writer.close();
  m_surroundings.surface().save(writer, store);
}

void HeatStage::restoreCurves(const StateReader& reader) {
  noteCurves();
  StateRuns<double> numbers(reader, kCurves);
  const size_t count = std::min(m_curves.size(), reader.count(kCurves) / EnthalpyCurves::kNumbers);
  for (size_t k = 0; k < count; ++k) {
    const std::span<const double> run = numbers.next(EnthalpyCurves::kNumbers);
    std::copy(run.begin(), run.end(), m_curves[k].number.begin());
  }
  numbers.done();
}

void HeatStage::restore(const StateReader& reader, ParticleStore& store) {
  StateRuns<double> accounts(reader, "heat/ledger");
  eachOf(m_ledger, [&](double& account) { account = accounts.next(1)[0]; });
  accounts.done();
  const std::vector<double> numbers = reader.array<double>("heat/numbers", 5, 1);
  m_delivered = numbers[0], m_pairRate = numbers[1], m_lastEnergy = numbers[2];
  setClock(numbers[3], numbers[4]);
  m_lastCount = static_cast<size_t>(reader.value<uint64_t>("heat/counted"));
  const auto marks = reader.value<uint8_t>("heat/marks");
  m_putAside = m_putAside || (marks & kPutAside) != 0;
  m_pairLaw = (marks & kPairLaw) != 0;
  m_sources.putAside(reader.texts(kSourcesAside));
  m_surroundings.surface().restore(reader, store);
  restoreCurves(reader);
  if (!works() || store.size() == 0) return;
  const auto fields = m_model->fields();
  for (size_t k = 0; k < fields.count; ++k) {
    const api::FieldDeclaration f = fields.at(k);
    if (!store.read(f.name, f.type))
      throw InputError("the state has no field '" + std::string(f.name) + "', which the thermal model needs");
  }
  if (!isUpToDate()) derive(store);
}

}  // namespace ps
