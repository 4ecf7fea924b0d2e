// Stiffness and mass of a pillar, and the solution of its statics.
#include "models/pillar/body/pillar_model.h"

#include <algorithm>
#include <cmath>

namespace viscard {

bool PillarModel::StiffnessParts::condenses() const {
  return std::any_of(bulk_Pa.begin(), bulk_Pa.end(), [](double K) { return K > 0.0; });
}

PillarModel::StiffnessParts PillarModel::stiffness_parts(const std::vector<int>& regions) const {
  const auto n = static_cast<Eigen::Index>(system_->kinematics().strain_and_field().size());
  StiffnessParts parts{std::vector<Eigen::MatrixXd>(media_.size()),
                       std::vector<double>(media_.size(), 0.0)};
  for (const int region : regions) {
    const auto i = static_cast<std::size_t>(region);
    Eigen::MatrixXd& form = parts.forms[i];
    form = elastic_form(media_[i]);
    // An elastic region among electric ones.
    if (form.rows() < n) form.conservativeResizeLike(Eigen::MatrixXd::Zero(n, n));
    parts.bulk_Pa[i] = condensed_bulk_Pa(media_[i]);
  }
  return parts;
}

SymmetricSparse PillarModel::stiffness_of(const std::vector<int>& regions) const {
  const StiffnessParts parts = stiffness_parts(regions);
  SymmetricSparse matrix = system_->form(system_->kinematics().strain_and_field(), parts.forms);
  if (parts.condenses()) matrix.coeffs() += system_->volume_form(parts.bulk_Pa, true).coeffs();
  return matrix;
}

std::vector<int> PillarModel::all_regions() const {
  return media_.size() == 1 ? std::vector<int>{kPillarRegion}
                            : std::vector<int>{kPillarRegion, kFilmRegion};
}

SymmetricSparse PillarModel::stiffness() const {
  return stiffness_of(all_regions());
}

bool PillarModel::loses_digits() const {
  constexpr double kSlender = 12.0;   // length over diameter
  constexpr double kStiffBulk = 1e3;  // over the shear modulus: nu = 0.4995
  const Motion motion = options_.motion;
  const bool bends = motion == Motion::kLateral || motion == Motion::kPlaneAntisymmetric;
  const Medium& pillar = media_[kPillarRegion];
  return (bends && geometry_.length_m > kSlender * geometry_.diameter_m) ||
         (pillar.is_isotropic && std::isfinite(pillar.bulk_Pa) && !is_plane_stress() &&
          pillar.bulk_Pa > kStiffBulk * pillar.shear_Pa);
}

Eigen::VectorXd PillarModel::stiffness_times(const Eigen::VectorXd& u,
                                             const Eigen::VectorXd& source) const {
  const StiffnessParts parts = stiffness_parts(all_regions());
  Eigen::VectorXd product =
      system_->form_times(system_->kinematics().strain_and_field(), parts.forms, u);
  if (!parts.condenses()) return product;
  // A source of pressures is the pillar's; a film has its own volume.
  std::vector<double> of_film = parts.bulk_Pa;
  of_film[kPillarRegion] = 0.0;
  std::vector<double> of_pillar(parts.bulk_Pa.size(), 0.0);
  of_pillar[kPillarRegion] = parts.bulk_Pa[kPillarRegion];
  product += system_->volume_form_times(of_pillar, true, source);
  if (of_film.back() > 0.0) product += system_->volume_form_times(of_film, true, u);
  return product;
}

SymmetricSparse PillarModel::stiffness_of(int region) const {
  return stiffness_of(std::vector<int>{region});
}

std::vector<Eigen::MatrixXd> PillarModel::mass_forms() const {
  std::vector<Eigen::MatrixXd> forms;
  for (const Medium& medium : media_) {
    forms.push_back(medium.rho_kg_m3 * Eigen::MatrixXd::Identity(3, 3));
  }
  return forms;
}

SymmetricSparse PillarModel::mass() const {
  return system_->form(system_->kinematics().displacement, mass_forms());
}

Eigen::VectorXd PillarModel::mass_times(const Eigen::VectorXd& u) const {
  return system_->form_times(system_->kinematics().displacement, mass_forms(), u);
}

void PillarModel::factor(const SymmetricSparse& matrix, StiffnessFactor& factor,
                         double stiffening) const {
  const Medium& pillar = media_[kPillarRegion];
  if (!condenses_pressure(pillar) || !std::isinf(pillar.bulk_Pa)) {
    factor.factor(matrix);
    return;
  }
  SymmetricSparse penalty = system_->volume_form({kPenaltyOverShear * pillar.shear_Pa, 0.0}, true);
  if (stiffening == 1.0) {
    factor.factor(matrix);
  } else {
    SymmetricSparse stiffer = matrix;
    stiffer.coeffs() += (stiffening - 1.0) * penalty.coeffs();
    penalty.coeffs() *= stiffening;
    factor.factor(stiffer);
  }
  factor.constrain(penalty);
}

StiffnessFactor PillarModel::factored() const {
  StiffnessFactor factored;
  if (nearby_ != nullptr) {
    factored.approximate(*nearby_solutions_,
                         [this](const Eigen::VectorXd& u, const Eigen::VectorXd& w) {
                           return stiffness_times(u, w);
                         });
  } else {
    factor(stiffness(), factored);
    if (loses_digits()) {
      factored.refine_by([this](const Eigen::VectorXd& u, const Eigen::VectorXd& source) {
        return stiffness_times(u, source);
      });
    }
  }
  return factored;
}

PillarState PillarModel::solve(const Eigen::VectorXd& forces) const {
  PillarState state;
  state.unknowns = factored().solve(forces, &state.pressure_source);
  return state;
}

}  // namespace viscard
