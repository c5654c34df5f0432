#pragma once

#include "aeolian_core/slide/mpm/particle_block.hpp"
#include "aeolian_core/slide/mpm/return_mapping.hpp"

namespace aeolian {

/// How particles and grid exchange momentum.
enum class Transfer {
  apic,  ///< affine particles, forces by the same weights (MLS-MPM: Jiang et al. 2015, Hu et al. 2018)
  flip,  ///< the thesis': B-spline gradients, FLIP blended with PIC
};

/// Particles to grid: fills the block's sums. With APIC momentum contains the impulse of the stress over the
/// step.
template <int Dim>
void to_nodes(ParticleBlock<Dim>& block, const TransferStep& step, Transfer transfer);

/// Grid to particles: takes velocities of the nodes that the block reaches (for FLIP also those before
/// forces), moves the particles, strains them and lets them yield. Tells the block's fastest particle.
template <int Dim>
void from_nodes(ParticleBlock<Dim>& block, const ReachedNodes<Dim>& velocity, const ReachedNodes<Dim>& before,
                const YieldConstants& law, const TransferStep& step, Transfer transfer);

/// The stress that belongs to the block's elastic state, without flow.
template <int Dim>
void refresh_stress(ParticleBlock<Dim>& block, const YieldConstants& law);

}  // namespace aeolian
