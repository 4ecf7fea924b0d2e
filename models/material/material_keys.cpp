#include "models/material/material.h"
#include "models/maths/result_visitor.h"

namespace viscard {

void show_keys(ResultVisitor& v, const MaterialFlag& flag) {
  v("name", flag.name, "name of the flag");
  v.when(flag.term > 0, [&] { v("term", flag.term, "number of the term, from 1"); });
  v("text", flag.text, "the flag in words");
}

}  // namespace viscard
