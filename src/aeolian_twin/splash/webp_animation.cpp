#include "aeolian_twin/splash/webp_animation.hpp"

#include <fmt/format.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {

struct WebpAnimation::Encoder {
  std::unique_ptr<WebPAnimEncoder, void (*)(WebPAnimEncoder*)> animation{nullptr, WebPAnimEncoderDelete};
  WebPConfig config{};
  int width = 0;
  int height = 0;
  int time = 0;

  [[noreturn]] void fail() const {
    throw Error(fmt::format("animation: {}", WebPAnimEncoderGetError(animation.get())));
  }
};

WebpAnimation::WebpAnimation(int width, int height) : encoder_(std::make_unique<Encoder>()) {
  WebPAnimEncoderOptions options;
  if (!WebPAnimEncoderOptionsInit(&options) || !WebPConfigInit(&encoder_->config))
    throw Error("animation: libwebp is of another version than its headers");
  options.anim_params.loop_count = 0;
  encoder_->config.quality = 70;
  encoder_->config.method = 2;
  encoder_->width = width;
  encoder_->height = height;
  encoder_->animation.reset(WebPAnimEncoderNew(width, height, &options));
  if (!encoder_->animation)
    throw Error(fmt::format("animation: none of {} x {} pixels can be made", width, height));
}

WebpAnimation::~WebpAnimation() = default;

void WebpAnimation::add(const cv::Mat& frame, int duration) {
  WebPPicture picture;
  if (!WebPPictureInit(&picture)) throw Error("animation: libwebp is of another version than its headers");
  const std::unique_ptr<WebPPicture, void (*)(WebPPicture*)> owner(&picture, WebPPictureFree);
  picture.width = encoder_->width;
  picture.height = encoder_->height;
  picture.use_argb = 1;
  if (frame.cols != picture.width || frame.rows != picture.height ||
      !WebPPictureImportBGRX(&picture, frame.data, static_cast<int>(frame.step)) ||
      !WebPAnimEncoderAdd(encoder_->animation.get(), &picture, encoder_->time, &encoder_->config))
    encoder_->fail();
  encoder_->time += duration;
}

void WebpAnimation::write(const std::string& path) {
  WebPData data;
  WebPDataInit(&data);
  const std::unique_ptr<WebPData, void (*)(WebPData*)> owner(&data, WebPDataClear);
  if (!WebPAnimEncoderAdd(encoder_->animation.get(), nullptr, encoder_->time, nullptr) ||
      !WebPAnimEncoderAssemble(encoder_->animation.get(), &data))
    encoder_->fail();
  write_text_atomically(path, std::string(reinterpret_cast<const char*>(data.bytes), data.size));
}

}  // namespace aeolian
