#pragma once

#include <string>
#include <vector>

#include "aeolian_core/grains/impacts/impact.hpp"

namespace aeolian {

/// A grain on a picture.
struct FilmGrain {
  Eigen::Vector3d place;  ///< frame of Impact [m]
  double radius;          ///< [m]
  double speed;           ///< [m/s]
  bool incident;
};

struct FilmFrame {
  double time;  ///< after the first contact [s]
  std::vector<FilmGrain> grains;
};

/// What an impact looks like from the side.
struct Film {
  std::vector<FilmFrame> frames;
  Shot shot;
  double diameter;         ///< of the bed's grains [m]
  double top;              ///< of the bed [m]
  double length;           ///< of the bed [m]
  bool periodic;           ///< the bed goes on on all sides
  Eigen::Vector3d impact;  ///< where the grain is when it meets the bed [m]
};

/// Fires the shot and takes a picture at each of these times [s], ascending; before the first contact, at
/// time 0, the bed is at rest. Grains that the impact has noted and taken away go on in free flight. Of
/// spheres only the half behind the impact is seen, and all around a periodic bed is brought behind it.
/// Throws Error when the shot misses the bed.
template <int Dim>
Film film_impact(const Bed<Dim>& bed, const Shot& shot, ImpactRules rules, const std::vector<double>& times);

extern template Film film_impact(const Bed<2>&, const Shot&, ImpactRules, const std::vector<double>&);
extern template Film film_impact(const Bed<3>&, const Shot&, ImpactRules, const std::vector<double>&);

}  // namespace aeolian
