#pragma once

#include "io/cards/card_lines.h"
#include "io/cards/named_values.h"

#include <string>
#include <vector>

namespace viscard {

// Cards of laws of rubber that are programs: a Python module for SfePy and an MFront behaviour, with any numbers but
// as viscard writes them.
std::string write_sfepy_law(const CardBody& body);
void read_sfepy_law(const std::string& text, ReadCard& card);
std::string write_mfront_law(const CardBody& body);
void read_mfront_law(const std::string& text, ReadCard& card);

// Shares and times of relaxation of one length; those of no share are left out.
void take_program_terms(const NamedNumbers& lists, const char* share, const char* time,
                        CardNumbers& law);
// The lines of a program that compute, without blanks at their end and comments, and without those of the pattern, whose
// numbers were read.
std::vector<CardLine> computing_lines(const std::string& text, const char* comment,
                                      const char* numbers, bool is_indented);
// Throws std::runtime_error for a program whose formula is not the one that viscard writes for the law.
void require_formula(const std::vector<CardLine>& found, const std::vector<CardLine>& expected);

}  // namespace viscard
