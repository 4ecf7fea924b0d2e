#pragma once

#include "io/tables/csv_table.h"

#include <pybind11/pybind11.h>

#include <string>

namespace viscard::python {

// A table of header to numbers; name stands for the file in messages. All arrays have one length.
CsvTable table_from_arrays(const pybind11::dict& arrays, const std::string& name);

// The compiled module in parts, one for each subject. Python code in viscard/ gives them their public
// names, types and documentation.
void add_errors(pybind11::module_& module);
void add_tables(pybind11::module_& module);     // read_table, read_capture
void add_fits(pybind11::module_& module);       // fit, joint fits
void add_rubber(pybind11::module_& module);     // tests at large strain, cards of rubber
void add_materials(pybind11::module_& module);  // materials, cards, predictions
void add_planning(pybind11::module_& module);   // cost_of_tests
void add_scenes(pybind11::module_& module);     // simulate, plan, cost
void add_inverse(pybind11::module_& module);    // pressures from voltages
void add_sweeps(pybind11::module_& module);     // sweep
void add_designs(pybind11::module_& module);    // design
void add_rig(pybind11::module_& module);        // capture, calibrate

}  // namespace viscard::python
