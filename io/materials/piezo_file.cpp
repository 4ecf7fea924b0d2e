#include "io/materials/piezo_file.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/materials/material_json.h"
#include "io/materials/plausible_numbers.h"

#include <nlohmann/json.hpp>

#include <complex>
#include <numbers>
#include <set>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

double number_in(const nlohmann::json& object, const char* key) {
  if (!object.contains(key)) throw std::invalid_argument(std::string("'") + key + "' is missing");
  if (!object[key].is_number()) {
    throw std::invalid_argument(std::string("'") + key + "' must be a number");
  }
  return object[key].get<double>();
}

double number_in(const nlohmann::json& object, const char* key, double otherwise) {
  return object.contains(key) ? number_in(object, key) : otherwise;
}

Matrix6d stiffness_from(const nlohmann::json& elastic) {
  if (elastic.contains("E_Pa")) {
    return isotropic_moduli_Pa(number_in(elastic, "E_Pa"), number_in(elastic, "nu"));
  }
  const double s11 = number_in(elastic, "s11"), s12 = number_in(elastic, "s12");
  const double s13 = number_in(elastic, "s13"), s33 = number_in(elastic, "s33");
  const double s55 = number_in(elastic, "s55"), s66 = number_in(elastic, "s66");
  Matrix6d s = Matrix6d::Zero();
  s.topLeftCorner<3, 3>() << s11, s12, s13, s12, s11, s13, s13, s13, s33;
  s.diagonal().tail<3>() << s55, s55, s66;
  const Matrix6d scaled = s / s11;  // scaled to numbers near 1, for the accuracy of the inverse
  const Matrix6d inverse = viscard::inverse(scaled);
  return 0.5 * (inverse + inverse.transpose()) / s11;
}

std::vector<double> numbers_in(const nlohmann::json& object, const char* key) {
  const nlohmann::json& list = object.at(key);
  if (!list.is_array()) throw std::invalid_argument(std::string("'") + key + "' must be a list");
  std::vector<double> numbers;
  for (const nlohmann::json& one : list) numbers.push_back(one.get<double>());
  return numbers;
}

// The loss over the permittivity at constant stress; the permittivity becomes that at once. leakage_s is the
// resistivity.
FilmLoss loss_from(const nlohmann::json& dielectric, Eigen::Matrix3d& permittivity_F_m) {
  static const std::set<std::string> kKnown = {"resistivity_Ohm_m", "terms", "frequency_Hz",
                                               "tan_delta", "permittivity_at_Hz"};
  for (const auto& [key, value] : dielectric.items()) {
    if (!kKnown.contains(key)) {
      throw std::invalid_argument("there is no key 'dielectric." + key + "'");
    }
  }
  FilmLoss loss;
  loss.leakage_s = number_in(dielectric, "resistivity_Ohm_m", loss.leakage_s);
  for (const nlohmann::json& term : dielectric.value("terms", nlohmann::json::array())) {
    const double added_F_m = number_in(term, "relative_permittivity") * kVacuumPermittivity_F_m;
    loss.terms.push_back({added_F_m / permittivity_F_m(2, 2), number_in(term, "tau_s")});
  }
  if (dielectric.contains("tan_delta")) {
    if (!loss.terms.empty()) {
      throw std::invalid_argument(
          "'dielectric' has both 'terms' and 'tan_delta'; give one of them");
    }
    const std::vector<double> frequency_Hz = numbers_in(dielectric, "frequency_Hz");
    loss.terms = terms_from_tan_delta(frequency_Hz, numbers_in(dielectric, "tan_delta"));
    const double at_rad_s = 2.0 * std::numbers::pi * number_in(dielectric, "permittivity_at_Hz");
    if (!(at_rad_s > 0.0)) throw std::invalid_argument("'permittivity_at_Hz' must be positive");
    const FilmLoss polarisation{.terms = loss.terms};
    permittivity_F_m /=
        1.0 + added_permittivity(polarisation, std::complex<double>(0.0, at_rad_s)).real();
  }
  validate(loss);
  return loss;
}

