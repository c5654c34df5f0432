#pragma once

#include <memory>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace aeolian {

/// An animated WebP picture that repeats for ever: shown by browsers, and a tenth of a GIF in size.
class WebpAnimation {
 public:
  /// Of frames of this size [px].
  WebpAnimation(int width, int height);
  ~WebpAnimation();
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;

  /// Appends a frame, 8-bit BGRA, that is shown for so long [ms]. Throws Error when it cannot be encoded.
  void add(const cv::Mat& frame, int duration);
  /// Writes the file, atomically. Throws Error naming it.
  void write(const std::string& path);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace aeolian
