#include "aeolian_twin/saltation/splash_choice.hpp"

#include "aeolian_core/grains/splash/coarse_sand.hpp"
#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/saltation/delta_kernel.hpp"
#include "aeolian_core/saltation/distribution_kernel.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/sampled_kernel.hpp"
#include "aeolian_core/saltation/supplied_state.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Grains that do not rise by their own diameter stay where they are (Werner 1987, sec. 4.3).
SplashSampling out_of_pockets() {
  SplashSampling sampling;
  sampling.slowest = 1.414;
  return sampling;
}

}  // namespace

std::unique_ptr<SplashKernel> hard_ground_choice(const SaltatingBed& bed) {
  return std::make_unique<SampledKernel>(hard_ground_splash(bed.grain), "hard_ground", bed.grain,
                                         bed.atmosphere, out_of_pockets());
}

std::unique_ptr<SplashKernel> splash_choice(const std::string& value, const SaltatingBed& bed,
                                            int thesis_case) {
  const std::string table = "table:";
  if (value == "werner")
    return std::make_unique<DistributionKernel>(DistributionSplash::thesis_case(thesis_case));
  if (value == "ungar_haff") return std::make_unique<DeltaKernel>(bed.grain, bed.atmosphere);
  if (value == "kok_renno") return std::make_unique<KokRennoKernel>(bed.grain, bed.atmosphere);
  if (value == "coarse_sand") {
    const auto splash = std::make_shared<ComposedSplash>(std::make_shared<CoarseSandRebound>(bed.grain),
                                                         std::make_shared<CoarseSandEjection>(bed.grain));
    return std::make_unique<SampledKernel>(splash, value, bed.grain, bed.atmosphere, out_of_pockets());
  }
  if (value.compare(0, table.size(), table) == 0) {
    const auto read = std::make_shared<SplashTable>(SplashTable::read(value.substr(table.size())));
    return std::make_unique<SampledKernel>(std::make_shared<TabulatedSplash>(read, bed.grain), value,
                                           bed.grain, bed.atmosphere, out_of_pockets());
  }
  throw Error("--splash: '" + value +
              "' is not known, must be werner, ungar_haff, kok_renno, coarse_sand or table:FILE");
}

}  // namespace aeolian
