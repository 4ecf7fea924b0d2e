#pragma once

#include <string>

namespace viscard {

// Markdown: what each target does with each part of a material, "exact", "approximate" by how much, or
// "refused". Nothing is typed in but the analyses over frequency: cards of an example are written,
// and what their headers state is read off. viscard card --list --long prints it; tests compare its cells
// with what writing, refusing and --check do.
std::string target_table();

}  // namespace viscard
