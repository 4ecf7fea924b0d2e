#pragma once

#include "io/cards/card_target.h"

#include <string>
#include <vector>

namespace viscard {

// The table of targets, in the order of --list.
const std::vector<CardTarget>& card_targets();

// Throws std::invalid_argument listing the targets.
const CardTarget& card_target(const std::string& name);

// The target that the header of a card by viscard names, or null.
const CardTarget* stated_card_target(const std::string& text);

// The one-element model of a target. Throws std::invalid_argument listing the targets with one.
const DeckWriter& card_deck(const std::string& name);

// The targets with cards of laws of rubber, by name.
const std::vector<const CardTarget*>& law_targets();
// Throws std::invalid_argument naming those that there are.
const CardTarget& law_target(const std::string& name);

// The rows of the table, each defined in the file of its solver.
CardTarget abaqus_target();
CardTarget ansys_target();
CardTarget lsdyna_target();
CardTarget lsdyna006_target();
CardTarget febio_target();
CardTarget febio_uncoupled_target();
CardTarget mfront_target();
CardTarget calculix_target();
CardTarget openradioss_target();
CardTarget comsol_target();
CardTarget moose_target();
CardTarget frontistr_target();
CardTarget json_target();
CardTarget csv_target();
CardTarget abaqus_frequency_target();
CardTarget abaqus_table_target();
CardTarget ansys_table_target();
CardTarget comsol_table_target();
CardTarget comsol_branches_target();
CardTarget rayleigh_target();
CardTarget sofa_target();
CardTarget mujoco_target();
CardTarget physx_target();
CardTarget dolfinx_target();
CardTarget sfepy_target();

}  // namespace viscard
