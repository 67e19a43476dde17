// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/constraint.h>

#include <vector>

namespace ps::constraint {

/// Who takes a particle back when it has frozen.
enum class Keeper : uint8_t {
  None,   ///< its body has no structure that does: whoever is nearest
  Bonds,  ///< it was made with bonds
  Rigid,  ///< it was made as part of a rigid body
  Guest,  ///< of nobody, it has frozen onto a rigid body; until it melts
};

/// Fields that structure which takes back frozen matter shares: traits().fields of such plugins.
inline constexpr const char* kFreshField = "joining.fresh";
inline constexpr const char* kKeeperField = "joining.keeper";
inline constexpr api::FieldDeclaration kJoiningFields[] = {
    {kFreshField, "", "1 while the particle has been fluid since its last tie, 2 when a rigid body alone has taken it",
     api::FieldType::UInt8},
    {kKeeperField, "", "Who takes it back when it freezes: 0 anyone, 1 bonds, 2 rigid, 3 a rigid body has taken it",
     api::FieldType::UInt8},
};

/// The rule by which solid matter becomes one piece, for all structure. Freezing: one of the two was fluid since its
/// last tie, both are frozen by their material's `freeze_bond_fraction`, and they are of one material or one of the two
/// names the other's in its `adheres_to`. Sintering: both are dry, of one material that `sinters` (ice: Faraday 1860),
/// below its melting point, and touch. Nothing else joins: a cooling iron ball is not welded to its table, neither is
/// tin that sets on iron. What a hand has cut apart joins at the cut only where one of the two has been fluid since.
/// It cannot do: strength that grows with time and pressure, as real sintering does.
class Joining {
 public:
  Joining(const api::ConstraintContext& context, const api::ParticleView& particles);

  /// Notes who is fluid now. Once a frame, before anything joins; again by another plugin does no harm.
  void noteFluid(const api::Threads* threads) const;
  /// Whether there is anybody whom the rule might join.
  bool anybody(const api::Threads* threads) const;

  bool frozen(uint32_t i) const { return m_p.solidFraction[i] >= ruleOf(i).freezeFraction; }
  bool fresh(uint32_t i) const { return m_fresh[i] != 0; }
  bool dryJoiner(uint32_t i) const {
    return ruleOf(i).sinters && m_p.temperature[i] < ruleOf(i).solidus && m_fresh[i] == 0 && !cut(i);
  }
  bool mayFreeze(uint32_t i, uint32_t j) const {
    return (fresh(i) || fresh(j)) && !(cut(i) && cut(j)) && akin(m_p.material[i], m_p.material[j]) && frozen(i) &&
           frozen(j);
  }
  bool maySinter(uint32_t i, uint32_t j) const {
    return m_p.material[i] == m_p.material[j] && dryJoiner(i) && dryJoiner(j) && frozen(i) && frozen(j);
  }
  /// How far a freezing particle reaches, in m.
  float reach(uint32_t i) const { return ruleOf(i).reach; }

  uint8_t& freshness(uint32_t i) const { return m_fresh[i]; }
  Keeper keeper(uint32_t i) const { return static_cast<Keeper>(m_keeper[i]); }
  void setKeeper(uint32_t i, Keeper keeper) const { m_keeper[i] = static_cast<uint8_t>(keeper); }
  bool isRigid(uint32_t i) const { return keeper(i) == Keeper::Rigid || keeper(i) == Keeper::Guest; }

 private:
  struct Rule {
    float freezeFraction, reach;
    double solidus;
    bool sinters;
  };
  const Rule& ruleOf(uint32_t i) const { return m_rules[m_p.material[i]]; }
  bool cut(uint32_t i) const { return m_cuts && m_cuts->at(i); }
  bool akin(uint32_t a, uint32_t b) const { return a == b || m_adhesion[a * m_rules.size() + b] != 0; }

  const api::ParticleView& m_p;
  const api::CutView* m_cuts;
  std::vector<Rule> m_rules;
  std::vector<uint8_t> m_adhesion;  ///< of materials, two by two
  uint8_t *m_fresh, *m_keeper;
};

}  // namespace ps::constraint
