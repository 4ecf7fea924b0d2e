// Scenes that contradict themselves or are incomplete: one line, with the line of the file.
#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <algorithm>

using namespace viscard;
using namespace viscard::test;

namespace {

const char* const kPillar = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
film = { thickness = "25 um", radius = "60 um", material = "pvdf" }
electrode = { face = "top", radius = "20 um" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_film_manual.json" }
[analysis]
kind = "static"
load = { pressure = "10 kPa", on = "top" }
[want]
quantities = ["electrode_voltage"]
)";

const char* const kCreep = R"(tolerance = 1e-3
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { file = "DATA/materials/pdms_1to10_seed.json" }
[analysis]
kind = "creep"
history = [
  ["0 s", "0 Pa"],
  ["1 s", "10 kPa"],
  ["10 s", "10 kPa"],
]
)";

const char* const kArray = R"(tolerance = 1e-3
[geometry]
kind = "row"
count = 8
diameter = "40 um"
length = "120 um"
spacing = "60 um"
film = { thickness = "25 um", edge = "100 um", material = "pvdf" }
electrode = { face = "bottom", kind = "sampled", radius = "20 um" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top", pillars = [4] }
[want]
quantities = ["centre_voltage", "crosstalk_percent"]
)";

const char* const kSpace = R"(tolerance = 1e-3
[geometry]
kind = "array"
model = "space"
rows = 8
columns = 8
diameter = "40 um"
length = "120 um"
spacing = "60 um"
dead = [[3, 7]]
classes = [{ pillars = [[1, 1]], length = "110 um" }]
film = { thickness = "25 um", edge = "150 um", material = "pvdf" }
electrode = { face = "bottom", kind = "sampled", radius = "20 um" }
[materials]
pillar = { E = "1.8 MPa", nu = 0.33, rho = "965 kg/m3" }
pvdf = { file = "DATA/materials/pvdf_seed.json" }
[analysis]
kind = "static"
load = { pressure = "1 kPa", shear_x = "10 Pa", pillars = [[4, 4]] }
[want]
quantities = ["centre_voltage", "crosstalk_percent_4_5"]
)";

struct Mistake {
  const char *from, *to;
  int line;          // of the file
  const char* what;  // words of the message
};

void check_refused(const std::string& text, const Mistake& mistake) {
  CAPTURE(mistake.from, mistake.to);
  const SceneText scene(replaced(text, mistake.from, mistake.to));
  for (const char* const command : {"scene", "plan", "simulate"}) {
    std::vector<std::string> words = {command, scene.path()};
    if (words[0] == "scene") words.insert(words.begin() + 1, "check");
    const CommandOutcome outcome = run_command(words);
    CAPTURE(command, outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("scene.toml:" + std::to_string(mistake.line) + ":") !=
          std::string::npos);
    CHECK(outcome.err.find(mistake.what) != std::string::npos);
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  }
}

}  // namespace

