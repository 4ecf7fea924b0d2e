#include "tests/io/report/synthetic_report.h"

#include "models/experiment/motion_profile.h"
#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace viscard::test {
namespace {

constexpr double kNoise_N = 4.9e-4;
constexpr double kContact_m = 1e-3;
constexpr double kRampStart_s = 14.0;
constexpr double kRamp_s = 1.0;
constexpr double kHold_s = 60.0;
constexpr double kRecovery_s = 20.0;
constexpr double kRate_Hz = 80.0;
constexpr double kTravel_m = 0.31e-3;

struct Mix {
  const char* id;
  double ratio, E0_Pa, g1, g2, tau1_s, tau2_s;
};
constexpr Mix kMixes[] = {{"PDMS 1:10", 10, 1.88e6, .008206, .01386, .1945, 2.403},
                          {"PDMS 1:13", 13, 1.65e6, .01251, .01355, .1588, 1.686},
                          {"PDMS 1:20", 20, 1.45e6, .01219, .01913, .2247, 2.581}};

Interval around(double value, double se) {
  return {value - 1.96 * se, value + 1.96 * se};
}
Interval around_log(double value, double se) {
  return {value * std::exp(-1.96 * se), value * std::exp(1.96 * se)};
}

Material material_of(const Mix& mix) {
  Material material;
  material.name = mix.id;
  material.E0_Pa = mix.E0_Pa;
  material.nu = 0.495;
  material.rho_kg_m3 = 965.0;
  material.terms = {{mix.g1, mix.g1, mix.tau1_s}, {mix.g2, mix.g2, mix.tau2_s}};
  return material;
}

std::vector<StageMove> moves_of_run() {
  StageMove ramp{kRampStart_s, 0.98e-3, kContact_m + kTravel_m, kTravel_m / kRamp_s, 0.2};
  StageMove unload{kRampStart_s + kRamp_s + kHold_s, ramp.to_m, kContact_m + 0.1 * kTravel_m, 4e-3,
                   0.2};
  StageMove retract{unload.start_time_s + kRecovery_s, unload.to_m, 0.5e-3, 1e-3, 0.2};
  return {ramp, unload, retract};
}

// Frame and specimen in series: the force follows the stage's way below contact.
double force_after(HereditaryStress& stress, double contact_m, double frame_N_m, double dt_s,
                   double way_m) {
  if (way_m <= 0.0) {
    stress.advance(dt_s, 0.0);
    return 0.0;
  }
  const double stiffness = contact_m * stress.algorithmic_modulus_Pa(dt_s);
  const double carried_N = contact_m * stress.carried_Pa(dt_s);
  const double force_N = (stiffness * way_m + carried_N) / (1.0 + stiffness / frame_N_m);
  stress.advance(dt_s, way_m - force_N / frame_N_m);
  return force_N;
}

CapturedRun run_of(const Mix& mix, const Specimen& specimen, std::mt19937_64& random) {
  CapturedRun run;
  run.specimen = specimen;
  run.status = "finished";
  run.program = "viscard 0.1.0";
  run.command = "viscard capture --emulate --out run.viscap";
  run.started_at = "2026-01-05T10:00:00Z";
  run.rig.name = "emulated rig";
  run.rig.calibration.volts_per_newton = 0.7255;
  run.rig.calibration.capacity_N = 2.4517;
  run.rig.load_cell.volts_per_count = 1e-6;
  run.rig.frame = {10e3, 0.02};
  for (const StageMove& move : moves_of_run()) run.moves.push_back({move, 0.05, "move"});
  run.events = {{0.0, "phase", "baseline", ""},  {kRampStart_s, "phase", "ramp", ""},
                {15.0, "phase", "hold", ""},     {75.0, "phase", "unload", ""},
                {75.1, "phase", "recovery", ""}, {95.0, "phase", "retract", ""}};
  std::normal_distribution<double> noise_N(0.0, kNoise_N);
  HereditaryStress stress(young_series(material_of(mix)));
  const double c_m = force_per_modulus_and_depth_m(specimen.contact);
  const std::vector<StageMove> moves = moves_of_run();
  for (int i = 0; i < static_cast<int>(105.0 * kRate_Hz); ++i) {
    const double time_s = i / kRate_Hz;
    const double way_m = position_m(moves, time_s) - kContact_m;
    const double force_N =
        force_after(stress, c_m, run.rig.frame.stiffness_N_m, 1.0 / kRate_Hz, way_m);
    LoadSample sample;
    sample.index = i;
    sample.host_time_s = time_s;
    sample.counts = 0.7255 * (force_N + 0.02 + noise_N(random)) / 1e-6;
    sample.is_glitch = i == 3000;
    if (sample.is_glitch) sample.counts = -1.0e6;
    run.load_samples.push_back(sample);
    if (i % 12 == 0) run.stage_reports.push_back({time_s, position_m(moves, time_s), "Run"});
  }
  return run;
}

// Averages of samples in steps that grow with the time since the motion, data and truth alike.
FitCurves curves_of(const CapturedRun& run, const Mix& mix) {
  FitCurves curves;
  curves.unit = "N";
  curves.motion_start_s = {kRampStart_s + 0.0645, kRampStart_s + kRamp_s + kHold_s};
  HereditaryStress stress(young_series(material_of(mix)));
  const double c_m = force_per_modulus_and_depth_m(run.specimen.contact);
  const std::vector<StageMove> moves = moves_of_run();
  double sum_s = 0.0, sum_N = 0.0, sum_fit_N = 0.0;
  int n = 0;
  for (const LoadSample& sample : run.load_samples) {
    const double time_s = sample.host_time_s;
    const double force_N =
        force_after(stress, c_m, 10e3, 1.0 / kRate_Hz, position_m(moves, time_s) - kContact_m);
    const std::size_t k = time_s < curves.motion_start_s[1] ? 0 : 1;
    const double since_s = time_s - curves.motion_start_s[k];
    if (since_s < 0.0 || time_s > 95.0 || sample.is_glitch) continue;
    sum_s += time_s;
    sum_N += *sample.counts * 1e-6 / 0.7255 - 0.02;
    sum_fit_N += force_N;
    if (++n < 1 + static_cast<int>(3.0 * since_s)) continue;
    curves.time_s.push_back(sum_s / n);
    curves.measured.push_back(sum_N / n);
    curves.fitted.push_back(sum_fit_N / n);
    curves.sigma.push_back(kNoise_N / std::sqrt(n));
    sum_s = sum_N = sum_fit_N = 0.0;
    n = 0;
  }
  return curves;
}

FittedTerm term_of(double E0_Pa, double g, double tau_s, double g_se, double ln_tau_se,
                   std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, 1.0);
  FittedTerm term;
  term.g = g + g_se * normal(random);
  term.tau_s = tau_s * std::exp(ln_tau_se * normal(random));
  term.modulus_Pa = term.g * E0_Pa;
  term.modulus_se_Pa = g_se * E0_Pa;
  term.ln_tau_se = ln_tau_se;
  term.modulus_Pa_95 = around(term.modulus_Pa, term.modulus_se_Pa);
  term.g_95 = around(term.g, g_se);
  term.tau_s_95 = around_log(term.tau_s, ln_tau_se);
  return term;
}

