#pragma once

#include "io/report/report.h"

namespace viscard::test {

// A report on three emulated specimens, made from the models with seeded noise and without any
// fitting: estimates are the truth with an error drawn from the standard errors they state. Truth:
// the three mixing ratios of PDMS of data/demo.
ReportInput synthetic_report();

// The same with everything optional taken away: materials only, no uncertainty, no truth.
ReportInput bare_report();

}  // namespace viscard::test
