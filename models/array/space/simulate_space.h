#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/space/space_scene.h"

#include <string>
#include <vector>

namespace viscard {

// Answers the scene as it stands, on accuracies of rising cost (space_accuracies()), until every value
// meets the tolerance. The maps, by pillar:
//   centre_voltage, mean_voltage  of a charge-free face: under the axis, over the electrode's disc
//   quadrant_1_voltage to _4_     means over the quarters (+,+), (-,+), (-,-), (+,-) of the disc
//   electrode_voltage             of open equipotential electrodes, instead of centre and mean; of quarters of metal
//                                 their mean, beside quadrant_1_voltage to _4_ of each
//   crosstalk_percent             mean or electrode voltage of an unloaded pillar over the largest of a
//                                 loaded one
// The results are the largest and the smallest value of each map ("mean_voltage_largest") and the values
// of single pillars ("mean_voltage_3_4": row 3, column 4): those that the scene wants by name, all of
// them where there are at most kMostNamedPillars. The error of each value is the change from accuracy
// to accuracy, plus what a foot on a rigid base leaves out and what the film's edge reflects (eq. S5,
// S7, S8). Throws std::runtime_error with the reason if the finest accuracy does not meet the tolerance.
SceneAnswer simulate_space(const SpaceScene& scene);

// The scene on the accuracy whose degree is that of this mesh, or the next higher one, without
// errors; and the list of meshes of the feet that simulate_space() goes through.
SceneAnswer space_answer_on(const SpaceScene& scene, const Discretisation& mesh);
std::vector<Discretisation> space_meshes(const SpaceScene& scene);

// Throws SceneMistake naming what is missing or contradictory.
void validate(const SpaceScene& scene);

// Heat and noise that the scene names, as results and curves of one of the usual pillars.
void check_heat_and_noise(const SpaceScene& scene);  // throws SceneMistake
void add_heat_and_noise(const SpaceScene& scene, SceneAnswer& answer);

// The maps that a scene may ask for.
std::vector<std::string> result_names(const SpaceScene& scene);

// Relative error of a voltage where the foot stands on a rigid base instead of the film (eq. S7).
double rigid_foot_error(const SpaceScene& scene);
// Error of each pillar's voltages because the film is solved without end, relative to the largest voltage of the
// loads: each acts by its share of the largest load and by its own way to the edge (eq. S8).
std::vector<double> film_edge_errors(const SpaceScene& scene, const TopLoads& loads_Pa);

// Changes of the voltages by a backing under the loads (eq. S12).
struct BackingEffect {
  double edge = 0.0;       // relative error, because the film is solved without end
  std::size_t pillar = 0;  // with the largest voltage
  double voltage_V = 0.0;  // its first reading, and on a rigid base
  double rigid_V = 0.0;
};
BackingEffect backing_effect(const SpaceScene& scene, const TopLoads& loads_Pa);
// Throws SceneMistake if the errors from the film's edge and the other relative errors exceed
// `most`.
void check_edge(const SpaceScene& scene, const BackingEffect& effect, double other_errors,
                double most);
// Remarks on a film that reads its stretching.
void add_stretching_note(const SpaceScene& scene, const BackingEffect& effect, SceneAnswer& answer);

// Relative error of the voltages of equipotential electrodes, if the charges that they induce on each other are
// left out: the sum of (p12/p11)^2 over the others (eq. S5). The same sum says what solving for them leaves.
double electrode_error(const SpaceScene& scene);

// Whether these charges are solved for (eq. S17), how far they are iterated, and the relative error of a voltage that is
// left, apart from what the accuracies show.
struct ElectrodeCoupling {
  bool is_on = false;
  double settled = 1.0;  // CouplingAccuracy
  double error = 0.0;
};
ElectrodeCoupling electrode_coupling(const SpaceScene& scene);

// Relative errors that do not depend on the accuracy level of the array: eq. S5, S7 and S8.
struct ConstantErrors {
  double foot = 0.0;        // of a voltage
  double electrodes = 0.0;  // of a voltage
  ElectrodeCoupling coupling;
  double neighbour = 0.0;     // share of a load's field at its nearest neighbour
  std::vector<double> edge;   // by pillar
  double largest_edge = 0.0;  // of them
};

// Errors from the film's edge follow from the loads: of a shape and of measured voltages, once these are found.
ConstantErrors constant_errors(const SpaceScene& scene);
void set_edge_errors(const SpaceScene& scene, const TopLoads& loads_Pa, ConstantErrors& errors);
// The part of a map's error, in its unit, that is common to all pillars; and the reference value of the
// error at the film's edge.
double common_error_of(const SceneMap& map, const ConstantErrors& errors);
double edge_size_of(const SceneMap& map);
// The largest of these errors, relative to the reference value of the tolerance; and its refusal.
double largest_constant_error(const SpaceScene& scene, const ConstantErrors& errors);
[[noreturn]] void refuse_constant(const SpaceScene& scene, double error,
                                  const ConstantErrors& parts);

// Upper bound of the relative change of a voltage by a neighbour, or by an end of the film, at a
// distance x in units of the film's thickness (eq. A4, models/array/plane).
double neighbour_influence(double x, double thickness_over_diameter);

}  // namespace viscard
