#include "tests/models/scene/wide_scenes.h"

#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/system/rotated_medium.h"
#include "tests/models/pillar/drive_as.h"
#include "tests/models/scene/random_scenes.h"
#include "tests/support/random_draw.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>

namespace viscard::test {
namespace {

void draw_rim(Draw& draw, PillarScene& scene) {
  if (!scene.geometry.film) return;
  const double R = 0.5 * scene.geometry.diameter_m;
  if (draw.chance(0.25)) scene.geometry.film->radius_m = R;
  if (draw.chance(0.2)) scene.geometry.film->radius_m = R * (1.0 + draw.log_uniform(1e-2, 0.5));
}

void draw_many_terms(Draw& draw, PillarScene& scene) {
  if (scene.pillar.terms.empty() || !draw.chance(0.4)) return;
  const bool is_alike = draw.chance(0.5);
  const double sum = draw.uniform(0.1, 0.9);
  scene.pillar.terms.clear();
  for (int i = 0; i < 12; ++i) {  // from 1 us to 1e6 s
    const double g = sum / 12.0 * draw.uniform(0.3, 1.0);
    scene.pillar.terms.push_back(
        {g, is_alike ? g : g * draw.uniform(0.0, 1.0), std::pow(10.0, i - 6 + draw.uniform(0, 1))});
  }
}

void draw_electrode(Draw& draw, PillarScene& scene) {
  if (!scene.film || !scene.film->is_piezoelectric()) return;
  const double R = 0.5 * scene.geometry.diameter_m;
  const double widest_m = scene.geometry.film->radius_m;
  ElectrodeOptions electrode{draw.chance(0.5) ? FilmFace::kTop : FilmFace::kBottom, R};
  const double kind = draw.uniform(0.0, 1.0);
  if (kind < 0.2) electrode.electrode_radius_m = widest_m;
  if (kind > 0.2 && kind < 0.4) electrode.electrode_radius_m = 0.0;  // sampled
  if (kind > 0.4 && kind < 0.6) {
    electrode.electrode_radius_m =
        R * (1.0 + (draw.chance(0.5) ? 1.0 : -1.0) * draw.log_uniform(1e-2, 0.3));
  }
  if (kind > 0.8) electrode.electrode_radius_m = widest_m * draw.uniform(0.3, 1.0);
  electrode.electrode_radius_m = std::min(electrode.electrode_radius_m, widest_m);
  scene.electrodes = electrode;
  const bool is_sampled = electrode.electrode_radius_m == 0.0;
  scene.wanted = {"top_displacement", is_sampled ? "potential_at_centre" : "electrode_voltage"};
  if (!is_sampled && draw.chance(0.15)) {
    scene.electrodes->quadrants = true;
    as<StaticDrive>(scene).direction = LoadDirection::kLateral;
    scene.wanted = {"top_displacement", "quadrant_charge"};
  } else if (draw.chance(0.2)) {  // stretched in one direction
    Medium film = *scene.film;
    film.piezo_C_m2.col(1) *= draw.uniform(0.2, 0.9);
    scene.directional_film = film;
    scene.film = averaged_about_z(film);
  }
}

// A share of the load that the pillar bears for ever.
double bearable_Pa(const PillarScene& scene, double share) {
  const PillarScene lasting = long_term_scene(scene);
  const double rough_Pa = engesser_pressure_Pa(lasting);
  return share * std::min(pillar_buckling_pressure_Pa(lasting), 2.0 * rough_Pa);
}

void draw_load(Draw& draw, PillarScene& scene) {
  const double share = draw.chance(0.3) ? draw.uniform(0.5, 0.97) : draw.log_uniform(1e-4, 0.5);
  if (auto* rest = std::get_if<StaticDrive>(&scene.drive)) {
    rest->pressure_Pa = bearable_Pa(scene, share);
  } else if (auto* modes = std::get_if<ModalDrive>(&scene.drive)) {
    if (modes->pressure_Pa > 0.0) modes->pressure_Pa = bearable_Pa(scene, share);
  } else if (auto* creep = std::get_if<CreepDrive>(&scene.drive)) {
    double largest = 0.0;
    for (const CoursePoint& p : creep->history) largest = std::max(largest, p.value);
    const double factor = bearable_Pa(scene, share) / largest;
    for (CoursePoint& p : creep->history) p.value *= factor;
  }
}

// A modal scene becomes an oscillation about its first resonances.
void draw_oscillation(Draw& draw, PillarScene& scene) {
  if (!std::holds_alternative<ModalDrive>(scene.drive) || !draw.chance(0.3)) return;
  const double bar_Hz =
      std::sqrt(scene.pillar.E0_Pa / scene.pillar.rho_kg_m3) / (4.0 * scene.geometry.length_m);
  HarmonicDrive drive;
  drive.load_place = draw.chance(0.5) ? LoadPlace::kTop : LoadPlace::kBase;
  drive.direction = draw.chance(0.5) ? LoadDirection::kAxial : LoadDirection::kLateral;
  (drive.load_place == LoadPlace::kTop ? drive.pressure_Pa : drive.base_acceleration_m_s2) = 1.0;
  const double first_Hz = bar_Hz * draw.log_uniform(1e-2, 1.0);
  for (int i = 0; i < 4; ++i) drive.frequencies_Hz.push_back(first_Hz * std::pow(1.3, i));
  if (scene.pillar.terms.empty()) scene.pillar.terms = {{0.1, 0.05, 0.1 / bar_Hz}};
  scene.drive = drive;
  scene.electrodes.reset();
  scene.wanted.clear();
}

std::string number(double value) {
  return fmt::format("{:.17g}", value);
}

std::string pairs_of(const Course& points) {
  std::string text;
  for (const CoursePoint& p : points) {
    text += (text.empty() ? "[" : ", [") + number(p.time_s) + ", " + number(p.value) + "]";
  }
  return "[" + text + "]";
}

std::string load_of(const char* key, double value, bool is_base, bool is_lateral) {
  return fmt::format("load = {{ {} = {:.17g}, on = \"{}\", direction = \"{}\" }}\n", key, value,
                     is_base ? "base" : "top", is_lateral ? "lateral" : "axial");
}

std::string analysis_text(const PillarScene& scene) {
  std::string text = fmt::format("[analysis]\nkind = \"{}\"\n", analysis_of(scene).name);
  if (const auto* rest = std::get_if<StaticDrive>(&scene.drive)) {
    const bool is_lateral = rest->direction == LoadDirection::kLateral;
    text += load_of(is_lateral ? "shear" : "pressure", rest->pressure_Pa, false, is_lateral);
  } else if (const auto* modal = std::get_if<ModalDrive>(&scene.drive)) {
    text += fmt::format("modes = {}\n", modal->modes);
    if (modal->pressure_Pa > 0.0) text += load_of("pressure", modal->pressure_Pa, false, false);
  } else if (const auto* harmonic = std::get_if<HarmonicDrive>(&scene.drive)) {
    const bool is_base = harmonic->load_place == LoadPlace::kBase;
    const bool is_lateral = harmonic->direction == LoadDirection::kLateral;
    const char* key = is_base ? "acceleration" : is_lateral ? "shear" : "pressure";
    text += load_of(key, 1.0, is_base, is_lateral);
    text += fmt::format("frequencies = {{ from = {:.17g}, to = {:.17g}, count = 4 }}\n",
                        harmonic->frequencies_Hz.front(), harmonic->frequencies_Hz.back());
  } else if (has_history(scene)) {
    text += "history = " + pairs_of(history(scene)) + "\n";
  }
  return text;
}

void write_pillar(const PillarScene& scene, const std::filesystem::path& path) {
  const Material& m = scene.pillar;
  std::string terms;
  for (const MaterialTerm& term : m.terms) {
    terms += fmt::format("{}{{\"g\": {:.17g}, \"k\": {:.17g}, \"tau_s\": {:.17g}}}",
                         terms.empty() ? "" : ", ", term.g, term.k, term.tau_s);
  }
  std::ofstream(path) << fmt::format(
      "{{\"E0_Pa\": {:.17g}, \"nu\": {:.17g}, \"rho_kg_m3\": {:.17g}, \"terms\": [{}]}}\n", m.E0_Pa,
      m.nu, m.rho_kg_m3, terms);
}

void write_film(const Medium& film, const std::filesystem::path& path) {
  const Matrix6d s = film.stiffness_Pa.inverse();
  const PiezoMatrix d = film.piezo_C_m2 * s;
  const Eigen::Matrix3d eps =
      (film.permittivity_F_m + d * film.stiffness_Pa * d.transpose()) / kVacuumPermittivity_F_m;
  std::string text = fmt::format(
      "{{\"schema\": \"viscard-medium/1\", \"name\": \"film\", \"rho_kg_m3\": {:.17g}, "
      "\"elastic\": "
      "{{\"s11\": {:.17g}, \"s12\": {:.17g}, \"s13\": {:.17g}, \"s33\": {:.17g}, \"s55\": {:.17g}, "
      "\"s66\": {:.17g}}}",
      film.rho_kg_m3, s(0, 0), s(0, 1), s(0, 2), s(2, 2), s(4, 4), s(5, 5));
  if (film.is_piezoelectric()) {
    text += fmt::format(
        ", \"charge_C_N\": {{\"d31\": {:.17g}, \"d32\": {:.17g}, \"d33\": {:.17g}, \"d15\": "
        "{:.17g}, \"d24\": {:.17g}}}, \"relative_permittivity\": [{:.17g}, {:.17g}, {:.17g}]",
        d(2, 0), d(2, 1), d(2, 2), d(0, 4), d(1, 3), eps(0, 0), eps(1, 1), eps(2, 2));
  }
  std::ofstream(path) << text << "}\n";
}

std::string film_text(const PillarScene& scene) {
  if (!scene.film) return "";
  std::string text =
      fmt::format("film = {{ thickness = {:.17g}, radius = {:.17g}, material = \"film\" }}\n",
                  scene.geometry.film->thickness_m, scene.geometry.film->radius_m);
  if (!scene.electrodes) return text;
  const ElectrodeOptions& e = *scene.electrodes;
  text += fmt::format("electrode = {{ face = \"{}\", ",
                      e.grounded == FilmFace::kTop ? "bottom" : "top");
  if (e.electrode_radius_m == 0.0) return text + "kind = \"sampled\" }\n";
  return text + fmt::format("radius = {:.17g}{} }}\n", e.electrode_radius_m,
                            e.quadrants ? ", quadrants = true" : "");
}

}  // namespace

PillarScene wide_scene(std::mt19937_64& random) {
  PillarScene scene = random_scene(random);
  // A stream of its own, so that the next scene does not depend on what is drawn here.
  std::mt19937_64 own(static_cast<std::uint64_t>(1e16 * scene.geometry.length_m));
  Draw draw(own);
  draw_rim(draw, scene);
  draw_many_terms(draw, scene);
  if (std::holds_alternative<StaticDrive>(scene.drive)) {
    draw_electrode(draw, scene);
  } else if (scene.electrodes) {
    scene.electrodes->electrode_radius_m =
        std::min(scene.electrodes->electrode_radius_m, scene.geometry.film->radius_m);
  }
  draw_oscillation(draw, scene);
  draw_load(draw, scene);
  return scene;
}

void write_scene(const PillarScene& scene, const std::filesystem::path& folder,
                 const std::string& name) {
  std::filesystem::create_directories(folder);
  write_pillar(scene, folder / (name + ".pillar.json"));
  std::string materials = "[materials]\npillar = { file = \"" + name + ".pillar.json\" }\n";
  if (scene.film) {
    write_film(scene.directional_film.value_or(*scene.film), folder / (name + ".film.json"));
    materials += "film = { file = \"" + name + ".film.json\" }\n";
  }
  std::string wanted;
  for (const std::string& one : scene.wanted) {
    wanted += (wanted.empty() ? "\"" : ", \"") + one + "\"";
  }
  std::ofstream(folder / (name + ".toml"))
      << fmt::format("tolerance = {:.17g}\n[geometry]\ndiameter = {:.17g}\nlength = {:.17g}\n",
                     scene.tolerance, scene.geometry.diameter_m, scene.geometry.length_m)
      << film_text(scene) << materials << analysis_text(scene)
      << (wanted.empty() ? "" : "[want]\nquantities = [" + wanted + "]\n");
}

}  // namespace viscard::test
