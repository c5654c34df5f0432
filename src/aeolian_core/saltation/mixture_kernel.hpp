#pragma once

#include "aeolian_core/saltation/grain_mixture.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"

namespace aeolian {

/// Kok & Renno's splash on a bed of several sizes (COMSALT): a grain of diameter d that lands at v rebounds
/// or stays, and throws up grains of size k,
///
///     N_k = f_k a / sqrt(g D) (d / d_k) v,
///
/// at speeds that follow sqrt(g D), D the mean diameter of the bed. Grains that stay replenish the bed, whose
/// shares f_k are given. The spectrum has a part for each size, in grains for its share, so that rare sizes
/// count as much as others where changes are judged.
class MixtureKernel : public SplashKernel {
 public:
  /// `grain` gives all but the diameter. Throws Error as KokRennoKernel and check(GrainMixture) do.
  MixtureKernel(const GrainMixture& mixture, const Grain& grain, const Atmosphere& atmosphere,
                const KokRennoConstants& constants = {}, int speeds_per_octave = 4, int angles = 14);

  std::unique_ptr<SplashKernel> clone() const override { return std::make_unique<MixtureKernel>(*this); }
  std::string name() const override { return "kok_renno, mixture"; }
  std::vector<double> first_spectrum() const override;
  void launch(const std::vector<double>& spectrum, Launches& launches) const override;
  void splash(const Launches& launches, double least, const Landings& landings,
              std::vector<double>& spectrum) const override;
  double number(const std::vector<double>& spectrum) const override;
  double cut_off(const std::vector<double>& spectrum) const override;
  bool extend(std::vector<double>& spectrum) override;

 private:
  /// The part of a spectrum that is of one size, in grains for its share.
  std::vector<double> part(const std::vector<double>& spectrum, std::size_t size) const;

  GrainMixture mixture_;
  std::vector<KokRennoKernel> sizes_;
};

}  // namespace aeolian
