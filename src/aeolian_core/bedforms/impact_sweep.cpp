#include "aeolian_core/bedforms/impact_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/bedforms/exposure.hpp"

namespace aeolian {

ImpactSweep::ImpactSweep(const WindFrame& frame, double tan_impact_angle, double hop, double shortening)
    : frame_(frame),
      drop_(frame.step() * tan_impact_angle),
      carried_(std::exp(-frame.step() / hop)),
      launched_(-std::expm1(-frame.step() / hop) * hop / frame.step()),
      shortening_(shortening / hop),
      line_height_(frame.stations()),
      line_exposure_(frame.stations() + 1),
      line_erosion_(frame.stations()),
      line_deposition_(frame.stations()),
      envelope_(frame.rows()),
      first_height_(frame.rows()),
      last_height_(frame.rows()),
      sent_(frame.rows()),
      received_(frame.rows()),
      erosion_(frame.stations() * frame.rows()),
      deposition_(frame.stations() * frame.rows()) {}

void ImpactSweep::run(const std::vector<double>& height) {
  std::fill(erosion_.begin(), erosion_.end(), 0.0);
  std::fill(deposition_.begin(), deposition_.end(), 0.0);
  inflow_ = outflow_ = 0;
  if (frame_.periodic())
    run_periodic(height);
  else
    run_open(height);
}

int ImpactSweep::wrapped(int row) const {
  const auto rows = static_cast<int>(frame_.rows());
  const int rest = row % rows;
  return rest < 0 ? rest + rows : rest;
}

ImpactSweep::Stretch ImpactSweep::stretch_of(int line) const {
  if (frame_.periodic()) return {0, frame_.stations()};
  const auto& places = frame_.places();
  const auto on_grid = [&](const WindFrame::Place& place) {
    const int row = line + place.row;
    return row >= -1 && row < static_cast<int>(frame_.rows());
  };
  const auto first = std::find_if(places.begin(), places.end(), on_grid);
  const auto last = std::find_if_not(first, places.end(), on_grid);
  return {static_cast<std::size_t>(first - places.begin()), static_cast<std::size_t>(last - places.begin())};
}

void ImpactSweep::gather(const std::vector<double>& height, int line, Stretch stretch) {
  const auto rows = static_cast<int>(frame_.rows());
  const std::size_t stations = frame_.stations();
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const WindFrame::Place place = frame_.places()[i];
    int low = line + place.row;
    int high = low + 1;
    if (frame_.periodic()) {
      low = wrapped(low);
      high = low + 1 == rows ? 0 : low + 1;
    } else {
      low = std::max(low, 0);
      high = std::min(high, rows - 1);
    }
    const double below = height[static_cast<std::size_t>(low) * stations + i];
    const double above = height[static_cast<std::size_t>(high) * stations + i];
    line_height_[i] = below + place.upper * (above - below);
  }
}

/// Gives a line's erosion and deposition to the two rows beside it. What falls beside an open grid has
/// crossed its border.
void ImpactSweep::scatter(int line, Stretch stretch) {
  const auto rows = static_cast<int>(frame_.rows());
  const std::size_t stations = frame_.stations();
  const auto give = [&](int row, std::size_t i, double share) {
    if (row < 0 || row >= rows) {
      inflow_ += share * line_erosion_[i];
      outflow_ += share * line_deposition_[i];
      return;
    }
    const std::size_t at = static_cast<std::size_t>(row) * stations + i;
    erosion_[at] += share * line_erosion_[i];
    deposition_[at] += share * line_deposition_[i];
  };
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const WindFrame::Place place = frame_.places()[i];
    const int low = frame_.periodic() ? wrapped(line + place.row) : line + place.row;
    const int high = frame_.periodic() && low + 1 == rows ? 0 : low + 1;
    give(low, i, 1 - place.upper);
    give(high, i, place.upper);
  }
}

/// Erosion of a line behind an envelope. The impacts between two stations are shared by both, which makes
/// slopes central differences; `line_exposure_[i]` belongs to the stretch before station i.
void ImpactSweep::erode(Stretch stretch, double envelope) {
  const std::size_t count = stretch.end - stretch.begin;
  double* exposure = line_exposure_.data();
  exposure_behind(line_height_.data() + stretch.begin, count, drop_, envelope, exposure);
  // Beyond the last station: as before it (open), or the first of the line that follows, which the caller put
  // there.
  if (!frame_.periodic()) exposure[count] = exposure[count - 1];
  for (std::size_t i = 0; i < count; ++i)
    line_erosion_[stretch.begin + i] = 0.5 * (exposure[i] + exposure[i + 1]);
}

