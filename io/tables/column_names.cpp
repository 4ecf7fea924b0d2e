#include "io/tables/column_names.h"

#include "io/tables/csv_header.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

// Returns the text in lower case; each run of blanks, underscores, hyphens and dots becomes one blank.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : lower_case(text)) {
    const bool is_gap = c == ' ' || c == '_' || c == '-' || c == '.' || c == '\t';
    if (is_gap && (out.empty() || out.back() == ' ')) continue;
    out += is_gap ? ' ' : c;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

// Primes as instruments write them: G", G\u2032, G\u2033, G\u2019.
std::string with_plain_primes(std::string name) {
  constexpr std::pair<const char*, const char*> kPrimes[] = {
      {"\"", "''"}, {"\u2033", "''"}, {"\u2032", "'"}, {"\u2019", "'"}};
  for (const auto& [written, primes] : kPrimes) {
    const std::string from = written;
    for (std::size_t at = name.find(from); at != std::string::npos; at = name.find(from, at)) {
      name.replace(at, from.size(), primes);
    }
  }
  return name;
}

bool has_alias(const ColumnKind& quantity, const std::string& name) {
  const std::string primed = with_plain_primes(name);
  return std::any_of(quantity.aliases.begin(), quantity.aliases.end(), [&](const char* alias) {
    const std::string text = alias;
    const bool is_letter = text.size() == 1 || text.find('\'') == 1;  // t, T, E', G''
    return (is_letter ? primed : plain(primed)) == text;
  });
}

// The name without the kind of load ("Tensile stress") or of value ("Mean stress") and without symbols beside words: "Shear
// relaxation modulus G(t)" is a "relaxation modulus", "E' - Storage modulus" a "Storage modulus".
std::string without_kind_and_symbol(const std::string& name) {
  constexpr const char* kKinds[] = {"shear",   "tensile", "tension", "compressive", "compression",
                                    "young's", "youngs",  "young",   "axial",       "uniaxial",
                                    "mean",    "average", "avg"};
  constexpr const char* kSymbols[] = {
      "e",    "g",     "j",     "d",    "e(t)", "g(t)",   "j(t)",   "d(t)", "e'",    "g'",
      "e''",  "g''",   "|e*|",  "|g*|", "e*",   "g*",     "|eta*|", "|η*|", "eta*",  "η*",
      "δ",    "σ",     "τ",     "ε",    "γ",    "λ",      "ω",      "f",    "t",     "(e)",
      "(g)",  "(δ)",   "(ω)",   "(t)",  "(f)",  "(σ)",    "(τ)",    "(ε)",  "(γ)",   "(e')",
      "(g')", "(e'')", "(g'')", "(e*)", "(g*)", "(|e*|)", "(|g*|)", "(η*)", "(|η*|)"};
  std::string rest;
  std::string text = plain(with_plain_primes(name));
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::size_t n_words = 0, n_left = 0;
  for (std::string word; words >> word; ++n_words) {
    const auto is_among = [&](const auto& list) {
      return std::find(std::begin(list), std::end(list), word) != std::end(list);
    };
    if (is_among(kKinds) || is_among(kSymbols)) continue;
    rest += (n_left++ == 0 ? "" : " ") + word;
  }
  return n_left < n_words ? rest : "";
}

// Names of angular frequencies, in rad/s even if the column has no unit.
constexpr const char* kAngular[] = {"pulsazione",
                                    "frecuencia angular",
                                    "frequenza angolare",
                                    "frequência angular",
                                    "угловая частота",
                                    "круговая частота",
                                    "角周波数",
                                    "w",
                                    "ω",
                                    "omega",
                                    "angular frequency",
                                    "ang frequency",
                                    "angular freq",
                                    "ang freq",
                                    "kreisfrequenz",
                                    "pulsation",
                                    "角频率",
                                    "omega rad s",
                                    "frequency rad s",
                                    "angular frequency rad s",
                                    "omega 1 s",
                                    "angular frequency 1 s"};

bool is_angular(const std::string& name) {
  const std::string text = plain(name);
  return std::any_of(std::begin(kAngular), std::end(kAngular), [&](const std::string& known) {
    return (known.size() == 1 ? name : text) == known;
  });
}

