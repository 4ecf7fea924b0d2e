#pragma once

namespace viscard {

// Free vibration, perhaps under a pressure at rest on the top.
struct ModalDrive {
  int modes = 4;             // of each family
  double pressure_Pa = 0.0;  // prestress
};

}  // namespace viscard