TEST_CASE("a contradictory scene of one pillar is refused by every command with its line",
          "[cli][scene]") {
  check_refused(
      kPillar,
      GENERATE(
          Mistake{"1e-3", "0", 1, "tolerance"}, Mistake{"1e-3", "2", 1, "between 1e-9 and 1"},
          Mistake{"\"40 um\"", "\"-40 um\"", 3, "diameter"},
          Mistake{"\"120 um\"", "\"120 kg\"", 4, "length"},
          Mistake{"length =", "lenght =", 4, "did you mean 'length'"},
          Mistake{"thickness = \"25 um\"", "thickness = \"0 um\"", 5, "thickness"},
          Mistake{"radius = \"20 um\"", "radius = \"90 um\"", 6, "electrode"},
          Mistake{"\"pvdf\" }", "\"pvdf\", bottom = \"free\" }", 5, "nothing holds"},
          Mistake{"kind = \"static\"\n", "kind = \"static\"\ntop = \"plate\"\n", 12,
                  "only buckling"},
          Mistake{"kind = \"static\"\n", "kind = \"buckling\"\ntop = \"plat\"\n", 12,
                  "did you mean 'plate'"},
          Mistake{"face = \"top\", ", "", 6, "needs the film's face"},
          Mistake{"pvdf = {", "pvfd = {", 9, "materials.pvfd"},
          Mistake{"{ file = \"DATA/materials/pvdf_film_manual.json\" }",
                  "{ E = \"2 GPa\", nu = 0.7 }", 9, "Poisson"},
          Mistake{"\"120 um\"\n", "\"120 um\"\nfoot = { width = \"5 um\" }\n", 5, "needs a height"},
          Mistake{"\"120 um\"\n", "\"120 um\"\nfoot = { width = \"5 um\", height = \"130 um\" }\n",
                  5, "more than the pillar"},
          Mistake{"kind = \"static\"\nload = { pressure = \"10 kPa\"",
                  "kind = \"modal\"\nload = { voltage = \"1 V\"", 12, "only static"},
          Mistake{"[want]", "[discretisation]\nkind = \"h1\"\nelement_size = \"10 nm\"\n[want]", 15,
                  "unknowns"},
          Mistake{"\"pvdf\" }", "\"pvdf\", bottom = \"loose\" }", 5, "fixed, free"},
          Mistake{"\"120 um\"\n", "\"120 um\"\nbottom = \"free\"\n", 5, "the film's braces"},
          Mistake{"face = \"top\"", "face = \"side\"", 6, "bottom, top"},
          Mistake{"nu = 0.33", "nu = 0.51", 8, "Poisson"},
          Mistake{"thickness = \"25 um\"", "thickness = \"1 pm\"", 5, "a millionth"},
          Mistake{"face = \"top\", radius = \"20 um\"",
                  "face = \"top\", kind = \"sampled\", radius = \"30 um\"", 6, "leave the radius"},
          Mistake{"\"965 kg/m3\"", "\"-1 kg/m3\"", 8, "rho"},
          Mistake{"[want]", "frequencies = { from = \"1 Hz\" }\n[want]", 13, "does not use it"},
          Mistake{"[want]", "history = [[\"0 s\", \"1 kPa\"], [\"1 s\", \"1 kPa\"]]\n[want]", 13,
                  "a static analysis does not use it (relaxation, creep, transient)"},
          Mistake{"[want]", "pulse = { height = \"1 kPa\", duration = \"1 s\" }\n[want]", 13,
                  "does not use it"},
          Mistake{"[want]", "end_time = \"1 s\"\n[want]", 13, "does not use it"},
          Mistake{"kind = \"static\"", "kind = \"statics\"", 11, "did you mean 'static'"},
          Mistake{", on = \"top\"", "", 12, "no place"},
          Mistake{"on = \"top\"", "on = \"base\"", 12, "shake the base"},
          Mistake{"pressure = \"10 kPa\"", "pressure = \"0 kPa\"", 12, "needs a pressure"},
          Mistake{"pressure = \"10 kPa\"", "pressure = \"40 kPa\"", 12, "buckling"},
          Mistake{"pressure = \"10 kPa\"", "displacement = \"-1\"", 12, "no unit"},
          Mistake{"pressure = \"10 kPa\"", "displacement = \"-9 um\"", 12, "foot and the plate"},
          Mistake{"pressure =", "displacement = \"-1 um\", pressure =", 12, "give one of"},
          Mistake{"kind = \"static\"\nload = { pressure = \"10 kPa\"",
                  "kind = \"modal\"\nload = { displacement = \"-1 um\"", 12, "only static"},
          Mistake{"\"electrode_voltage\"", "\"electrode_voltag\"", 14,
                  "did you mean 'electrode_voltage'"},
          Mistake{"\"electrode_voltage\"", "\"base_stress_max\"", 14, "infinite"},
          Mistake{"\"electrode_voltage\"", "\"crosstalk_percent\"", 14,
                  "It has: electrode_voltage"},
          Mistake{"[want]", "[effects]\nfinite_strain = \"on\"\n[want]", 14, "cannot be on"},
          Mistake{"[want]", "[effects]\nfilm_compliance = \"off\"\n[want]", 14, "cannot be off"},
          Mistake{"[want]", "[effects]\ninertai = \"on\"\n[want]", 14, "did you mean 'inertia'"},
          Mistake{"[want]", "[effects]\ninertia = \"maybe\"\n[want]", 14, "auto, off, on"}));
}

