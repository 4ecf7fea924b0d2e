#pragma once

#include "io/cards/card.h"
#include "io/cards/card_numbers.h"

#include <string>
#include <vector>

namespace viscard {

// What a writer formats. Writers do no algebra on the material: all numbers are ready.
struct CardBody {
  std::string name;  // an identifier every code takes: letters, digits, underscores
  CardNumbers numbers;
  const CardTarget& target;
  const UnitSystem& units;
  const Material& material;  // SI, for the two targets that state SI-like tables (json, csv)
  std::vector<std::string> header;
};

// The text after the header, one function per dialect.
std::string abaqus_body(const CardBody& body);
std::string ansys_body(const CardBody& body);
std::string lsdyna_body(const CardBody& body);  // 076
std::string lsdyna006_body(const CardBody& body);
std::string febio_body(const CardBody& body);  // both forms
std::string mfront_body(const CardBody& body);
std::string mfront_properties(const CardBody& body);  // for the gallery's GeneralizedMaxwell
std::string calculix_body(const CardBody& body);
std::string openradioss_body(const CardBody& body);
std::string comsol_body(const CardBody& body);
std::string comsol_relaxation_table(const CardBody& body);
std::string moose_body(const CardBody& body);
std::string frontistr_body(const CardBody& body);
std::string json_body(const CardBody& body);
std::string csv_body(const CardBody& body);

// Chooses among the above by target.
std::string card_body(const CardBody& body);
std::vector<CompanionFile> card_companions(const CardBody& body);

}  // namespace viscard
