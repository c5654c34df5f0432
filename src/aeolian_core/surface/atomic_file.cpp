#include "aeolian_core/surface/atomic_file.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

/// A file that is gone again unless it was renamed.
class TemporaryFile {
 public:
  /// Creates it empty; throws Error about `path` with the system's reason.
  explicit TemporaryFile(const fs::path& path) : wanted_(path) {
    static std::atomic<unsigned> counter{0};
    const std::string unique = std::to_string(::getpid()) + "-" + std::to_string(counter++);
    const fs::path name = "." + path.stem().string() + "." + unique + path.extension().string();
    temporary_ = path.parent_path() / name;
    const int file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) throw Error("cannot write '" + wanted_.string() + "': " + std::strerror(errno));
    ::close(file);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(temporary_, ignored);
  }

  std::string path() const { return temporary_.string(); }
  void put_in_place() {
    std::error_code error;
    fs::rename(temporary_, wanted_, error);
    if (error) throw Error("cannot write '" + wanted_.string() + "': " + error.message());
  }

 private:
  fs::path wanted_;
  fs::path temporary_;
};

}  // namespace

void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write) {
  TemporaryFile file(path);
  write(file.path());
  file.put_in_place();
}

void write_text_atomically(const std::string& path, const std::string& text) {
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text << std::flush;
    if (!out) throw Error("cannot write '" + path + "': " + std::strerror(errno));
  });
}

void make_directory(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw Error("cannot make the directory '" + path + "': " + error.message());
  TemporaryFile probe(fs::path(path) / "probe");
}

}  // namespace aeolian
