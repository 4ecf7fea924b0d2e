// OpenRadioss is explicit: the speed of sound sets its step, and a brick at rest oscillates after
// every change of the load. What keeps the test quasi-static (equations of motion of a cube of edge L
// in uniform strain, a quarter of its mass on each edge in z: mass rho L^3/2 on each moving face):
//   - slowest mode, at constant volume:  omega = 2 sqrt(G/rho)/L
//   - mass damping alpha = 2 omega, critical for it (engine/source/assembly/damping.F): after the start
//     of a block its transient decays as exp(-omega t)
//   - the edge follows from omega (ramp) = 1.5 increments. The lag of the answer, 2/omega, is then of
//     first order in the step, as the errors of the integration are, and the extrapolation removes it.
//   - fastest mode, a change of volume with three free directions: omega^2 = 12 K/(rho L^2). Central
//     differences need omega dt < 2: dt < L/(sqrt(3) c), so the factor of /DT is 0.5, not 0.9.
// The material's own speed of sound is c^2 = (K + 8 G/3)/rho (sigeps40.F: (K + 4 GT/3)/rho, where GT is
// twice the shear modulus).
//
// th_to_csv prints "%f", six decimals, of single precision (th_to_csv.c, csvFileWrite; wrtdes.F), so
// the model has units of its own: the ramp lasts 100 of time, the edge is 1e6 of length, the load of
// the ramp is a stress of 1000. /BEGIN takes numbers in kg, m and s (unit_code.F); the card keeps
// its own /UNIT.
//
// Sources in github.com/OpenRadioss/OpenRadioss, with the commit that was read: HOWTO.md 7a3d439 (double
// precision unless built with -prec=sp); tools/th_to_csv/linux64/build.bash 14f5165; INSTALL.md 019a672
// (RAD_CFG_PATH, OMP_STACKSIZE, LD_LIBRARY_PATH); execargcheck.F 1a91e5b (PREXECINFO); unit_code.F and
// hm_read_mat40.F 0368758 (a branch of LAW40 with rate 0 gets 1e-20; nu below 0 or from 0.5 on is an
// error); hm_read_unit.F 03eedb8; sigeps40.F 18cf844 (the rate of strain is linear in each cycle with the
// right mean); fixvel.F 098a79f (/IMPDISP sets the velocity that reaches the curve at the end of the
// cycle); radioss110/LOADS/impdisp.cfg 1e2f25a; damping.F 14c5981, DAMPING51 (mean velocity of the cycle);
// hist2.F 0629536 (a row at the first cycle at or after each output time); wrtdes.F 1b68cc9; th_to_csv.c
// 15df45f. Known from decks and scripts of users only: the columns of /DAMP, the name deckT01, "ERROR
// TERMINATION" and "ENERGY ERROR LIMIT REACHED".
#include "io/basics/atomic_file.h"
#include "io/basics/patterns.h"
#include "io/cards/card.h"
#include "io/cards/column_fields.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/targets/radioss_model.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kRampLength = 100.0, kEdge = 1e6, kStress = 1000.0;  // in the units of the model
constexpr double kTurns = 1.5;  // omega times the ramp, for each increment of the ramp
constexpr double kOutputsPerRamp = 16.0;
constexpr double kMostOutputs = 4e5;  // rows of 150 bytes
constexpr double kMostCycles = 2e7;   // of one run; 10 minutes at 30 us each
constexpr double kStepFactor = 0.5;   // of /DT

// The shear modulus of the slowest mode. A liquid has none in the end; its mode is then damped more.
double slow_shear_Pa(const Material& material) {
  const DerivedModuli moduli = derived_moduli(material);
  return std::max(moduli.G_inf_Pa, 0.01 * moduli.G0_Pa);
}

double turns_of_ramp(const ElementTest& test) {
  return kTurns * test.blocks.front().increments;
}

double density_of(const SolverTask& task) {
  const double density = task.input.card.written.rho_kg_m3 > 0.0 ? task.input.card.written.rho_kg_m3
                                                                 : task.as_read.rho_kg_m3;
  if (!(density > 0.0)) {
    throw std::runtime_error("the card states no density, and OpenRadioss needs one");
  }
  return density;
}

