// SPDX-License-Identifier: Apache-2.0
// A mixture of two materials, fine enough to be one: an alloy, a solution, a blend. Each property follows from those of
// its parts by a rule of the textbooks, none of which knows how the two act on each other. Not modelled: eutectics,
// compounds, parts that separate, azeotropes, grains or drops of one in the other.
#pragma once
#include "core/matter/material.h"

#include <string>
#include <string_view>

namespace ps {

/// How a property of a mixture follows from those of the parts, in a few words with the source; "" for an unknown key.
std::string_view mixtureRule(std::string_view key);

/// The mixture of which `share` (0 to 1, by mass) is the second part, without id and label. At 0 and 1 it has exactly
/// the properties of the part that is left. Mass, volume at 20 °C, and the heat from all solid to all liquid and from
/// all liquid to all vapour are the sums of the parts': latent heats are carried to the mixture's temperatures by
/// Kirchhoff's law. What both leave out stays out; where one does, the catalogue's default stands in. Where a part's
/// property is a curve or law the mixture's is a curve, within 2 % of the rule between its points where it is smooth.
/// Its provenance says the rules.
Material mixed(const Material& first, const Material& second, double share);

/// "" or why two materials make no mixture of this share, as a sentence: one never melts and is no liquid either, one
/// sublimes, one boils before the other melts, or what comes of them is no material (see problemOf()).
std::string whyNoMixture(const Material& first, const Material& second, double share);

}  // namespace ps
