#include <algorithm>

#include <fmt/format.h>

#include "aeolian_core/slide/surrogate/slide_surrogate.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_core/surface/yaml_section.hpp"

namespace aeolian {
namespace {

constexpr std::size_t feature_count = PileFeatures{}.size();
constexpr double huge = 1e12;

template <class Numbers>
std::string list(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) {
    text += text.empty() ? "[" : ", ";
    append_number(text, number);
  }
  return text + "]";
}

std::string shown(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

std::string section_of(const char* name, const SlideSurrogate::Target& target) {
  const SupportVectors::Parts& p = target.vectors.parts();
  std::string text = fmt::format(
      "{}:\n  cost: {}\n  tolerance: {}\n  gamma: {}\n  half_width: {}\n  target_mean: {}\n"
      "  target_deviation: {}\n  offset: {}\n  feature_mean: {}\n  feature_deviation: {}\n"
      "  vectors:  # weight, and the z-scores of the features\n",
      name, shown(p.settings.cost), shown(p.settings.tolerance), shown(p.settings.gamma),
      shown(target.half_width), shown(p.target_mean), shown(p.target_deviation), shown(p.offset),
      list(p.mean), list(p.deviation));
  for (std::size_t k = 0; k < p.vectors.size(); ++k) {
    std::vector<double> row{p.weights[k]};
    row.insert(row.end(), p.vectors[k].begin(), p.vectors[k].end());
    text += "    - " + list(row) + "\n";
  }
  return text;
}

PileFeatures features_in(YamlSection& section, const std::string& key) {
  const std::vector<double> numbers = section.numbers(key, feature_count);
  PileFeatures result{};
  std::copy(numbers.begin(), numbers.end(), result.begin());
  return result;
}

SlideSurrogate::Target read_target(YamlSection section, SvrKernel kernel) {
  SupportVectors::Parts p;
  p.settings.kernel = kernel;
  p.settings.cost = section.positive("cost");
  p.settings.tolerance = section.number("tolerance", 0, huge);
  p.settings.gamma = section.positive("gamma");
  const double half_width = section.number("half_width", 0, huge);
  p.target_mean = section.number("target_mean", -huge, huge);
  p.target_deviation = section.positive("target_deviation");
  p.offset = section.number("offset", -huge, huge);
  p.mean = features_in(section, "feature_mean");
  p.deviation = features_in(section, "feature_deviation");
  for (std::size_t d = 0; d < feature_count; ++d)
    if (!(p.deviation[d] > 0)) section.refuse_element("feature_deviation", d, "must be positive");
  for (const std::vector<double>& row : section.rows("vectors", feature_count + 1, feature_count + 1)) {
    p.weights.push_back(row[0]);
    std::copy(row.begin() + 1, row.end(), p.vectors.emplace_back().begin());
  }
  section.finish();
  return {SupportVectors(p), half_width};
}

}  // namespace

void SlideSurrogate::write(const std::string& file, const std::string& comment) const {
  std::string text = fmt::format(
      "# {}\n# Features: ln of the panel's length [m], height of its lower edge [m], tilt [rad], thickness "
      "of "
      "the slab [m], ln of the event.\n# Targets: ln of height [m], length [m], height over length.\n"
      "kernel: {}\ncoverage: {}\nhull:  # corners\n",
      comment, kernel() == SvrKernel::linear ? "linear" : "rbf", shown(coverage_));
  for (const PileFeatures& corner : hull_.corners()) text += "  - " + list(corner) + "\n";
  text += section_of("height", height_) + section_of("length", length_) + section_of("shape", shape_);
  write_text_atomically(file, text);
}

SlideSurrogate SlideSurrogate::read(const std::string& file) {
  YamlSection root = YamlSection::load(file);
  const std::string word = root.text("kernel");
  if (word != "linear" && word != "rbf") root.refuse("kernel", "must be linear or rbf");
  const SvrKernel kernel = word == "linear" ? SvrKernel::linear : SvrKernel::rbf;
  const double coverage = root.number("coverage", 0, 1);
  std::vector<PileFeatures> corners;
  for (const std::vector<double>& row : root.rows("hull", feature_count, feature_count))
    std::copy(row.begin(), row.end(), corners.emplace_back().begin());
  Target height = read_target(root.section("height"), kernel);
  Target length = read_target(root.section("length"), kernel);
  Target shape = read_target(root.section("shape"), kernel);
  root.finish();
  return {std::move(height), std::move(length), std::move(shape), ConvexHull(corners), coverage};
}

}  // namespace aeolian
