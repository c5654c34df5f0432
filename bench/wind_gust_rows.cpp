#include <cmath>

#include "wind_rows.hpp"

#include "aeolian_core/wind/gusts.hpp"

namespace aeolian {

void gust_rows(AccuracyTable& table) {
  table.section("E1: the spectrum of a record", "A sine of 1 Hz, 512 samples of 8 Hz.");
  std::vector<double> sine(512);
  for (std::size_t i = 0; i < sine.size(); ++i) sine[i] = std::sin(2 * M_PI * static_cast<double>(i) / 8);
  const GustSpectrum peak = gust_spectrum(sine, 1.0 / 8);
  std::size_t most = 0;
  double sum = 0;
  for (std::size_t i = 0; i < peak.density.size(); ++i) {
    if (peak.density[i] > peak.density[most]) most = i;
    sum += peak.density[i] * peak.spacing;
  }
  table.row("frequency of the peak [Hz]", 1, peak.frequency[most], peak.spacing);
  table.relative_row("integral", 0.5, sum, 0.02);

  table.section("E2: gusts",
                "Kaimal's spectra, 44 minutes of 50 Hz, z = 3 m, u* = 0.4 m/s: standard deviations over u*, "
                "slopes of the "
                "spectra for reduced frequencies of 1 to 10.");
  for (const double speed : {5.0, 12.0}) {
    const Gusts g = synthetic_gusts({speed, 3, 0.4, 0.02, 1U << 17}, 7);
    const auto rows = [&](const char* name, const std::vector<double>& record, double sigma) {
      const GustSpectrum s = gust_spectrum(record, g.step);
      double variance = 0;
      double n = 0, x = 0, y = 0, xx = 0, xy = 0;
      for (std::size_t i = 0; i < s.density.size(); ++i) {
        variance += s.density[i] * s.spacing;
        const double f = s.frequency[i] * 3 / speed;
        if (f < 1 || f > 10) continue;
        const double lx = std::log(s.frequency[i]);
        const double ly = std::log(s.density[i]);
        n += 1, x += lx, y += ly, xx += lx * lx, xy += lx * ly;
      }
      table.relative_row(fmt::format("sigma {} over u*, U = {:g} m/s", name, speed), sigma,
                         std::sqrt(variance) / 0.4, 0.1);
      table.row(fmt::format("slope {}, U = {:g} m/s", name, speed), -5.0 / 3,
                (n * xy - x * y) / (n * xx - x * x), 0.15);
    };
    rows("along", g.along, 2.18);
    rows("across", g.across, 1.64);
    rows("up", g.up, 1.21);
  }
}

}  // namespace aeolian
