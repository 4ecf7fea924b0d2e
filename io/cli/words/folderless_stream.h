#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace viscard {

// A stream that hands on what is printed into it line by line, without the folders that --strip-paths keeps out
// (io/basics/written_path.h): the output of a command often becomes a file.
class FolderlessStream : public std::ostream {
 public:
  explicit FolderlessStream(std::ostream& sink);  // sink must outlive it
  ~FolderlessStream() override;
  FolderlessStream(const FolderlessStream&) = delete;
  FolderlessStream& operator=(const FolderlessStream&) = delete;

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::ostream& sink) : sink_(sink) {}
    void finish();  // hands on a last line without line feed

   protected:
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int_type overflow(int_type c) override;
    int sync() override;

   private:
    std::ostream& sink_;
    std::string line_;
  };
  Buffer buffer_;
};

}  // namespace viscard