/// What a rise since take-off takes from the flux through a face, at the height of the bed there.
double ImpactSweep::shift(Flux flux, double height) const {
  return shortening_ * (flux.heights - height * flux.grains);
}

/// Carries the reptation flux along a line and drops it, both averaged over cells: exact for sources that are
/// uniform in each cell. `before` and `after` are the heights beyond its ends. Returns the flux that leaves.
ImpactSweep::Flux ImpactSweep::hop_along(Stretch stretch, Flux flux, double before, double after) {
  double height = line_height_[stretch.begin];
  double shifted = shift(flux, 0.5 * (before + height));
  for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
    const double launched = launched_ * line_erosion_[i];
    const Flux next{carried_ * flux.grains + launched, carried_ * flux.heights + launched * height};
    const double ahead = i + 1 < stretch.end ? line_height_[i + 1] : after;
    const double next_shifted = shift(next, 0.5 * (height + ahead));
    line_deposition_[i] = line_erosion_[i] + flux.grains + shifted - next.grains - next_shifted;
    flux = next;
    shifted = next_shifted;
    height = ahead;
  }
  return flux;
}

void ImpactSweep::run_open(const std::vector<double>& height) {
  const double flat_flux = launched_ / (1 - carried_);
  for (int line = frame_.first_line(); line < frame_.first_line() + frame_.lines(); ++line) {
    const Stretch stretch = stretch_of(line);
    if (stretch.begin == stretch.end) continue;
    gather(height, line, stretch);
    const double first = line_height_[stretch.begin];
    const double last = line_height_[stretch.end - 1];
    erode(stretch, first - drop_);
    const Flux leaving = hop_along(stretch, {flat_flux, flat_flux * first}, first, last);
    inflow_ += flat_flux;
    outflow_ += leaving.grains + shift(leaving, last);
    scatter(line, stretch);
  }
}

void ImpactSweep::run_periodic(const std::vector<double>& height) {
  const Stretch all{0, frame_.stations()};
  const int lines = frame_.lines();
  const auto line_before = [&](int line) { return static_cast<std::size_t>(wrapped(line - frame_.turn())); };
  const auto line_after = [&](int line) { return static_cast<std::size_t>(wrapped(line + frame_.turn())); };

  // First round: what each line hands to the one that follows.
  for (int line = 0; line < lines; ++line) {
    const auto at = static_cast<std::size_t>(line);
    gather(height, line, all);
    envelope_[at] = envelope_after(line_height_.data(), all.end, drop_);
    first_height_[at] = line_height_.front();
    last_height_[at] = line_height_.back();
  }
  const auto carry = [&](int line, Flux flux) {
    gather(height, line, all);
    const double before = last_height_[line_before(line)];
    const double after = first_height_[line_after(line)];
    const double envelope = envelope_[static_cast<std::size_t>(line)];
    line_exposure_[all.end] = std::max(0.0, after - envelope) / drop_;
    erode(all, envelope_[line_before(line)]);
    return hop_along(all, flux, before, after);
  };
  for (int line = 0; line < lines; ++line) sent_[static_cast<std::size_t>(line)] = carry(line, {0, 0});
  // A line receives what the one before sent, and of what that one received as much as is carried over its
  // length.
  const double over_period = std::pow(carried_, static_cast<double>(all.end));
  std::fill(received_.begin(), received_.end(), Flux{0, 0});
  double share = 1;
  for (int back = 1; share > 1e-18; ++back, share *= over_period)
    for (int line = 0; line < lines; ++line) {
      const Flux& sent = sent_[static_cast<std::size_t>(wrapped(line - back % lines * frame_.turn()))];
      received_[static_cast<std::size_t>(line)].grains += share * sent.grains;
      received_[static_cast<std::size_t>(line)].heights += share * sent.heights;
    }

  for (int line = 0; line < lines; ++line) {
    carry(line, received_[static_cast<std::size_t>(line)]);
    scatter(line, all);
  }
}

}  // namespace aeolian
