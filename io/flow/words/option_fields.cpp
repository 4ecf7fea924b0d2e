#include "io/flow/words/option_fields.h"

namespace viscard {

OptionFields option_fields(FitWords& words) {
  OptionFields fields;
  fields.texts = {{"kind", &words.kind},
                  {"noise", &words.noise},
                  {"model", &words.model},
                  {"constraints", &words.constraints},
                  {"vertical-shift", &words.vertical_shift},
                  {"sheet", &words.sheet},
                  {"time-zero", &words.time_zero},
                  {"from", &words.from},
                  {"to", &words.to},
                  {"crop", &words.crop},
                  {"depth", &words.depth},
                  {"specimen", &words.specimen},
                  {"punch-diameter", &words.punch_diameter},
                  {"layer-thickness", &words.layer_thickness},
                  {"frame-stiffness", &words.frame_stiffness},
                  {"reference-temperature", &words.reference_temperature},
                  {"density", &words.density},
                  {"plausible", &words.plausible}};
  fields.flags = {{"liquid", &words.liquid},
                  {"solid", &words.solid},
                  {"allow-negative", &words.allow_negative},
                  {"drift", &words.drift},
                  {"no-drift", &words.no_drift},
                  {"full-data", &words.full_data},
                  {"profiles", &words.profiles},
                  {"diagnose", &words.diagnose},
                  {"joint", &words.joint},
                  {"own-terms", &words.own_terms}};
  fields.lists = {{"fix", &words.fix},       {"bound", &words.bound},
                  {"column", &words.column}, {"segment", &words.segment},
                  {"share", &words.share},   {"specimen-id", &words.specimen_id}};
  fields.whole_numbers = {{"terms", &words.terms},
                          {"max-terms", &words.max_terms},
                          {"bootstrap", &words.bootstrap},
                          {"hold", &words.hold}};
  return fields;
}

OptionFields option_fields(PredictWords& words) {
  OptionFields fields;
  fields.texts = {{"test", &words.test},
                  {"strain", &words.strain},
                  {"stress", &words.stress},
                  {"ramp", &words.ramp},
                  {"hold", &words.hold},
                  {"recovery", &words.recovery},
                  {"period", &words.period},
                  {"from", &words.from},
                  {"to", &words.to},
                  {"history", &words.history},
                  {"driven-by", &words.driven_by},
                  {"against", &words.against},
                  {"time-zero", &words.time_zero},
                  {"temperature", &words.temperature},
                  {"plausible", &words.plausible}};
  fields.lists = {{"column", &words.column}};
  fields.whole_numbers = {{"cycles", &words.cycles}, {"points", &words.points}};
  return fields;
}

}  // namespace viscard
