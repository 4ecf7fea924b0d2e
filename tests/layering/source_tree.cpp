#include "tests/layering/source_tree.h"

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace viscard {
namespace {

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

SourceFile source_file(const fs::path& root, const fs::path& path) {
  SourceFile file;
  file.path = fs::relative(path, root).generic_string();
  file.text = text_of(path);
  const std::vector<std::string> lines = lines_of(file.text);
  file.n_lines = static_cast<int>(lines.size());
  static const std::regex kInclude(R"re(^#include (["<])([^">]+)[">])re");
  for (const std::string& line : lines) {
    std::smatch match;
    if (!std::regex_search(line, match, kInclude)) continue;
    (match[1] == "\"" ? file.includes : file.outside_includes).push_back(match[2]);
  }
  return file;
}

// The words behind USES up to the next keyword or the closing bracket.
std::set<std::string> uses_of(const std::string& cmake) {
  const std::size_t call = cmake.find("viscard_room(");
  const std::string body = cmake.substr(call, cmake.find(')', call) - call);
  std::istringstream words(body.substr(0, body.find("\nset_")));
  std::set<std::string> uses;
  bool is_behind_uses = false;
  for (std::string word; words >> word;) {
    if (word == "USES") {
      is_behind_uses = true;
    } else if (word == "LIBRARIES" || word == "PRIVATE" || word == "SOURCES") {
      is_behind_uses = false;
    } else if (is_behind_uses) {
      uses.insert(word);
    }
  }
  return uses;
}

void add_room(const fs::path& root, const fs::path& cmake_file, SourceTree& tree) {
  const std::string cmake = text_of(cmake_file);
  if (cmake.find("viscard_room(") == std::string::npos) return;
  Room room;
  room.uses = uses_of(cmake);
  const fs::path readme = cmake_file.parent_path() / "README.md";
  if (fs::exists(readme)) room.readme = lines_of(text_of(readme));
  tree.rooms[fs::relative(cmake_file.parent_path(), root).generic_string()] = room;
}

void reach(const Graph& graph, const std::string& from, std::set<std::string>& reached) {
  const auto arrows = graph.find(from);
  if (arrows == graph.end()) return;
  for (const std::string& to : arrows->second) {
    if (reached.insert(to).second) reach(graph, to, reached);
  }
}

}  // namespace

SourceTree read_source_tree(const std::string& root) {
  SourceTree tree;
  for (const char* folder : {"models", "fit", "rig", "io"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(root) / folder)) {
      const std::string name = entry.path().filename().string();
      if (name == "CMakeLists.txt") add_room(root, entry.path(), tree);
      if (!has_suffix(name, ".h") && !has_suffix(name, ".cpp")) continue;
      SourceFile file = source_file(root, entry.path());
      tree.files[file.path] = file;
    }
  }
  return tree;
}

std::string folder_of(const std::string& path) {
  return path.substr(0, path.rfind('/'));
}

std::string without_suffix(const std::string& path) {
  return path.substr(0, path.rfind('.'));
}

bool has_suffix(const std::string& path, const std::string& suffix) {
  return path.size() >= suffix.size() &&
         path.compare(path.size() - suffix.size(), suffix.size(), suffix) == 0;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Graph graph_of_rooms(const SourceTree& tree) {
  Graph graph;
  for (const auto& [folder, room] : tree.rooms) graph[folder] = room.uses;
  return graph;
}

Graph graph_of_files(const SourceTree& tree) {
  Graph graph;
  for (const auto& [path, file] : tree.files) {
    std::set<std::string>& arrows = graph[without_suffix(path)];
    for (const std::string& include : file.includes) {
      if (without_suffix(include) != without_suffix(path)) arrows.insert(without_suffix(include));
    }
  }
  return graph;
}

Graph closure(const Graph& graph) {
  Graph reached;
  for (const auto& [node, arrows] : graph) reach(graph, node, reached[node]);
  return reached;
}

std::vector<std::string> nodes_on_circles(const Graph& graph) {
  std::vector<std::string> nodes;
  for (const auto& [node, reached] : closure(graph)) {
    if (reached.count(node) > 0) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace viscard
