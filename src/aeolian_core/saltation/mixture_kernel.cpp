#include "aeolian_core/saltation/mixture_kernel.hpp"

#include <algorithm>

namespace aeolian {

MixtureKernel::MixtureKernel(const GrainMixture& mixture, const Grain& grain, const Atmosphere& atmosphere,
                             const KokRennoConstants& constants, int speeds_per_octave, int angles)
    : mixture_(mixture) {
  check(mixture);
  KokRennoConstants on_bed = constants;
  on_bed.bed_diameter = mixture.mean_diameter();
  for (const double diameter : mixture.diameter) {
    Grain own = grain;
    own.diameter = diameter;
    sizes_.emplace_back(own, atmosphere, on_bed, speeds_per_octave, angles);
  }
}

std::vector<double> MixtureKernel::part(const std::vector<double>& spectrum, std::size_t size) const {
  const auto count = static_cast<std::ptrdiff_t>(spectrum.size() / sizes_.size());
  const auto begin = spectrum.begin() + static_cast<std::ptrdiff_t>(size) * count;
  return {begin, begin + count};
}

std::vector<double> MixtureKernel::first_spectrum() const {
  std::vector<double> spectrum;
  for (const KokRennoKernel& size : sizes_) {
    const std::vector<double> own = size.first_spectrum();
    spectrum.insert(spectrum.end(), own.begin(), own.end());
  }
  return spectrum;
}

void MixtureKernel::launch(const std::vector<double>& spectrum, Launches& launches) const {
  launches.resize(0);
  Launches own;
  for (std::size_t s = 0; s < sizes_.size(); ++s) {
    sizes_[s].launch(part(spectrum, s), own);
    for (double& number : own.number) number *= mixture_.share[s];
    for (const auto column : {&Launches::vx, &Launches::vy, &Launches::number})
      (launches.*column).insert((launches.*column).end(), (own.*column).begin(), (own.*column).end());
  }
}

void MixtureKernel::splash(const Launches& launches, double least, const Landings& landings,
                           std::vector<double>& spectrum) const {
  const std::size_t classes = launches.size() / sizes_.size();
  std::vector<std::vector<double>> impacts(sizes_.size(), std::vector<double>(KokRennoKernel::knots()));
  std::vector<double> by_diameter(KokRennoKernel::knots());  // of all sizes, each times its diameter [m]
  for (std::size_t s = 0; s < sizes_.size(); ++s) {
    KokRennoKernel::count_impacts(launches, s * classes, (s + 1) * classes, least, landings, impacts[s]);
    for (std::size_t n = 0; n < by_diameter.size(); ++n)
      by_diameter[n] += mixture_.diameter[s] * impacts[s][n];
  }
  spectrum.clear();
  std::vector<double> ejecting(by_diameter.size()), own;
  for (std::size_t s = 0; s < sizes_.size(); ++s) {
    for (std::size_t n = 0; n < ejecting.size(); ++n) {
      impacts[s][n] /= mixture_.share[s];
      ejecting[n] = by_diameter[n] / mixture_.diameter[s];
    }
    sizes_[s].splash(impacts[s], ejecting, own);
    spectrum.insert(spectrum.end(), own.begin(), own.end());
  }
}

double MixtureKernel::number(const std::vector<double>& spectrum) const {
  double sum = 0;
  for (std::size_t s = 0; s < sizes_.size(); ++s)
    sum += mixture_.share[s] * sizes_[s].number(part(spectrum, s));
  return sum;
}

double MixtureKernel::cut_off(const std::vector<double>& spectrum) const {
  double most = 0;
  for (std::size_t s = 0; s < sizes_.size(); ++s) most = std::max(most, sizes_[s].cut_off(part(spectrum, s)));
  return most;
}

bool MixtureKernel::extend(std::vector<double>& spectrum) {
  std::vector<double> longer;
  for (std::size_t s = 0; s < sizes_.size(); ++s) {
    std::vector<double> own = part(spectrum, s);
    if (!sizes_[s].extend(own)) return false;
    longer.insert(longer.end(), own.begin(), own.end());
  }
  spectrum = std::move(longer);
  return true;
}

}  // namespace aeolian
