#include "models/array/plane/array_analysis.h"
#include "models/array/plane/array_modes.h"
#include "models/maths/text_of_number.h"

#include <stdexcept>

namespace viscard {
namespace {

const RowModal& row_modal_drive(const ArrayScene& scene) {
  return std::get<RowModal>(scene.drive);
}

std::vector<std::string> row_modal_names(const ArrayScene&) {
  return {"frequency", "lateral", "longitudinal"};
}

SceneAnswer run_row_modal(const ArrayScene& scene, const Discretisation& mesh) {
  const ArrayMedia media = media_of(scene);
  const ArrayModel model =
      model_of(scene, mesh, {.modes = inertia_ports_for(row_modal_drive(scene).modes)});
  SceneAnswer answer;
  answer.discretisation = mesh;
  answer.unknowns = model.unknowns();
  const std::vector<ArrayMode> modes = array_modes(model, row_modal_drive(scene).modes);
  answer.step_error = film_inertia_error(model, media, modes);
  const int repeats = scene.feels_neighbours ? 1 : scene.geometry.count;
  for (const bool is_lateral : {true, false}) {
    for (const ArrayMode& mode : modes) {
      if (mode.is_lateral != is_lateral) continue;
      answer.modes.insert(answer.modes.end(), static_cast<std::size_t>(repeats),
                          {is_lateral ? "lateral" : "longitudinal", 0, mode.frequency_Hz, 0.0});
    }
  }
  return answer;
}

void refuse_film_modes(const ArrayScene& scene, const SceneAnswer& answer) {
  refuse_moving_film(scene, answer.step_error, "the frequencies", "fewer modes");
}

PillarDrive row_modal_alone(const ArrayScene& scene) {
  return ModalDrive{.modes = row_modal_drive(scene).modes};
}

}  // namespace

ArrayAnalysis array_modal_analysis() {
  return {.name = "modal",
          .drive = RowModal{},
          .has_inertia = true,
          .is_loaded = false,
          .result_names = row_modal_names,
          .run = run_row_modal,
          .check_answer = refuse_film_modes,
          .alone = row_modal_alone};
}

}  // namespace viscard