// Strain adds the same permittivity at all times.
FilmLoss of_constant_strain(FilmLoss loss, double stress_F_m, double strain_F_m) {
  loss.leakage_s *= strain_F_m;
  for (FilmTerm& term : loss.terms) term.share *= stress_F_m / strain_F_m;
  return loss;
}

MediumFile medium_from(const nlohmann::json& object, const std::string& name, Plausible judged) {
  static const std::set<std::string> kKnown = {"schema",  "name",       "rho_kg_m3",
                                               "elastic", "charge_C_N", "relative_permittivity",
                                               "source",  "plausible",  "dielectric"};
  for (const auto& [key, value] : object.items()) {
    if (!kKnown.contains(key)) throw std::invalid_argument("there is no key '" + key + "'");
  }
  if (object.value("schema", "") != "viscard-medium/1") {
    throw std::invalid_argument("'schema' must be \"viscard-medium/1\"");
  }
  if (!object.contains("elastic")) throw std::invalid_argument("'elastic' is missing");
  MediumFile file;
  file.name = object.value("name", "");
  const double rho = number_in(object, "rho_kg_m3");
  const nlohmann::json& elastic = object["elastic"];
  judged = plausible_from_word(object.value("plausible", "on"), judged);
  refuse_implausible(name, "rho_kg_m3", quantities::kDensity, rho, judged);
  if (elastic.contains("E_Pa")) {
    refuse_implausible(name, "E_Pa", quantities::kModulus, number_in(elastic, "E_Pa"), judged);
  } else {  // the compliances along the axes
    for (const char* key : {"s11", "s33"}) {
      refuse_implausible(name, std::string("1/") + key, quantities::kModulus,
                         1.0 / number_in(elastic, key), judged);
    }
  }
  const Matrix6d stiffness = stiffness_from(elastic);
  if (!object.contains("charge_C_N")) {
    if (object.contains("dielectric")) {
      throw std::invalid_argument("'dielectric' needs 'charge_C_N' and 'relative_permittivity'");
    }
    file.medium = elastic_medium(stiffness, rho);
    return file;
  }
  const nlohmann::json& d = object["charge_C_N"];
  file.charge_C_N(2, 0) = number_in(d, "d31");
  file.charge_C_N(2, 1) = number_in(d, "d32", file.charge_C_N(2, 0));
  file.charge_C_N(2, 2) = number_in(d, "d33");
  file.charge_C_N(0, 4) = number_in(d, "d15", 0.0);
  file.charge_C_N(1, 3) = number_in(d, "d24", file.charge_C_N(0, 4));
  const nlohmann::json permittivity =
      object.value("relative_permittivity", nlohmann::json::array());
  if (!permittivity.is_array() || permittivity.size() != 3) {
    throw std::invalid_argument("'relative_permittivity' must be three numbers");
  }
  Eigen::Matrix3d eps = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    eps(i, i) = permittivity[static_cast<std::size_t>(i)].get<double>() * kVacuumPermittivity_F_m;
  }
  const FilmLoss stated = loss_from(object.value("dielectric", nlohmann::json::object()), eps);
  file.permittivity_stress_F_m = eps(2, 2);
  file.medium = piezo_medium(stiffness, file.charge_C_N, eps, rho);
  file.loss = of_constant_strain(stated, eps(2, 2), file.medium.permittivity_F_m(2, 2));
  return file;
}

}  // namespace

MediumFile read_medium(const std::filesystem::path& path, Plausible judged) {
  return medium_from_json(read_file(path), path.string(), judged);
}

MediumFile medium_from_json(const std::string& text, const std::string& name, Plausible judged) {
  return read_as(FileKind::kMedium, text, name, [&] {
    try {
      return medium_from(nlohmann::json(parse_json(text, name)), name, judged);
    } catch (const nlohmann::json::exception& error) {
      throw std::runtime_error(name + ": is not a medium file: " + reason_of(error));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(name + ": " + error.what());
    }
  });
}

}  // namespace viscard