FitResult fit_of(const Mix& mix, const CapturedRun& run, std::mt19937_64& random) {
  FitResult fit;
  fit.terms = {term_of(mix.E0_Pa, mix.g1, mix.tau1_s, 4e-4, 0.08, random),
               term_of(mix.E0_Pa, mix.g2, mix.tau2_s, 2e-4, 0.03, random)};
  fit.E0_Pa = mix.E0_Pa * 1.0011;
  fit.E0_se_Pa = 0.9e-3 * mix.E0_Pa;
  fit.E_inf_Pa = fit.E0_Pa - fit.terms[0].modulus_Pa - fit.terms[1].modulus_Pa;
  fit.E_inf_se_Pa = 0.8e-3 * mix.E0_Pa;
  fit.E0_interval_95 = around(fit.E0_Pa, fit.E0_se_Pa);
  fit.E_inf_interval_95 = around(fit.E_inf_Pa, fit.E_inf_se_Pa);
  fit.sum_g = 1.0 - fit.E_inf_Pa / fit.E0_Pa;
  fit.sum_g_95 = around(fit.sum_g, 4.5e-4);
  fit.covariance_parameters = {"E_inf_Pa", "E_1_Pa", "E_2_Pa", "ln_tau_1", "ln_tau_2"};
  Eigen::VectorXd se(5);
  se << fit.E_inf_se_Pa, fit.terms[0].modulus_se_Pa, fit.terms[1].modulus_se_Pa, 0.08, 0.03;
  fit.covariance = se.cwiseAbs2().asDiagonal();
  fit.systematic_relative = 0.028;
  fit.n_samples = run.load_samples.size();
  fit.n_spikes = 1;
  fit.orders = {{0, 0.0213, 5210.4, 5223.1, 41.2, false},
                {1, 0.00271, 611.9, 637.2, 2.31, false},
                {2, 0.001933, 0.0, 0.0, 1.004, true},
                {3, 0.001932, 3.7, 16.4, 1.006, false}};
  fit.rss = fit.orders[2].rss;
  fit.noise = {kNoise_N, 1.03};
  fit.two_point =
      TwoPointModulus{1.27 * mix.E0_Pa, 0.004 * mix.E0_Pa, 1.62 * mix.E0_Pa,
                      "it ignores relaxation during the ramp and the frame's compliance, "
                      "and the half-space value the layer's finite thickness as well."};
  fit.contact_position_m = kContact_m;
  fit.curves = curves_of(run, mix);
  return fit;
}