std::vector<const char*> frequency_names() {
  std::vector<const char*> names{
      "f",          "freq",    "frequenz", "fréquence",     "频率",       "frequenza", "frecuencia",
      "frequência", "частота", "周波数",   "częstotliwość", "frequentie", "frekvens",  "주파수"};
  names.insert(names.end(), std::begin(kAngular), std::end(kAngular));
  return names;
}

// A unit as part of a name, without a slash: 1_Pa, 1_per_Pa, per_MPa.
std::string unit_in_name(const std::string& text) {
  for (const char* start : {"1_per_", "per_", "1_"}) {
    if (text.rfind(start, 0) == 0) return "1/" + text.substr(std::string(start).size());
  }
  return text;
}

// A force in "g" or "kg": the weight of that mass.
bool is_weight_unit(const std::string& unit) {
  return is_stated(unit) && is_unit_of(unit, "kg");
}

std::optional<UnitScale> scale_if_fits(const std::string& name, const std::string& unit,
                                       const ColumnKind& quantity) {
  if (quantity.is_text) return UnitScale{};
  if (std::string(quantity.unit.si) == "Hz" && is_angular(name)) {
    if (is_stated(unit) && unit != "rad/s" && unit != "1/s" && unit != "s-1") return std::nullopt;
    return UnitScale{0.5 / std::numbers::pi, 0.0};
  }
  if (!is_stated(unit)) {
    // An elongation is a strain or a length, and P a pressure or a load: their units say which.
    const bool needs_unit = plain(name) == "elongation" || name == "P";
    return needs_unit ? std::nullopt : std::optional(UnitScale{});
  }
  if (std::string(quantity.unit.si) == "N" && is_weight_unit(unit)) {
    constexpr double kStandardGravity_m_s2 = 9.80665;  // BIPM, The International System of Units
    return UnitScale{kStandardGravity_m_s2 * scale_to_si(unit, "kg").factor, 0.0};
  }
  if (!is_unit_of(unit, quantity.unit.si)) return std::nullopt;
  return scale_to_si(unit, quantity.unit.si);
}

bool is_unit_assumed(const CsvColumn& column, const ColumnKind& quantity) {
  const bool has_unit = !quantity.is_text && std::string(quantity.unit.si) != "1";
  return has_unit && !is_stated(column.unit) && !is_angular(column.name);
}

// What a test records over time.
std::vector<ColumnKind> recorded_kinds() {
  return {{"time_s",
           "time",
           quantities::kTime,
           {"t",          "elapsed time", "test time", "run time",     "step time", "seconds",
            "timestamp",  "time stamp",   "date time", "date/time",    "datetime",  "clock",
            "clock time", "zeit",         "prüfzeit",  "versuchszeit", "temps",     "tempo",
            "tiempo",     "время",        "时间",      "试验时间",     "测试时间",  "時間",
            "経過時間",   "試験時間",     "czas",      "tijd",         "tid",       "čas",
            "zaman",      "시간"}},
          {"force_N",
           "force",
           quantities::kForce,
           {"F",
            "load",
            "normal force",
            "standard force",
            "compressive load",
            "tensile load",
            "kraft",
            "normalkraft",
            "standardkraft",
            "prüfkraft",
            "force normale",
            "forza",
            "carico",
            "fuerza",
            "carga",
            "força",
            "сила",
            "нагрузка",
            "усилие",
            "力",
            "试验力",
            "载荷",
            "负荷",
            "法向力",
            "荷重",
            "試験力",
            "siła",
            "kracht",
            "síla",
            "kuvvet",
            "힘",
            "하중"}},
          {"depth_m",
           "depth",
           quantities::kLength,
           {"h",
            "indentation",
            "indentation depth",
            "displacement",
            "disp",
            "extension",
            "elongation",
            "penetration",
            "standard travel",
            "compressive extension",
            "compressive displacement",
            "tensile extension",
            "weg",
            "standardweg",
            "traversenweg",
            "eindringtiefe",
            "déplacement",
            "deplacement",
            "enfoncement",
            "profondeur",
            "spostamento",
            "profondità",
            "allungamento",
            "desplazamiento",
            "profundidad",
            "deslocamento",
            "перемещение",
            "глубина",
            "удлинение",
            "変位",
            "押込み深さ",
            "伸び",
            "位移",
            "压入深度",
            "深度",
            "przemieszczenie",
            "verplaatsing",
            "indringdiepte",
            "förskjutning",
            "posunutí",
            "yer değiştirme",
            "변위"}}};
}

