#pragma once

// Ceres brings in glog, whose CHECK aborts the process; included after Catch it silently replaces
// Catch's CHECK, and the assertions are no longer counted. Tests that need Ceres include this
// header and neither of the two directly.
#include <ceres/ceres.h>
#undef CHECK

#include <catch2/catch.hpp>
