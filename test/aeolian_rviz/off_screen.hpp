#pragma once

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "child_process.hpp"
#include <unistd.h>

namespace aeolian {

inline bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

/// What a screen shows.
struct Picture {
  struct Pixel {
    int red = 0;
    int green = 0;
    int blue = 0;
  };
  int width = 0;
  int height = 0;
  std::vector<unsigned char> bytes;

  Pixel at(int x, int y) const {
    const auto i = static_cast<std::size_t>(3 * (y * width + x));
    return i + 2 < bytes.size() ? Pixel{bytes[i], bytes[i + 1], bytes[i + 2]} : Pixel{};
  }
};

/// The screen of DISPLAY; empty when it cannot be taken.
inline Picture take_picture() {
  Picture picture;
  FILE* pipe = popen("import -window root -depth 8 ppm:- 2> /dev/null", "r");
  if (!pipe) return picture;
  if (std::fscanf(pipe, "P6 %d %d 255", &picture.width, &picture.height) == 2) {
    std::fgetc(pipe);
    picture.bytes.resize(static_cast<std::size_t>(3 * picture.width * picture.height));
    if (std::fread(picture.bytes.data(), 1, picture.bytes.size(), pipe) != picture.bytes.size())
      picture.bytes.clear();
  }
  pclose(pipe);
  return picture;
}

/// An X server without a monitor, on a free number; sets DISPLAY.
class OffScreen {
 public:
  OffScreen(int width, int height) {
    int ends[2];
    if (pipe(ends) != 0) return;
    const std::string size = std::to_string(width) + "x" + std::to_string(height) + "x24";
    server_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", size,
                                 "+extension", "GLX", "-nolisten", "tcp"},
        SIGTERM);
    close(ends[1]);
    std::string number;
    char c = 0;
    while (read(ends[0], &c, 1) == 1 && c != '\n') number += c;
    close(ends[0]);
    if (!number.empty()) setenv("DISPLAY", (":" + number).c_str(), 1);
    works_ = !number.empty();
  }
  OffScreen(const OffScreen&) = delete;
  OffScreen& operator=(const OffScreen&) = delete;

  bool works() const { return works_; }

 private:
  std::unique_ptr<ChildProcess> server_;
  bool works_ = false;
};

}  // namespace aeolian
