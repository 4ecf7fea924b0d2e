#pragma once

#include "models/contact/punch_contact.h"

#include <string>

namespace viscard {

// The contents of specimen.toml (data/demo/03_pdms_1to10.toml is the commented example): the
// specimen and the punch that presses on it. SI.
struct Specimen {
  std::string id;
  std::string material;       // "PDMS"
  double mixing_ratio = 0.0;  // parts of base to one of curing agent; 0: not given
  PunchContact contact;
  double modulus_guess_Pa = 0.0;  // for pre-flight and the stage travel only, never for the fit
  // Share of the force that relaxes within the test, for pre-flight and for how soft a press may be beside the touch.
  // PDMS: below 0.05.
  double relaxation_guess = 0.05;
  double rho_kg_m3 = 0.0;
  double temperature_C = 23.0;
  bool accepts_implausible = false;  // of values that no bench can have (plausible = "off")
};

}  // namespace viscard
