// measure_photo: photographs of a straightedge's shadow to ripple profiles.

#include <cstdio>
#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/photo/overlay.hpp"
#include "aeolian_twin/photo/photo_files.hpp"
#include "aeolian_twin/photo/printed_strip.hpp"
#include "aeolian_twin/photo/profile_files.hpp"
#include "aeolian_twin/photo/profile_plot.hpp"
#include "aeolian_twin/photo/series.hpp"
#include "aeolian_twin/tools/program.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

/// Measures photos that share a setup, and writes what was found.
class PhotoMeasurer {
 public:
  PhotoMeasurer(std::string setup, std::string out, ProfileMode mode)
      : setup_file_(std::move(setup)),
        setup_(read_photo_setup(setup_file_)),
        out_(std::move(out)),
        mode_(mode) {}

  /// Whether all went well; what did not is told.
  bool run(const std::vector<PhotoFiles>& list) {
    if (!out_.empty()) make_directory(out_);
    bool good = true;
    for (const PhotoFiles& photos : list) {
      std::vector<MeasuredPhoto> measured;
      for (const std::string& file : photos.files)
        if (auto photo = attempt(file))
          measured.push_back(std::move(*photo));
        else
          good = false;
      if (!photos.folder.empty() && measured.size() > 1) write_series(photos.folder, std::move(measured));
    }
    return good;
  }

 private:
  std::optional<MeasuredPhoto> attempt(const std::string& file) const {
    try {
      MeasuredPhoto photo = measured(file);
      write(file, photo);
      return photo;
    } catch (const Error& error) {
      fmt::print(stderr, "measure_photo: {}\n", error.what());
      return std::nullopt;
    }
  }

  MeasuredPhoto measured(const std::string& file) const {
    const Photo photo = read_photo(file);
    try {
      MeasuredPhoto result{
          fs::path(file).filename().string(), photo.exif_time, measure_shadow(photo, setup_, mode_), {}};
      result.analysis = analyse(result.profile);
      return result;
    } catch (const Error& error) {
      throw Error("photo '" + file + "': " + error.what());
    }
  }

  void write(const std::string& file, const MeasuredPhoto& photo) const {
    const std::string stem = output_stem(file, out_);
    const cv::Mat overlay = draw_overlay(cv::imread(file, cv::IMREAD_COLOR), photo);
    write_profile_csv(photo.profile, stem + "_profile.csv");
    write_length_scales_csv(photo.analysis, stem + "_length_scales.csv");
    write_spectrum_csv(photo.analysis, stem + "_spectrum.csv");
    write_summary(photo, setup_file_, stem + "_summary.yaml");
    write_atomically(stem + "_overlay.jpg", [&](const std::string& temporary) {
      if (!cv::imwrite(temporary, overlay))
        throw Error("overlay '" + stem + "_overlay.jpg': cannot be written");
    });
    plot_profile(photo, stem + "_profile.svg");
    fmt::print("{}: {} -> {}\n", photo.name, in_one_line(photo.analysis), folder_of(stem));
  }

  void write_series(const std::string& folder, std::vector<MeasuredPhoto> photos) const {
    const MeasuredSeries series = make_series(std::move(photos));
    const fs::path out = out_.empty() ? fs::path(folder) : fs::path(out_);
    write_series_csv(series, (out / "series.csv").string());
    write_series_summary(series, (out / "series_summary.yaml").string());
    plot_series(series, (out / "series.svg").string());
    fmt::print("{}: {} -> {}\n", folder, in_one_line(series), out.string());
  }

  static std::string folder_of(const std::string& stem) {
    const std::string folder = fs::path(stem).parent_path().string();
    return folder.empty() ? "." : folder;
  }

  std::string setup_file_;
  PhotoSetup setup_;
  std::string out_;
  ProfileMode mode_;
};

void print_strip(const std::string& pdf, double length_mm, double marker_mm) {
  const PrintedStrip strip(length_mm / 1e3, marker_mm / 1e3);
  const std::string yaml = write_strip(strip, pdf);
  fmt::print(
      "{}: {:g} mm x {:g} mm in {} piece{}, {} markers, for printing at 100 %; {}: their place for the "
      "setup\n",
      pdf, 1e3 * strip.length(), 1e3 * strip.width(), strip.pieces(), strip.pieces() == 1 ? "" : "s",
      strip.markers().centres.size(), yaml);
}

constexpr const char* description =
    R"(Measures the profile of a rippled bed on photographs of a straightedge's shadow.

    measure_photo PHOTO... --setup setup.yaml [--out DIR] [--mode full|overhead]
    measure_photo --print-strip strip.pdf

A PHOTO may be a folder: its photos are a series, with migration and growth when the camera wrote their times.
Written for each photo NAME: NAME_profile.csv, NAME_summary.yaml, NAME_overlay.jpg (look at this one first),
NAME_profile.svg, NAME_length_scales.csv, NAME_spectrum.csv; for a folder also series.csv, series_summary.yaml and
series.svg. docs/measure_photo.md tells how to take the photos, config/measure_photo.example.yaml explains the setup.)";

int run(int argc, char** argv) {
  CLI::App app(description);
  std::vector<std::string> photos;
  std::string setup;
  std::string out;
  std::string mode = "full";
  std::string strip;
  double length_mm = 500;
  double marker_mm = 14;
  app.add_option("PHOTO", photos, "JPEG, PNG or TIFF files, or folders of them");
  app.add_option("--setup", setup, "YAML file about straightedge, light and camera");
  app.add_option("--out", out,
                 "folder for the results, created when it does not exist; default: beside each photo");
  app.add_option(
         "--mode", mode,
         "full: camera rays against the plane of light; overhead: displacement times tangent, as in Werner "
         "(1987)")
      ->check(CLI::IsMember({"full", "overhead"}));
  auto* print =
      app.add_option("--print-strip", strip, "writes a strip of markers for the straightedge as a PDF");
  app.add_option("--strip-length-mm", length_mm, "length of that strip, default 500")->needs(print);
  app.add_option("--marker-mm", marker_mm, "side of its markers, default 14")->needs(print);
  if (const auto code = parse(app, argc, argv)) return *code;
  if (!strip.empty()) {
    print_strip(strip, length_mm, marker_mm);
    if (photos.empty()) return 0;
  }
  if (photos.empty()) throw Error("there is no PHOTO, see --help");
  if (setup.empty()) throw Error("--setup is missing, see --help");
  PhotoMeasurer measurer(setup, out, mode == "full" ? ProfileMode::full : ProfileMode::overhead);
  return measurer.run(list_photos(photos, out)) ? 0 : 1;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("measure_photo", [&] { return aeolian::run(argc, argv); });
}