// What is computed from force and geometry.
std::vector<ColumnKind> material_kinds() {
  return {
      {"modulus_Pa",
       "modulus",
       quantities::kModulus,
       {"E",
        "G",
        "e relax",
        "g relax",
        "e(t)",
        "g(t)",
        "relaxation modulus",
        "modul",
        "relaxationsmodul",
        "module",
        "module de relaxation",
        "modulo",
        "modulo di rilassamento",
        "módulo",
        "módulo de relajación",
        "módulo de relaxação",
        "модуль",
        "модуль релаксации",
        "модуль упругости",
        "模量",
        "松弛模量",
        "弹性模量",
        "杨氏模量",
        "弾性率",
        "ヤング率",
        "緩和弾性率",
        "moduł",
        "relaxatiemodulus",
        "탄성률",
        "완화탄성률"}},
      {"stress_Pa",
       "stress",
       quantities::kStress,
       {"sigma",      "σ",       "shear stress", "spannung",   "schubspannung",
        "contrainte", "sforzo",  "tau",          "τ",          "tensione",
        "esfuerzo",   "tensión", "tensão",       "напряжение", "应力",
        "剪切应力",   "応力",    "naprężenie",   "spanning",   "spänning",
        "napětí",     "gerilme", "응력"}},
      {"strain",
       "strain",
       quantities::kStrain,
       {"epsilon",
        "eps",
        "ε",
        "gamma",
        "γ",
        "shear strain",
        "nominal strain",
        "engineering strain",
        "dehnung",
        "nenndehnung",
        "technische dehnung",
        "scherung",
        "deformation",
        "déformation",
        "déformation nominale",
        "deformazione",
        "deformación",
        "deformação",
        "деформация",
        "应变",
        "剪切应变",
        "名义应变",
        "工程应变",
        "ひずみ",
        "歪み",
        "歪",
        "odkształcenie",
        "deformace",
        "rek",
        "töjning",
        "gerinim",
        "변형률",
        "eng strain",
        "elongation",
        "伸び率",
        "伸长率"}},
      {"nominal_stress_Pa",
       "nominal_stress",
       quantities::kStress,
       {"engineering stress", "eng stress", "pk1", "pk1 stress", "P",
        "first piola kirchhoff stress", "nennspannung", "contrainte nominale", "名义应力",
        "工程应力", "公称応力"}},
      {"true_stress_Pa",
       "true_stress",
       quantities::kStress,
       {"cauchy stress", "wahre spannung", "contrainte vraie", "sforzo reale", "esfuerzo real",
        "истинное напряжение", "真应力", "真応力"}},
      {"true_strain",
       "true_strain",
       quantities::kStrain,
       {"logarithmic strain", "log strain", "hencky strain", "wahre dehnung",
        "logarithmische dehnung", "déformation vraie", "deformazione reale", "deformación real",
        "истинная деформация", "真应变", "対数ひずみ", "真ひずみ"}},
      {"stretch",
       "stretch",
       quantities::kStretch,
       {"lambda", "λ", "stretch ratio", "extension ratio", "streckung", "伸长比"}},
      {"compliance_1_Pa",
       "compliance",
       quantities::kCompliance,
       {"J", "D", "j(t)", "d(t)", "creep compliance", "kriechnachgiebigkeit", "nachgiebigkeit",
        "complaisance", "cedevolezza", "complianza", "podatność", "податливость", "柔量",
        "コンプライアンス", "クリープコンプライアンス"}},
      {"relative_modulus",
       "relative_modulus",
       "1",
       {"g r(t)", "g r", "e/e0", "g/g0", "e(t)/e0", "g(t)/g0", "g(t)/g(0)", "e(t)/e(0)",
        "normalized modulus", "normalised modulus", "normalized relaxation modulus",
        "normalised relaxation modulus", "normalized shear modulus", "normalised shear modulus",
        "normierter modul", "module normalisé"}},
      {"frequency_Hz", "frequency", quantities::kFrequency, frequency_names()},
      {"storage_modulus_Pa",
       "storage_modulus",
       quantities::kModulus,
       {"E'",
        "G'",
        "ep",
        "gp",
        "e prime",
        "g prime",
        "e stor",
        "g stor",
        "storage",
        "speichermodul",
        "module de conservation",
        "modulo conservativo",
        "modulo di accumulo",
        "módulo de almacenamiento",
        "módulo de armazenamento",
        "модуль накопления",
        "储能模量",
        "貯蔵弾性率",
        "opslagmodulus",
        "moduł zachowawczy",
        "저장탄성률"}},
      {"loss_modulus_Pa",
       "loss_modulus",
       QuantityOrUnit::any("Pa"),
       {"E''",
        "G''",
        "epp",
        "gpp",
        "e double prime",
        "g double prime",
        "e loss",
        "g loss",
        "loss",
        "verlustmodul",
        "module de perte",
        "modulo dissipativo",
        "modulo di perdita",
        "módulo de pérdida",
        "módulo de perda",
        "модуль потерь",
        "损耗模量",
        "損失弾性率",
        "verliesmodulus",
        "moduł stratności",
        "손실탄성률"}},
      {"complex_modulus_Pa",
       "complex_modulus",
       quantities::kModulus,
       {"|e*|", "|g*|", "e*", "g*", "abs(e*)", "abs(g*)", "dynamic modulus", "komplexer modul",
        "module complexe", "modulo complesso", "módulo complejo", "комплексный модуль", "复数模量",
        "複素弾性率"}},
      {"complex_viscosity_Pa_s",
       "complex_viscosity",
       QuantityOrUnit::any("Pa s"),
       {"|eta*|", "|η*|", "eta*", "η*", "dynamic viscosity", "komplexe viskosität",
        "viscosité complexe", "viscosità complessa", "viscosidad compleja", "комплексная вязкость",
        "复数粘度", "複素粘度"}},
      {"phase_rad",
       "phase",
       QuantityOrUnit::any("rad"),
       {"delta", "δ", "phase angle", "phase lag", "loss angle", "phasenwinkel", "verlustwinkel",
        "angle de phase", "angolo di fase", "ángulo de fase", "фазовый угол", "相位角", "位相角",
        "位相差"}},
      {"tan_delta",
       "tan_delta",
       "1",
       {"tan(delta)", "tan(d)", "tan d", "tand", "tandelta", "tan δ", "tanδ", "tan(δ)",
        "loss factor", "loss tangent", "damping factor", "verlustfaktor", "facteur de perte",
        "fattore di perdita", "factor de pérdida", "тангенс угла потерь", "损耗因子", "損失正接"}}};
}

