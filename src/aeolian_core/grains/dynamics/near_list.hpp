#pragma once

#include <array>
#include <vector>

#include "aeolian_core/grains/dynamics/cell_grid.hpp"
#include "aeolian_core/grains/dynamics/contact_list.hpp"
#include "aeolian_core/grains/dynamics/grain_motion.hpp"
#include "aeolian_core/grains/dynamics/grain_record.hpp"

namespace aeolian {

/// Who may touch whom until somebody has moved on.
///
/// Each grain has an anchor, its place when it was last looked at, and a skin that it may use up before it
/// must be looked at again; a fast grain's is wide. The list holds exactly the pairs whose anchors are within
/// both radii and both skins, so grains that have used theirs up are looked at alone and the rest of the list
/// stays.
template <int Dim>
class NearList {
 public:
  using Place = std::array<double, Dim>;
  explicit NearList(const Place& period) : period_(period) {}

  /// Forgets everything and starts with a new order of slots.
  void restart(const std::vector<GrainRecord<Dim>>& grains);

  /// How far a grain at `speed` may go [m]: `horizon` [s] at that speed, within reason.
  double skin(double radius, double speed, double horizon) const;

  /// New anchors for some grains, ascending, and all their pairs into `pairs`, which ascend before and after;
  /// the springs of pairs that stay are kept.
  void look_at(const std::vector<int>& slots, const std::vector<double>& skins,
               const std::vector<GrainRecord<Dim>>& grains, std::vector<NearPair<Dim>>& pairs);
  void forget(int slot);

  const Place& period() const { return period_; }
  const Anchor* anchors() const { return anchors_.data(); }
  const Anchor& anchor(int slot) const { return anchors_[static_cast<std::size_t>(slot)]; }
  /// Slots in an order that keeps neighbours together.
  std::vector<int> order(const std::vector<GrainRecord<Dim>>& grains) const;

 private:
  bool near(int slot, int other, const std::vector<GrainRecord<Dim>>& grains) const;

  Place period_;
  CellGrid<Dim> cells_;
  std::vector<Anchor> anchors_;
  std::vector<char> looked_at_;
  double largest_radius_ = 0, largest_skin_ = 0;
};

}  // namespace aeolian