TEST_CASE("a history that cannot be is refused with the line of its point", "[cli][scene]") {
  check_refused(
      kCreep,
      GENERATE(
          Mistake{"\"120 um\"\n", "\"120 um\"\nbottom = \"free\"\n", 5, "nothing holds"},
          Mistake{"kind = \"creep\"\n",
                  "kind = \"creep\"\nload = { pressure = \"5 kPa\", on = \"top\" }\n", 9,
                  "stands in its history"},
          Mistake{"[\"10 s\",", "[\"0.5 s\",", 12, "goes back in time, from 1 s"},
          Mistake{"[\"0 s\",", "[\"-1 s\",", 10, "goes back in time"},
          Mistake{"[\"0 s\", \"0 Pa\"],", "[\"0.5 s\", \"0 Pa\"],", 9, "starts at 0 s"},
          Mistake{"\"10 kPa\"],\n  [", "\"10 m\"],\n  [", 11, "history"},
          Mistake{"\"10 kPa\"],\n  [", "\"60 kPa\"],\n  [", 9, "buckling"},
          Mistake{"[analysis]", "[effects]\ninertia = \"on\"\n[analysis]", 8, "cannot be on"}));
}

TEST_CASE("a contradictory row of pillars is refused by every command with its line",
          "[cli][scene][array]") {
  check_refused(
      kArray,
      GENERATE(
          Mistake{"1e-3", "0", 1, "tolerance"}, Mistake{"1e-3", "1e-9", 1, "1e-7"},
          Mistake{"kind = \"row\"", "kind = \"arrray\"", 3, "did you mean 'array'"},
          Mistake{"kind = \"row\"\n", "", 2, "kind = \"row\""},
          Mistake{"count = 8", "count = 0", 4, "count"},
          Mistake{"length =", "lenght =", 6, "did you mean 'length'"},
          Mistake{"spacing = \"60 um\"", "spacing = \"-5 um\"", 7, "spacing"},
          Mistake{"edge = \"100 um\"", "edg = \"100 um\"", 8, "did you mean 'edge'"},
          Mistake{"radius = \"20 um\"", "radius = \"55 um\"", 9, "overlap"},
          Mistake{"edge = \"100 um\"", "edge = \"-2 um\"", 8, "edge"},
          Mistake{"nu = 0.33", "nu = 0.7", 11, "Poisson"},
          Mistake{"{ file = \"DATA/materials/pvdf_seed.json\" }", "{ E = \"2 GPa\", nu = 0.7 }", 12,
                  "Poisson"},
          Mistake{", on = \"top\"", "", 15, "no place"},
          Mistake{"on = \"top\"", "on = \"base\"", 15, "top"},
          Mistake{"pressure = \"1 kPa\"", "pressure = \"1 kPa\", shear = \"1 kPa\"", 15, "both"},
          Mistake{"pressure = \"1 kPa\"", "pressure = \"60 kPa\"", 15, "buckle"},
          Mistake{"[4]", "[9]", 15, "no pillar 9"}, Mistake{"[4]", "[]", 15, "names no pillar"},
          Mistake{"[4]", "[2, 4, 2]", 15, "named twice"}, Mistake{"[4]", "[1.5]", 15, "numbers"},
          Mistake{"\"centre_voltage\"", "\"centre_voltag\"", 17, "did you mean 'centre_voltage'"},
          Mistake{"\"centre_voltage\"", "\"electrode_voltage\"", 17, "It has: "},
          Mistake{"\"centre_voltage\"", "\"centre_voltage_9\"", 17, "no pillar 9"}));
}

