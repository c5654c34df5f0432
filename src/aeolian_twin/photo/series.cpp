#include "aeolian_twin/photo/series.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_twin/photo/figure_text.hpp"
#include "aeolian_twin/photo/figure_units.hpp"
#include "aeolian_twin/photo/yaml_figures.hpp"

namespace aeolian {
namespace {

const char* name_of(ProfileSeries::Event::Kind kind) {
  switch (kind) {
    case ProfileSeries::Event::Kind::merger:
      return "merger";
    case ProfileSeries::Event::Kind::split:
      return "split";
    case ProfileSeries::Event::Kind::birth:
      return "birth";
    default:
      return "loss";
  }
}

std::string count_of(std::size_t count, const std::string& name) {
  return fmt::format("{} {}{}", count, name, count == 1 ? "" : name == "loss" ? "es" : "s");
}

/// Keeps the photos with a time, in its order, and says how many were left out.
void order_by_time(MeasuredSeries& series) {
  std::vector<MeasuredPhoto>& photos = series.photos;
  const auto end = std::stable_partition(photos.begin(), photos.end(),
                                         [](const MeasuredPhoto& photo) { return photo.time.has_value(); });
  const auto left_out = photos.end() - end;
  if (left_out > 0)
    series.remark = fmt::format("{} without a camera time left out",
                                count_of(static_cast<std::size_t>(left_out), "photo"));
  photos.erase(end, photos.end());
  std::stable_sort(photos.begin(), photos.end(),
                   [](const MeasuredPhoto& a, const MeasuredPhoto& b) { return *a.time < *b.time; });
}

void put_number(std::string& text, double value) {
  text += ',';
  if (std::isfinite(value)) append_number(text, std::round(value * 1e6) / 1e6);
}

void put_pair(std::string& text, const Figure& figure, double factor) {
  put_number(text, factor * figure.value);
  put_number(text, factor * figure.sigma);
}

/// A text as a CSV field.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

}  // namespace

MeasuredSeries make_series(std::vector<MeasuredPhoto> photos) {
  MeasuredSeries series;
  series.photos = std::move(photos);
  const auto timed = std::count_if(series.photos.begin(), series.photos.end(),
                                   [](const MeasuredPhoto& photo) { return photo.time.has_value(); });
  if (timed < 2) {
    series.remark = "no rates: the photos have no camera times (EXIF), so they are in order of their names";
    return series;
  }
  order_by_time(series);
  std::vector<ProfileAnalysis> analyses;
  std::vector<double> times;
  for (const MeasuredPhoto& photo : series.photos) {
    analyses.push_back(photo.analysis);
    times.push_back(*photo.time - *series.photos.front().time);
  }
  try {
    series.change = analyse_series(analyses, times);
  } catch (const Error& error) {
    series.remark = std::string("no rates: ") + error.what();
  }
  return series;
}

void write_series_csv(const MeasuredSeries& series, const std::string& path) {
  std::string text =
      "photo,time_s,ripples,wavelength_mm,sigma_wavelength_mm,height_mm,sigma_height_mm,index,sigma_index,"
      "roughness_mm,sigma_roughness_mm,migration_mm_per_min,sigma_migration_mm_per_min,growth_mm_per_min,"
      "sigma_growth_mm_per_min\n";
  const Figure unknown{NAN, NAN};
  for (std::size_t i = 0; i < series.photos.size(); ++i) {
    const MeasuredPhoto& photo = series.photos[i];
    const ProfileAnalysis& analysis = photo.analysis;
    text += field(photo.name);
    put_number(text, photo.time ? *photo.time - series.photos.front().time.value_or(*photo.time) : NAN);
    text += fmt::format(",{}", analysis.ripples.size());
    put_pair(text, analysis.wavelength, to_mm);
    put_pair(text, analysis.height, to_mm);
    put_pair(text, analysis.index, 1);
    put_pair(text, analysis.roughness, to_mm);
    const bool rates = series.change && i > 0 && i <= series.change->steps.size();
    put_pair(text, rates ? series.change->steps[i - 1].migration : unknown, to_mm_per_minute);
    put_pair(text, rates ? series.change->steps[i - 1].growth : unknown, to_mm_per_minute);
    text += '\n';
  }
  write_text_atomically(path, text);
}

void write_series_summary(const MeasuredSeries& series, const std::string& path) {
  YAML::Emitter out;
  out.SetDoublePrecision(summary_digits);
  out << YAML::BeginMap;
  put(out, "version", AEOLIAN_VERSION);
  put(out, "photos", series.photos.size());
  if (!series.remark.empty()) put(out, "remark", series.remark);
  if (series.change) {
    put(out, "migration_direction", migration_direction(series));
    put_figure(out, "migration", "mm_per_min", series.change->migration, to_mm_per_minute);
    put_figure(out, "growth", "mm_per_min", series.change->growth, to_mm_per_minute);
    out << YAML::Key << "events" << YAML::Value << YAML::BeginSeq;
    for (const ProfileSeries::Event& event : series.change->events) {
      out << YAML::Flow << YAML::BeginMap;
      put(out, "kind", name_of(event.kind));
      put(out, "time_s", event.time);
      put(out, "position_mm", to_mm * event.position);
      out << YAML::EndMap;
    }
    out << YAML::EndSeq;
  }
  out << YAML::EndMap;
  write_text_atomically(path, std::string(out.c_str()) + "\n");
}

std::string migration_direction(const MeasuredSeries& series) {
  return series.photos.front().analysis.downwind_known ? "downwind" : "towards the steeper flanks";
}

std::string in_one_line(const MeasuredSeries& series) {
  std::string text = count_of(series.photos.size(), "photo");
  if (series.change) {
    text += fmt::format(", migration {} mm/min {}, growth {} mm/min",
                        stated(series.change->migration, to_mm_per_minute), migration_direction(series),
                        stated(series.change->growth, to_mm_per_minute));
    std::map<std::string, std::size_t> counts;
    for (const ProfileSeries::Event& event : series.change->events) ++counts[name_of(event.kind)];
    for (const auto& [name, count] : counts) text += ", " + count_of(count, name);
  }
  if (!series.remark.empty()) text += "; " + series.remark;
  return text;
}

}  // namespace aeolian
