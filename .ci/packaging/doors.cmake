# Headers that programs which use viscard as a library include. What they include is installed with them
# and may change; these keep their names.
set(VISCARD_DOORS
    io/flow/capture_setup.h io/flow/capture_to_file.h io/flow/table_from_capture.h  # a run on a rig
    io/tables/csv_table.h io/flow/fit_table.h io/flow/fit_file.h                    # data to a fit
    io/materials/material_file.h io/basics/atomic_file.h                            # material files
    io/flow/predict_file.h models/pillar/validate_material.h                        # what a material does
    io/flow/card_material.h io/cards/card.h io/cards/targets/card_targets.h         # solver cards
    io/flow/large_strain/large_strain_words.h io/materials/hyperelastic_file.h      # tests at large strain
    io/cards/hyperelastic/rubber_file_card.h                                        # and cards of their laws
    io/scenes/scene_file.h models/scene/plan.h models/scene/simulate.h              # scenes
    io/cost/study_cost.h)

# public_headers(SOURCE OUT): these and every header of ours that they include, however deep.
function(public_headers source out)
  set(waiting ${VISCARD_DOORS})
  set(headers "")
  while(waiting)
    list(POP_FRONT waiting header)
    if(header IN_LIST headers)
      continue()
    endif()
    list(APPEND headers ${header})
    file(STRINGS "${source}/${header}" includes REGEX "^#include \"")
    list(TRANSFORM includes REPLACE "^#include \"([^\"]+)\".*" "\\1")
    list(APPEND waiting ${includes})
  endwhile()
  list(SORT headers)
  set(${out} ${headers} PARENT_SCOPE)
endfunction()