// What a calibration or a rig adds, and what divides a file.
std::vector<ColumnKind> rig_kinds() {
  return {{"mass_kg",
           "mass",
           quantities::kMass,
           {"m", "weight", "masse", "massa", "masa", "масса", "质量", "質量"}},
          {"volts_V",
           "volts",
           quantities::kVoltage,
           {"U", "V", "voltage", "reading", "output", "amplifier", "spannung", "tensione",
            "tensión", "tensão", "напряжение", "电压", "電圧"}},
          {"position_m", "position", quantities::kLength, {"z", "stage", "stage position", "位置"}},
          {"temperature_C",
           "temperature",
           quantities::kTemperature,
           {"T", "temp", "temperatur", "température", "temperatura", "температура", "温度"}},
          {"humidity",
           "humidity",
           "1",
           {"relative humidity", "rh", "r h", "luftfeuchte", "feuchte", "humidité", "umidità",
            "humedad", "влажность", "湿度"}},
          {"segment", "segment", "1", {"set", "phase", "step", "step name"}, true},
          {"specimen", "specimen", "1", {"specimen id", "specimen name"}, true}};
}

// Of a column of words: segment, specimen, phase.
bool names_a_part(const std::string& name) {
  const std::vector<ColumnKind> kinds = rig_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const ColumnKind& kind) {
    return kind.is_text && (plain(name) == plain(kind.base) || has_alias(kind, name));
  });
}

