#pragma once

#include <Eigen/Core>

namespace aeolian {

/// What was predicted for some places, and what was measured there.
struct Misses {
  Eigen::MatrixXd members;   ///< a row for each place, a column for each member
  Eigen::VectorXd forecast;  ///< with the geometric mean of the members' parameters
  Eigen::VectorXd measured;
  Eigen::VectorXd variance;    ///< of what was measured
  double places_per_fact = 1;  ///< so many places have errors alike and count as one
};

struct ParameterUpdate {
  Eigen::MatrixXd logs;    ///< the members' new logarithms, a row for each member
  double innovation = 0;   ///< RMS miss in units of what was expected
  double information = 0;  ///< the largest gain of any combination of the parameters, prior variance over
                           ///< error variance; zero: the data say nothing
};

/// The ensemble Kalman update (Evensen 2003, Ocean Dynamics 53, 343-367) of the logarithms of parameters, in
/// the space of the parameters: there are far fewer of them than members, so that
///
/// - what members predict is split by regression into sensitivities to each parameter and scatter for other
///   reasons (errors of wind and map), which tells nothing of the parameters and is not taken for it;
/// - misses are those of the forecast with the mean parameters, not of the members' mean, which answers to
/// the
///   curvature of the model as well;
/// - sensitivities are shrunk by the share of them that scatter explains, none is left within two standard
///   errors (localisation in the space of parameters): what the surface does not show keeps its value and
///   spread;
/// - the error of the measurement is its variance and, beyond that, what the best fit leaves of the misses,
///   the model's own error;
/// - misses beyond 2.5 of their errors count by their sign only (Huber 1964), so that footprints and fallen
///   tools do no harm;
/// - members follow by the symmetric square root (as in an ensemble transform filter): no perturbed
///   observations, no random numbers.
///
/// `logs`: a row for each member, at least three members more than columns. Columns without spread are
/// known and stay.
ParameterUpdate update_parameters(const Eigen::MatrixXd& logs, const Misses& misses);

}  // namespace aeolian
