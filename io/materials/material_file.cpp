#include "io/materials/material_file.h"

#include "io/basics/atomic_file.h"
#include "io/basics/file_kind.h"
#include "io/basics/inputs.h"
#include "io/basics/json_string.h"
#include "io/basics/written_path.h"
#include "io/materials/material_json.h"
#include "io/materials/plausible_numbers.h"

namespace viscard {

MaterialFile material_from_json(const std::string& text, const std::string& name,
                                Plausible judged) {
  MaterialFile file = read_as(FileKind::kMaterial, text, name, [&] {
    const Json json = parse_json(text, name);
    MaterialFile read{material_from(json, name), text};
    if (is_edited(json, name)) read.material.flags.push_back({kEdited, 0, kEditedText});
    return read;
  });
  try {
    validate(file.material);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
  for (const MaterialFlag& flag : file.material.flags) {
    if (is_doubt_of_record(flag)) note_input(name, flag.text);
  }
  if (judged == Plausible::kOff) flag_plausible_off(file.material.flags);
  if (!accepts_implausible(file.material.flags)) refuse_implausible(name, file.material, judged);
  return file;
}

MaterialFile read_material(const std::filesystem::path& path, Plausible judged) {
  return material_from_json(read_file(path), path.string(), judged);
}

namespace {

// Without folders where the user wants none.
Material as_written(Material material) {
  write_paths_of(material.provenance.raw_files);
  for (MaterialFlag& flag : material.flags) flag.text = written_text(flag.text);
  return material;
}

}  // namespace

std::string json_from_material(const MaterialFile& file) {
  validate(file.material);
  Json out = json_from(as_written(file.material));
  if (!file.original_json.empty()) {
    carry_unknown_keys(parse_json(file.original_json, "the material it was read from"), out);
  }
  try {
    add_body_sum(out);
    return text_from_json(out, 2) + "\n";
  } catch (const Json::exception&) {
    throw std::invalid_argument("material '" + file.material.name +
                                "' contains text that is not UTF-8 and cannot be written as JSON; "
                                "give the file it was fitted from a name in UTF-8, or correct its "
                                "name, flags and provenance");
  }
}

std::string json_from_material(const Material& material) {
  return json_from_material(MaterialFile{material, ""});
}

}  // namespace viscard
