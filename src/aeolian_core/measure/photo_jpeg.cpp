// JPEG through libjpeg itself: it decodes luma alone, and tells of damage that OpenCV's reader hides behind
// half a picture.

#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <memory>

#include <jpeglib.h>
// After jpeglib.h.
#include <jerror.h>
#include <libexif/exif-data.h>
#include <libexif/exif-utils.h>

#include "aeolian_core/measure/photo_formats.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// libjpeg's way to tell of errors; `base` must come first.
struct Complaints {
  jpeg_error_mgr base;
  std::jmp_buf give_up;
  std::array<char, JMSG_LENGTH_MAX> message;
  bool damaged;
};

Complaints& complaints_of(j_common_ptr jpeg) { return *reinterpret_cast<Complaints*>(jpeg->err); }

[[noreturn]] void fail(j_common_ptr jpeg) {
  Complaints& complaints = complaints_of(jpeg);
  complaints.base.format_message(jpeg, complaints.message.data());
  std::longjmp(complaints.give_up, 1);
}

/// Negative levels are warnings: data that are missing or make no sense.
void take_message(j_common_ptr jpeg, int level) {
  if (level >= 0 || jpeg->err->msg_code == JWRN_ADOBE_XFORM) return;
  Complaints& complaints = complaints_of(jpeg);
  if (!complaints.damaged) complaints.base.format_message(jpeg, complaints.message.data());
  complaints.damaged = true;
}

void say_nothing(j_common_ptr) {}

/// A decompressor with its complaints. The functions that may jump hold nothing that needs a destructor.
class Jpeg {
 public:
  Jpeg() {
    jpeg_.err = jpeg_std_error(&complaints_.base);
    complaints_.base.error_exit = fail;
    complaints_.base.emit_message = take_message;
    complaints_.base.output_message = say_nothing;
    complaints_.damaged = false;
    complaints_.message.fill(0);
    jpeg_create_decompress(&jpeg_);
  }
  Jpeg(const Jpeg&) = delete;
  Jpeg& operator=(const Jpeg&) = delete;
  ~Jpeg() { jpeg_destroy_decompress(&jpeg_); }

  /// False when the file cannot be decoded: see message().
  bool start(const std::string& bytes) {
    if (setjmp(complaints_.give_up) != 0) return false;
    jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg_, TRUE);
    inks_ = jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
    jpeg_.out_color_space = inks_ ? JCS_CMYK : JCS_GRAYSCALE;
    return true;
  }
  bool decode(unsigned char* values) {
    if (setjmp(complaints_.give_up) != 0) return false;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      unsigned char* row = values + channels() * width() * jpeg_.output_scanline;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return !complaints_.damaged;
  }

  std::size_t width() const { return jpeg_.image_width; }
  std::size_t height() const { return jpeg_.image_height; }
  std::size_t channels() const { return inks_ ? 4 : 1; }
  /// Adobe's programs store how much each ink lets through, others how much ink there is.
  bool inverted_inks() const { return jpeg_.saw_Adobe_marker == TRUE; }
  const char* message() const { return complaints_.message.data(); }

 private:
  jpeg_decompress_struct jpeg_{};
  Complaints complaints_{};
  bool inks_ = false;
};

std::vector<std::uint8_t> luma_of_inks(const std::vector<std::uint8_t>& cmyk, bool inverted) {
  std::vector<std::uint8_t> luma(cmyk.size() / 4);
  for (std::size_t i = 0; i < luma.size(); ++i) {
    std::array<double, 4> light{};
    for (std::size_t ink = 0; ink < 4; ++ink) {
      const std::uint8_t value = cmyk[4 * i + ink];
      light[ink] = inverted ? value : 255 - value;
    }
    const double grey = 0.299 * light[0] + 0.587 * light[1] + 0.114 * light[2];
    luma[i] = static_cast<std::uint8_t>(std::lround(grey * light[3] / 255));
  }
  return luma;
}

std::string text_of(ExifData* exif, ExifIfd ifd, ExifTag tag) {
  ExifEntry* entry = exif_content_get_entry(exif->ifd[ifd], tag);
  if (entry == nullptr || entry->format != EXIF_FORMAT_ASCII || entry->data == nullptr) return "";
  const auto* text = reinterpret_cast<const char*>(entry->data);
  return std::string(text, entry->size);
}

int number_of(ExifData* exif, ExifIfd ifd, ExifTag tag, int otherwise) {
  ExifEntry* entry = exif_content_get_entry(exif->ifd[ifd], tag);
  if (entry == nullptr || entry->format != EXIF_FORMAT_SHORT || entry->components != 1) return otherwise;
  return exif_get_short(entry->data, exif_data_get_byte_order(exif));
}

}  // namespace

Photo decode_jpeg(const std::string& path, const std::string& bytes) {
  Jpeg jpeg;
  const auto refuse = [&] {
    throw Error("photo '" + path + "': is truncated or damaged (" + jpeg.message() + ")");
  };
  if (!jpeg.start(bytes)) refuse();
  check_photo_size(path, jpeg.width(), jpeg.height());
  Photo photo;
  photo.width_px = static_cast<int>(jpeg.width());
  photo.height_px = static_cast<int>(jpeg.height());
  photo.values8.resize(jpeg.channels() * jpeg.width() * jpeg.height());
  if (!jpeg.decode(photo.values8.data())) refuse();
  if (jpeg.channels() == 4) photo.values8 = luma_of_inks(photo.values8, jpeg.inverted_inks());
  return photo;
}

ExifFacts exif_of_jpeg(const std::string& bytes) {
  const std::unique_ptr<ExifData, void (*)(ExifData*)> exif(
      exif_data_new_from_data(reinterpret_cast<const unsigned char*>(bytes.data()),
                              static_cast<unsigned>(bytes.size())),
      exif_data_unref);
  if (!exif) return {};
  ExifFacts facts;
  facts.orientation = number_of(exif.get(), EXIF_IFD_0, EXIF_TAG_ORIENTATION, 1);
  facts.focal_35mm = number_of(exif.get(), EXIF_IFD_EXIF, EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM, 0);
  facts.time_of_picture = text_of(exif.get(), EXIF_IFD_EXIF, EXIF_TAG_DATE_TIME_ORIGINAL);
  return facts;
}

}  // namespace aeolian