PillarCheck pillar_of(const Material& material) {
  PillarCheck check;
  check.setup =
      "Pillar of 40 µm diameter and 120 µm length on a fixed base: force under a held "
      "displacement of 1 µm, displacement under a held pressure of 10 kPa.";
  const PronySeries series = young_series(material);
  const RetardationSpectrum spectrum = retardation_from_relaxation(series);
  check.relaxation.quantity = "force (N)";
  check.creep.quantity = "displacement (m)";
  for (int i = 0; i < 300; ++i) {
    const double time_s = 1e-3 * std::pow(10.0, i / 60.0);
    const double error = 1.0 + 3e-9 * std::sin(0.31 * i) * std::exp(-0.01 * i);
    const double force_N = 1e-11 * relaxation_modulus_Pa(series, time_s);
    const double way_m = 1.2 * creep_compliance_1_Pa(spectrum, time_s);
    for (PillarCheckCurve* curve : {&check.relaxation, &check.creep}) {
      const double exact = curve == &check.creep ? way_m : force_N;
      curve->time_s.push_back(time_s);
      curve->exact.push_back(exact);
      curve->solver.push_back(exact * error);
      curve->largest_relative_error =
          std::max(curve->largest_relative_error, std::abs(error - 1.0));
    }
  }
  return check;
}

SpecimenReport specimen_of(const Mix& mix, std::mt19937_64& random) {
  SpecimenReport report;
  report.specimen.id = mix.id;
  report.specimen.material = "PDMS";
  report.specimen.mixing_ratio = mix.ratio;
  report.specimen.contact = {2.2e-3, 11e-3, 0.495};
  report.specimen.rho_kg_m3 = 965.0;
  report.run = run_of(mix, report.specimen, random);
  report.fit = fit_of(mix, *report.run, random);
  report.material = material_from_fit(*report.fit, 0.495, 965.0);
  report.material->name = mix.id;
  report.truth = EmulatedTruth{.material = material_of(mix), .contact = report.specimen.contact};
  report.pillar = pillar_of(*report.material);
  report.cards = {{"abaqus", "mm-t-s", "pdms.inp",
                   "*MATERIAL, NAME=PDMS\n*DENSITY\n9.65E-10,\n*ELASTIC, MODULI=INSTANTANEOUS\n"
                   "1.88, 0.495\n*VISCOELASTIC, TIME=PRONY\n8.2E-3, 8.2E-3, 0.1945\n"}};
  report.files = {{std::string("run_") + std::to_string(static_cast<int>(mix.ratio)) + ".viscap",
                   "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08"}};
  return report;
}

}  // namespace

ReportInput synthetic_report() {
  std::mt19937_64 random(20260105);
  ReportInput input;
  input.title = "Three mixing ratios of PDMS on the emulated rig";
  input.created_by = "viscard 0.1.0";
  input.command = "viscard report run_10.viscap run_13.viscap run_20.viscap --out report.html";
  for (const Mix& mix : kMixes) input.specimens.push_back(specimen_of(mix, random));
  input.specimens[1].fit->flags = {
      {"term-faster-than-ramp", 1,
       "The relaxation time lies below the ramp time of 1 s; the quick "
       "unloading carries what is known of it."}};
  return input;
}

ReportInput bare_report() {
  ReportInput input;
  for (const Mix& mix : kMixes) {
    SpecimenReport report;
    report.material = material_of(mix);
    input.specimens.push_back(report);
  }
  return input;
}

}  // namespace viscard::test
