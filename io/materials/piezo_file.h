#pragma once

#include "models/material/film_loss.h"
#include "models/pillar/system/medium.h"
#include "models/quantities/plausible.h"

#include <filesystem>
#include <string>

namespace viscard {

// Elastic and piezoelectric media of films and ceramics, schema "viscard-medium/1": JSON with name,
// rho_kg_m3 and
//   elastic: {E_Pa, nu} or {s11, s12, s13, s33, s55, s66 in 1/Pa} (transversely isotropic about z);
//   charge_C_N: {d31, d32, d33, d24, d15}, d32 defaults to d31 and d24 to d15;
//   relative_permittivity: [e11, e22, e33] at constant stress;
//   dielectric: {resistivity_Ohm_m, terms: [{relative_permittivity, tau_s}, ...]} or, instead of terms,
//     {frequency_Hz: [...], tan_delta: [...], permittivity_at_Hz}: relative_permittivity is then that at
//     this frequency; beside terms it is that at once (models/material/film_loss.h);
//   plausible: "off" accepts any modulus and density.
struct MediumFile {
  std::string name;
  Medium medium;
  PiezoMatrix charge_C_N = PiezoMatrix::Zero();
  double permittivity_stress_F_m = 0.0;  // along z, at once
  FilmLoss loss;                         // its shares are of the permittivity at constant strain
};

// Throws std::runtime_error naming the file and the key.
MediumFile read_medium(const std::filesystem::path& path, Plausible judged = Plausible::kScene);
// The same from text; messages show name in place of the file.
MediumFile medium_from_json(const std::string& text, const std::string& name,
                            Plausible judged = Plausible::kScene);

}  // namespace viscard
