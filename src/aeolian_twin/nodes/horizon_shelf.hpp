#pragma once

#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace aeolian {

/// The entry whose lead time is nearest, the shorter of two as near; end() of an empty map.
template <class Item>
typename std::map<double, Item>::const_iterator nearest_lead(const std::map<double, Item>& by_lead_time,
                                                             double lead_time) {
  const auto above = by_lead_time.lower_bound(lead_time);
  if (above == by_lead_time.begin()) return above;
  const auto below = std::prev(above);
  const bool below_is_nearer =
      above == by_lead_time.end() || lead_time - below->first <= above->first - lead_time;
  return below_is_nearer ? below : above;
}

/// For each lead time the newest forecast. A run of the forecaster brings them one after the other, so until
/// it has brought one the forecast of the run before stands in its place; a lead time that the run before did
/// not bring either is no longer forecast, and is forgotten.
template <class Item>
class HorizonShelf {
 public:
  using Stamp = std::chrono::nanoseconds;
  struct Entry {
    Stamp start;  ///< time of the map from which it starts
    Item item;
  };

  /// Gives whether it was taken: not when a newer one of its lead time [s] stands there, as long runs may end
  /// after shorter ones that began later. But when the newest start lies ahead of the clock, or back by more
  /// than the longest lead time, the time has jumped back (a bag that loops), and all else is forgotten.
  bool put(Stamp start, double lead_time, Item item, Stamp now) {
    if (has_jumped_back(start, now)) by_lead_time_.clear();
    const auto present = by_lead_time_.find(lead_time);
    if (present != by_lead_time_.end() && present->second.start > start) return false;
    if (by_lead_time_.empty()) {
      newest_ = before_ = start;
    } else if (start > newest_) {
      before_ = std::exchange(newest_, start);
      forget_older();
    }
    by_lead_time_.insert_or_assign(lead_time, Entry{start, std::move(item)});
    return true;
  }

  /// By lead time [s].
  const std::map<double, Entry>& entries() const { return by_lead_time_; }
  /// The newest start of an entry.
  Stamp newest_start() const { return newest_; }

 private:
  bool has_jumped_back(Stamp start, Stamp now) const {
    if (by_lead_time_.empty() || start >= newest_) return false;
    const std::chrono::duration<double> back = newest_ - start;
    return newest_ > now || back.count() > by_lead_time_.rbegin()->first;
  }

  void forget_older() {
    for (auto entry = by_lead_time_.begin(); entry != by_lead_time_.end();)
      entry = entry->second.start < before_ ? by_lead_time_.erase(entry) : std::next(entry);
  }

  std::map<double, Entry> by_lead_time_;
  Stamp newest_{};
  Stamp before_{};  ///< the start before the newest
};

}  // namespace aeolian
