#include "aeolian_core/twin/gnuplot.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// A new directory for the script and the complaints, removed with all that is in it.
class TemporaryDirectory {
 public:
  TemporaryDirectory() : path_(std::filesystem::temp_directory_path() / "aeolian_plot_XXXXXX") {
    std::string name = path_.string();
    if (::mkdtemp(name.data()) == nullptr)
      throw Error("plot: no temporary directory " + name + ": " + std::strerror(errno));
    path_ = name;
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// The last line that says something; gnuplot also shows the line of the script and a caret below the place.
std::string complaint(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::string last;
  while (std::getline(in, line))
    if (line.find_first_not_of(" ^\t") != std::string::npos) last = line;
  return last.empty() ? "it gave no reason" : last;
}

/// A word as gnuplot reads it between single quotes.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

}  // namespace

void plot_svg(const std::string& script, int width, int height, const std::string& path) {
  const TemporaryDirectory directory;
  const std::string script_file = directory.file("plot.gp");
  const std::string error_file = directory.file("stderr");
  write_atomically(path, [&](const std::string& picture) {
    std::ofstream(script_file)
        << "set encoding utf8\nset terminal svg size " << width << "," << height
        << " dynamic enhanced font 'Helvetica,Arial,sans-serif,14' background '#ffffff'\n"
        << "set output " << quoted(picture) << "\n"
        << script << "\nunset output\n";
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::string program = "gnuplot";
    std::string argument = script_file;
    char* const arguments[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    const int failure = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
      throw Error("plot " + path + ": gnuplot cannot be run: " + std::strerror(failure) +
                  " (is it installed?)");
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      throw Error("plot " + path + ": gnuplot failed: " + complaint(error_file));
  });
}

}  // namespace aeolian
