#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// One .h or .cpp file of models, fit, rig or io.
struct SourceFile {
  std::string path;  // from the root: "fit/search/nnls.h"
  std::string text;
  std::vector<std::string> includes;          // in quotes, as written
  std::vector<std::string> outside_includes;  // in angle brackets
  int n_lines = 0;
};

// A folder whose CMakeLists.txt calls viscard_room().
struct Room {
  std::set<std::string> uses;       // folders that stand behind USES
  std::vector<std::string> readme;  // lines; empty without a README.md
};

struct SourceTree {
  std::map<std::string, SourceFile> files;  // by path
  std::map<std::string, Room> rooms;        // by folder
};

// Throws std::runtime_error when a file cannot be read.
SourceTree read_source_tree(const std::string& root);

std::string folder_of(const std::string& path);
std::string without_suffix(const std::string& path);
bool has_suffix(const std::string& path, const std::string& suffix);
std::vector<std::string> lines_of(const std::string& text);

// Arrows from each node to others.
using Graph = std::map<std::string, std::set<std::string>>;

// Rooms, and what each may include.
Graph graph_of_rooms(const SourceTree& tree);
// Pairs x.h and x.cpp as one node "x", and what they include.
Graph graph_of_files(const SourceTree& tree);

// Everything that can be reached from each node.
Graph closure(const Graph& graph);
// The nodes that can be reached from themselves.
std::vector<std::string> nodes_on_circles(const Graph& graph);

}  // namespace viscard