std::string unit_factors(const SolverTask& task) {
  const ElementTest& test = task.input.test;
  const Material& material = task.input.card.written;
  const double speed_m_s = std::sqrt(slow_shear_Pa(material) / density_of(task));
  const double edge_m = 2.0 * speed_m_s * test.ramp_s / turns_of_ramp(test);
  const double time_s = test.ramp_s / kRampLength, length_m = edge_m / kEdge;
  const double stress_Pa = test.amplitude * material.E0_Pa / kStress;
  const double mass_kg = stress_Pa * length_m * time_s * time_s;
  return real(mass_kg, 20) + real(length_m, 20) + real(time_s, 20) + "\n";
}

double in_model(double time_s, const ElementTest& test) {
  return time_s / test.ramp_s * kRampLength;
}

// The load by blocks. After the end it goes on as in the last block, so that nothing changes there.
ElementTest continued(ElementTest test) {
  const std::size_t last = test.blocks.size() - 1;
  const TimeBlock before = last > 0 ? test.blocks[last - 1] : TimeBlock{0.0, 0, 0.0};
  TimeBlock& block = test.blocks[last];
  const double slope = (block.load - before.load) / (block.end_s - before.end_s);
  block.load += slope * block.end_s;
  block.end_s *= 2.0;
  return test;
}

std::string load_rows(const DeckInput& input) {
  const ElementTest& test = input.test;
  const double top = input.is_creep() ? 0.25 * kStress * kEdge * kEdge : test.amplitude * kEdge;
  std::string out = real(0.0, 20) + real(0.0, 20) + "\n";
  for (const TimeBlock& block : continued(test).blocks) {
    out += real(in_model(block.end_s, test), 20) + real(top * block.load, 20) + "\n";
  }
  return out;
}

double output_step(const ElementTest& test) {
  return std::max(kRampLength / kOutputsPerRamp, in_model(test.end_s(), test) / kMostOutputs);
}

// The number of the material, whose row must name its units.
std::string material_number(const std::string& card) {
  const auto match =
      first_match(card, "(^|\\n) */[Mm][Aa][Tt]/(LAW40|KELVINMAX|law40|kelvinmax)/(\\d+)/(\\d+)");
  if (!match) {
    throw std::runtime_error(
        "the card's material names no units (/MAT/LAW40/1/1 after /UNIT/1): the model for "
        "OpenRadioss has units of its own, because its time history has six decimals; add them");
  }
  return match->group[3];
}

// Rows of time and value, until one is not a number.
std::vector<SolverSample> history_of(const std::string& table, const std::string& group) {
  std::istringstream stream(table);
  std::string line;
  std::getline(stream, line);
  std::vector<std::string> names;
  for (const Match& name : all_matches(line, "\"([^\"]*)\"")) names.push_back(name.group[1]);
  const auto named = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return name.compare(0, group.size() + 1, group + " ") == 0;
  });
  const auto column = static_cast<std::size_t>(named - names.begin());
  std::vector<SolverSample> rows;
  while (named != names.end() && std::getline(stream, line)) {
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      row.push_back(leading_number(cell));
    }
    if (row.size() <= column || !std::isfinite(row[column])) break;
    rows.push_back({row[0], row[column]});
  }
  return rows;
}

// Where transients of the last change of the load have decayed: the second half of a block, without
// its end, where the next one begins.
std::vector<double> compared_times(const ElementTest& test) {
  std::vector<double> out;
  for (std::size_t i = 1; i < test.blocks.size(); ++i) {
    const double from_s = test.blocks[i - 1].end_s, length_s = test.blocks[i].end_s - from_s;
    out.push_back(from_s + 0.5 * length_s);
    out.push_back(from_s + 0.75 * length_s);
  }
  out.push_back(test.end_s());
  return out;
}

