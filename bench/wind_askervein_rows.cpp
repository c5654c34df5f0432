#include <cmath>

#include "../test/aeolian_core/wind/relief_worlds.hpp"
#include "wind_rows.hpp"

namespace aeolian {
namespace {

struct Station {
  double place;
  double speed_up;
};
constexpr Station hilltop[] = {{3, 1.213}, {5, 1.084}, {8, 0.931}, {15, 0.779}, {24, 0.585}, {34, 0.455}};
constexpr Station line_a[] = {{-850, -0.093}, {-500, -0.221}, {-350, -0.163}, {-200, 0.221}, {-100, 0.535},
                              {0, 0.884},     {100, 0.395},   {200, -0.349},  {400, -0.651}};

}  // namespace

void askervein_rows(AccuracyTable& table) {
  table.section(
      "G1, G2: Askervein, TU03-B",
      "Measured speed-up (Taylor & Teunissen 1987, as collected in Risø-R-1688) against a hill of its height "
      "(116 m) and half-width (220 m): a Gaussian, twice as wide across, over z0 = 3 cm; not its contours.");
  const UpwindProfile upwind = UpwindProfile::log_law(askervein_roughness);
  const WindRelief relief = wind_relief(askervein_like(25), 0);
  const SpectralVolume linear(relief, 0, upwind, LeeBubble{}, 300);
  const MassConsistentVolume boxes(relief, 0, upwind, {});
  const auto gain = [&](const WindVolume& v, double x, double z) {
    return v.velocity(x, 0, z).east / upwind.speed(z) - 1;
  };
  for (const auto& [name, volume] :
       {std::pair<std::string, const WindVolume*>{"spectral", &linear}, {"mass consistent", &boxes}}) {
    for (const Station& s : hilltop) {
      const std::string what = fmt::format("{}, hilltop, {:g} m", name, s.place);
      if (s.place == 34)
        table.relative_row("G1: " + what, s.speed_up, gain(*volume, 0, s.place), 0.1);
      else
        table.remark(what, s.speed_up, gain(*volume, 0, s.place));
    }
    table.relative_row("G1: " + name + ", hilltop, 10 m", 0.884, gain(*volume, 0, 10), 0.25);
    int right = 0;
    for (const Station& s : line_a) {
      const double ours = gain(*volume, s.place, 10);
      right += ours * s.speed_up > 0 ? 1 : 0;
      table.remark(fmt::format("{}, line A, {:g} m, 10 m", name, s.place), s.speed_up, ours);
    }
    table.row("G2: " + name + ", stations of nine with the right sign", 9, right, 0);
  }
  table.range_row("G2: spectral with its bubble, lee at 400 m", -1, -0.4, gain(linear, 400, 10));
  table.remark("mass consistent, lee at 400 m (unsupported: it knows no separation)", -0.651,
               gain(boxes, 400, 10));
}

}  // namespace aeolian
