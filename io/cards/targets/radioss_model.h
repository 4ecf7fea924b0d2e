#pragma once

#include <string>

namespace viscard {

// One brick in simple tension for OpenRadioss, its lengths, times and forces in one unit system.
struct RadiossModel {
  std::string name;
  std::string units;           // MUNIT, LUNIT, TUNIT of /BEGIN, 20 columns each
  std::string card;            // the material with its own /UNIT
  std::string material = "1";  // its number
  std::string edge = "1.0";    // of the brick
  std::string curve;           // rows of /FUNCT: time, and displacement or force on each node
  bool is_creep = false;
  bool is_confined = false;  // no node may move sideways
  double damping = 0.0;      // alpha of /DAMP: a force alpha times mass times velocity; 0: none
};

std::string radioss_starter(const RadiossModel& model);

}  // namespace viscard