std::vector<SolverSample>::const_iterator first_after(double time,
                                                      const std::vector<SolverSample>& rows) {
  return std::find_if(rows.begin(), rows.end(),
                      [&](const SolverSample& row) { return row.time_s > time; });
}

// The polynomial through all rows (Lagrange).
double interpolated(double time, const std::vector<SolverSample>& rows) {
  double sum = 0.0;
  for (const SolverSample& row : rows) {
    double weight = 1.0;
    for (const SolverSample& other : rows) {
      if (&other == &row) continue;
      weight *= (time - other.time_s) / (row.time_s - other.time_s);
    }
    sum += weight * row.value;
  }
  return sum;
}

}  // namespace

ElementTestOptions openradioss_test() {
  return {.amplitude = 1e-5, .steps_per_tau = 40, .rises = true};
}

// The finest of the three runs takes (ramps) * 4 * (turns of the ramp) * c/sqrt(G/rho) cycles.
double openradioss_most_ramps(const Material& material) {
  const DerivedModuli moduli = derived_moduli(material);
  const double sound =
      std::sqrt((moduli.K0_Pa + 8.0 / 3.0 * moduli.G0_Pa) / slow_shear_Pa(material));
  const double increments = 0.5 * openradioss_test().steps_per_tau;
  return kMostCycles * 2.0 * kStepFactor / (4.0 * kTurns * increments * sound);
}

std::vector<DeckFile> openradioss_model(const std::vector<SolverTask>& tasks) {
  const SolverTask& task = tasks.front();
  const ElementTest& test = task.input.test;
  const RadiossModel model{.name = "deck",
                           .units = unit_factors(task),
                           .card = task.input.card.text,
                           .material = material_number(task.input.card.text),
                           .edge = real(kEdge, 20),
                           .curve = load_rows(task.input),
                           .is_creep = task.input.is_creep(),
                           .is_confined = task.input.is_confined(),
                           .damping = 2.0 * turns_of_ramp(test) / kRampLength};
  const double step = output_step(test), end = in_model(test.end_s(), test) + 4.0 * step;
  // Without /TH/TITLE th_to_csv reads memory that it never set (isImpulse in csvFileWrite).
  return {{"deck_0000.rad", radioss_starter(model)},
          {"deck_0001.rad", "#RADIOSS ENGINE\n/RUN/deck/1\n" + real(end, 20) +
                                "\n/VERS/2022\n/DT\n" + real(kStepFactor, 20) + real(0.0, 20) +
                                "\n/TFILE\n" + real(step, 20) + "\n/TH/TITLE\n/PRINT/-100000\n"}};
}

// The engine prints at the first cycle after each output time, so the value at the compared time is
// interpolated, as a ratio to the exact answer, which hardly changes from row to row.
std::vector<SolverSample> openradioss_samples(const std::filesystem::path& folder,
                                              const DeckInput& input, std::size_t) {
  const std::filesystem::path path = folder / "deckT01.csv";
  if (!std::filesystem::exists(path)) return {};
  const ElementTest& test = input.test;
  std::vector<SolverSample> rows =
      history_of(read_own_file(path), input.is_creep() ? "length" : "stress");
  rows.erase(rows.begin(), first_after(0.0, rows));  // before the first load
  const double load = input.is_creep() ? test.amplitude * kEdge : kStress;
  const double unit = input.is_creep() ? test.amplitude : input.stress();
  const ElementTest longer = continued(test);
  const auto exact = [&](double time_s) {
    return exact_response(input.card.written, longer, time_s);
  };
  std::vector<SolverSample> samples;
  for (const double time_s : compared_times(test)) {
    const double time = in_model(time_s, test);
    const auto after = first_after(time, rows);
    if (after - rows.begin() < 2 || rows.end() - after < 2) break;
    std::vector<SolverSample> near(after - 2, after + 2);
    for (SolverSample& row : near) {
      row.value /= load * exact(row.time_s / kRampLength * test.ramp_s);
    }
    samples.push_back({input.time(time_s), interpolated(time, near) * exact(time_s) * unit});
  }
  return samples;
}

}  // namespace viscard