// force_mN, depth_um: the quantity's own name followed by a unit; storage_kPa, "Load mN": another name of it.
std::optional<HeaderMatch> match_unit_in_name(const std::string& name, const ColumnKind& quantity) {
  const std::string base = std::string(quantity.base) + "_";
  const bool is_own = name.rfind(base, 0) == 0;
  const std::size_t at = is_own ? base.size() - 1 : name.find_last_of("_ ");
  if (at == std::string::npos) return std::nullopt;
  const std::string head = name.substr(0, at), unit = unit_in_name(name.substr(at + 1));
  const bool is_named = is_own || plain(head) == plain(quantity.base) || has_alias(quantity, head);
  if (!is_stated(unit) || !is_named) return std::nullopt;
  const auto scale = scale_if_fits(is_own ? quantity.base : head, unit, quantity);
  if (!scale) return std::nullopt;
  const bool is_weight = std::string(quantity.unit.si) == "N" && is_weight_unit(unit);
  return HeaderMatch{is_own ? 2 : 1, *scale, false, is_weight};
}

}  // namespace

const std::vector<ColumnKind>& column_kinds() {
  static const std::vector<ColumnKind> kKinds = [] {
    std::vector<ColumnKind> all;
    for (const auto& group : {recorded_kinds(), material_kinds(), rig_kinds()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return kKinds;
}

const ColumnKind& column_kind(const std::string& name) {
  for (const ColumnKind& quantity : column_kinds()) {
    if (name == quantity.name) return quantity;
  }
  throw std::invalid_argument("there is no quantity '" + name + "'");
}

std::optional<HeaderMatch> match_header(const CsvColumn& column, const ColumnKind& quantity) {
  if (column.name.empty()) return std::nullopt;
  if (column.header == quantity.name || column.name == quantity.name) {
    const auto scale = scale_if_fits(column.name, column.unit, quantity);
    // A name that ends in one unit above a row with another contradicts itself, so the column is
    // not used unless --column names it.
    const bool names_unit = std::string(quantity.name) != quantity.base;
    const bool is_si = scale && scale->factor == 1.0 && scale->offset == 0.0;
    if (!scale || (names_unit && !is_si)) return std::nullopt;
    return HeaderMatch{3, *scale};
  }
  // The column phase of a capture holds words, an angle does not.
  const bool is_text =
      !column.text.empty() && std::all_of(column.values.begin(), column.values.end(),
                                          [](double value) { return std::isnan(value); });
  if (is_text && !quantity.is_text && names_a_part(column.name)) return std::nullopt;
  // tau is a relaxation time, too.
  const bool is_tau = column.name == "tau" || column.name == "τ";
  if (is_tau && !is_stated(column.unit)) return std::nullopt;
  if (!quantity.is_text && !is_stated(column.unit)) {
    // Before symbols in a name are looked for: the g of mass_g is its unit.
    if (const auto found = match_unit_in_name(column.name, quantity)) return found;
  }
  const bool is_own_name = plain(column.name) == plain(quantity.base);
  const std::string rest = quantity.is_text ? "" : without_kind_and_symbol(column.name);
  const bool is_named_inside =
      rest.size() > 1 && (rest == plain(quantity.base) || has_alias(quantity, rest));
  if (!is_own_name && !is_named_inside && !has_alias(quantity, column.name)) return std::nullopt;
  const auto scale = scale_if_fits(column.name, column.unit, quantity);
  if (!scale) return std::nullopt;
  const bool is_weight = std::string(quantity.unit.si) == "N" && is_weight_unit(column.unit);
  return HeaderMatch{is_own_name ? 2 : 1, *scale, is_unit_assumed(column, quantity), is_weight};
}

bool is_stated(const std::string& unit) {
  return !unit.empty() && unit != "-";
}

const std::vector<std::string>& column_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const ColumnKind& quantity : column_kinds()) names.emplace_back(quantity.name);
    return names;
  }();
  return kNames;
}

}  // namespace viscard
