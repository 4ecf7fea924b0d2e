#pragma once

#include "io/cards/read_card.h"

#include <string>
#include <vector>

namespace viscard {

// Small tools all readers share. Line numbers are 1-based.
struct CardLine {
  int number = 0;
  std::string text;
};

// Lines without those that open with the comment sign (after blanks, unless keep_indent).
std::vector<CardLine> card_lines(const std::string& text, const std::string& comment);

std::string trimmed(const std::string& text);
std::string upper(std::string text);
// Cells between separators, blanks trimmed; "a, b," gives {"a", "b", ""}.
std::vector<std::string> cells(const std::string& line, char separator);
// Fixed columns of `width`; cells between commas if the line has one.
std::vector<std::string> columns(const std::string& line, std::size_t width);

// A number as solvers read it: "1.88", ".5", "1D-3", "1.2-5" (Fortran), "3*". Throws
// std::runtime_error "line 7: 'abc' is not a number (g_i expected)".
double card_number(const std::string& cell, const CardLine& line, const std::string& expected);
double cell_number(const std::vector<std::string>& row, std::size_t index, const CardLine& line,
                   const std::string& expected);
// 0 where the cell is missing or blank.
double cell_number_or_zero(const std::vector<std::string>& row, std::size_t index,
                           const CardLine& line, const std::string& expected);

// One reader per dialect; they fill numbers, findings and understood.
void read_abaqus(const std::string& text, ReadCard& card);
void read_ansys(const std::string& text, ReadCard& card);
void read_lsdyna(const std::string& text, ReadCard& card);
void read_lsdyna006(const std::string& text, ReadCard& card);
void read_febio(const std::string& text, ReadCard& card);
void read_mfront(const std::string& text, ReadCard& card);
void read_calculix(const std::string& text, ReadCard& card);
void read_openradioss(const std::string& text, ReadCard& card);
void read_comsol(const std::string& text, ReadCard& card);
void read_moose(const std::string& text, ReadCard& card);
void read_frontistr(const std::string& text, ReadCard& card);
void read_card_json(const std::string& text, ReadCard& card);

}  // namespace viscard
