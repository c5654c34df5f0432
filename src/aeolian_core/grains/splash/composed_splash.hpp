#pragma once

#include <memory>

#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// Whether an event has no more kinetic energy, and no more momentum along the path, than the impact.
bool within_impact(const SplashEvent& event, const Impact& impact);

/// Leaves out ejecta, in their order, that would take the event beyond its impact.
void drop_beyond_impact(SplashEvent& event, const Impact& impact);

/// A splash of two separate modules: what becomes of the grain and what it throws out.
///
/// The rebound is drawn first. Ejecta that together with it would have more energy or momentum than the
/// impact brought are drawn again, as in Kok & Renno (2009, sec. 2.3.3); after four times those that do not
/// fit are left out. So the mean number of ejecta falls below Ejection::mean_number where many draws ask for
/// too much: docs/accuracy/splash.md tells by how much for each function.
class ComposedSplash : public Splash {
 public:
  ComposedSplash(std::shared_ptr<const Rebound> rebound, std::shared_ptr<const Ejection> ejection);

  double mean_ejecta(const Impact& impact) const override { return ejection_->mean_number(impact); }

 private:
  void draw(const Impact& impact, RandomStream& random, SplashEvent& event) const override;

  std::shared_ptr<const Rebound> rebound_;
  std::shared_ptr<const Ejection> ejection_;
};

}  // namespace aeolian
