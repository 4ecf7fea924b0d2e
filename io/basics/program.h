// Which program wrote a file: version and state of the source.
#pragma once

#include <string>

namespace viscard {

// "0.1.0+b097c372f1": version and commit in the form of semver.org 2.0.0, item 10. The commit is that
// of the source when it was compiled: "+b097c372f1.modified" if files differed from it, "+no.commit"
// if the source had no history (a tarball) and the build stated none with -DVISCARD_COMMIT=.
std::string program_version();

// "viscard 0.1.0+b097c372f1": what stands in files as their author.
std::string program_with_version();

}  // namespace viscard
