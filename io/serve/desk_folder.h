#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// What may lie in the folder of a desk.
inline constexpr std::size_t kLargestDrop_B = std::size_t{64} << 20;
inline constexpr std::size_t kMostDeskFiles = 500;
// The first line of a scene that the desk wrote and may write again begins so.
inline constexpr const char* kSceneHead = "# Scene kept by viscard desk";

// A table or capture of the folder.
struct DeskTable {
  std::string name;
  std::uintmax_t bytes = 0;
  bool is_capture = false;
};

// The folder whose tables a desk shows. It is read again for each request; a name in a request must be one
// of the folder's own and never becomes a path by itself.
class DeskFolder {
 public:
  // Throws std::runtime_error if it does not exist and cannot be made.
  explicit DeskFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  // Why nothing can be written to it, or "".
  std::string trouble() const;
  // By name; the first kMostDeskFiles of them.
  std::vector<DeskTable> tables() const;
  // Throws ApiError 404 unless it is one of tables().
  void require_table(const std::string& name) const;
  // Writes a file under the last part of this name, or, if that is taken, under a numbered one, and returns the
  // name. Throws ApiError 400 for a name that no file of a table may have, 409 if the folder is full.
  std::string drop(const std::string& name, const std::string& bytes) const;

  // Scene files of the folder, by name.
  std::vector<std::string> scenes() const;
  // Throws ApiError 404 unless it is one of scenes().
  void require_scene(const std::string& name) const;
  // This name or, if that is taken, the first numbered one that is not.
  std::string free_name(const std::string& name) const;
  // Writes a file under free_name() and returns it.
  std::string keep_new(const std::string& name, const std::string& bytes) const;
  // Keeps the text of a scene: in its own file if the desk wrote that, else in a new one. Returns the name.
  std::string keep_scene(const std::string& name, const std::string& text) const;

  // The words of a command that are kept beside a table, in NAME.options, one a line; @NAME.options stands for them on a
  // command line. The table is one of them if its kind stands before it (uniaxial=NAME). None: there is no such file.
  std::vector<std::string> kept_words(const std::string& table) const;
  // Keeps them; without words the file is removed. Throws ApiError 409 if a file of that name is not of the desk.
  void keep_words(const std::string& table, const std::vector<std::string>& words) const;

 private:
  std::filesystem::path path_;
};

// The last part of a name, of a path of any system, with characters replaced that a command line or a file
// system could take for something else; empty if nothing is left.
std::string plain_file_name(const std::string& name);

}  // namespace viscard