TEST_CASE("a contradictory array in the plane is refused by every command with its line",
          "[cli][scene][array]") {
  check_refused(
      kSpace,
      GENERATE(
          Mistake{"1e-3", "1e-8", 1, "between 1e-6 and 1"},
          Mistake{"\"space\"", "\"spaces\"", 4, "did you mean 'space'"},
          Mistake{"\"array\"", "\"row\"", 4, "model"},
          Mistake{"rows = 8", "rows = 0", 5, "whole number from 1 to 1000"},
          Mistake{"rows = 8\n", "", 2, "needs rows and columns"},
          Mistake{"columns = 8", "count = 8", 6, "there is no key 'geometry.count'"},
          Mistake{"columns = 8", "columns = 8\nlattice = \"hexagon\"", 7,
                  "did you mean 'hexagonal'"},
          Mistake{"columns = 8", "columns = 8\npositions = \"a.csv\"", 7, "leave out rows"},
          Mistake{"spacing = \"60 um\"\n", "", 2, "needs the spacing"},
          Mistake{"spacing = \"60 um\"", "spacing = \"3 um\"", 9, "a tenth of their diameter"},
          Mistake{"[[3, 7]]", "[[3, 9]]", 10, "no pillar [3, 9]"},
          Mistake{"[[3, 7]]", "[[0, 7]]", 10, "from 1"},
          Mistake{"[[3, 7]]", "[3, 7]", 10, "list of pairs"},
          Mistake{"[[1, 1]]", "[[1, 1], [1, 1]]", 11, "two classes"},
          Mistake{"pillars = [[1, 1]], ", "", 11, "names no pillars"},
          Mistake{"length = \"110 um\"", "material = \"soft\"", 14, "materials.soft: needs E"},
          Mistake{"edge = \"150 um\"", "edge = \"-1 um\"", 12, "edge"},
          Mistake{"kind = \"sampled\"", "kind = \"sample\"", 13,
                  "There are: equipotential, sampled"},
          Mistake{"face = \"bottom\"", "face = \"top\"", 13, "write kind = \"equipotential\""},
          Mistake{"radius = \"20 um\"", "radius = \"60 um\"", 13, "overlap"},
          Mistake{"nu = 0.33", "nu = 0.7", 15, "Poisson"},
          Mistake{"{ file = \"DATA/materials/pvdf_seed.json\" }", "{ E = \"2 GPa\", nu = 0.3 }", 12,
                  "must be piezoelectric"},
          Mistake{"kind = \"static\"", "kind = \"modal\"", 18, "cannot be 'modal'"},
          Mistake{"pressure = \"1 kPa\", shear_x = \"10 Pa\", ", "", 19,
                  "needs a pressure or a shear"},
          Mistake{"pressure = \"1 kPa\"", "pressure = \"40 kPa\"", 19, "pillar [4, 4] buckles"},
          Mistake{"[[4, 4]]", "[[4, 9]]", 19, "columns from 1 to 8"},
          Mistake{"[[4, 4]]", "[[3, 7]]", 19, "is dead"},
          Mistake{"[[4, 4]]", "[[4, 4], [4, 4]]", 19, "named twice"},
          Mistake{"[[4, 4]]", "[[4.5, 4]]", 19, "rows and columns"},
          Mistake{"\"centre_voltage\"", "\"centre_voltag\"", 21, "did you mean 'centre_voltage'"},
          Mistake{"\"centre_voltage\"", "\"quadrant_1_voltage\"", 21, "It has: "},
          Mistake{"percent_4_5", "percent_4", 21, "by its row and column"},
          Mistake{"percent_4_5", "percent_3_7", 21, "no pillar in row 3 and column 7"},
          Mistake{"percent_4_5", "percent_4_4", 21, "without load"},
          Mistake{"[want]", "[effects]\ncrosstalk = \"off\"\n[want]", 21, "cannot be off"}));
}
