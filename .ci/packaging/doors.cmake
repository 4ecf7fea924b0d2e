# Headers that programs which use viscard as a library include. What they include is installed with them
# and may change; these keep their names.
set(VISCARD_DOORS
    io/flow/capture_setup.h io/flow/capture_to_file.h io/flow/table_from_capture.h  # a run on a rig
    io/tables/csv_table.h io/flow/fit_table.h io/flow/fit_file.h                    # data to a fit
    io/materials/material_file.h io/basics/atomic_file.h                            # material files
    io/flow/predict_file.h models/pillar/validate_material.h                        # what a material does
    io/flow/card_material.h io/cards/card.h io/cards/targets/card_targets.h         # solver cards
    io/scenes/scene_file.h models/scene/plan.h models/scene/simulate.h              # scenes
    io/cost/study_cost.h)
