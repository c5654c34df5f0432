#pragma once

#include <array>
#include <functional>
#include <vector>

namespace aeolian {

/// Grains that bounce between a bed and a belt that a given power drives: Werner's toy of saltation (1987,
/// sec. 4.1), without dimensions. The belt stands for the wind.
struct Belt {
  double power = 1000;       ///< P_T, per area
  double friction = 0;       ///< zeta: the belt itself takes zeta v_c^2
  double restitution = 0.6;  ///< eps, of bed and belt
};

/// All grains leave the bed at one speed, straight up, (v_bix / v_girl)^2 for each that lands (eqs. 4.1-4.5).
class DeltaConveyor {
 public:
  struct State {
    double speed;  ///< v, of launches
    double flux;   ///< F
  };
  struct Fixed {
    State state;
    double belt_speed;  ///< v_c
    double impact_x, impact_y;
  };

  /// `conversion`: f, which may depend on the impact's velocity along the bed. Throws Error for a belt or
  /// v_girl that is not physical.
  DeltaConveyor(const Belt& belt, std::function<double(double)> conversion, double girl = 1);

  /// The belt's speed with these grains, from P_T = F v_c^2 v / (v_c + v) + zeta v_c^2.
  double belt_speed(const State& state) const;
  /// Eq. 4.23.
  State next(const State& state) const;
  /// Eqs. 4.3 and 4.5; throws Error where f <= 1 - eps^2, which has no steady state. The flux is zero where
  /// the power cannot drive the belt so fast.
  Fixed fixed_point() const;
  /// Of the map next() at a state, by differences: the real parts, or both real eigenvalues, larger first.
  std::array<double, 2> eigenvalues(const State& at) const;

 private:
  Belt belt_;
  std::function<double(double)> conversion_;
  double girl_;
};

/// The steady state linearised in time (eqs. 4.24-4.26): d/dt (v, F) = A (v, F) + B (v_c, N) about the fixed
/// point. Rows of `a` and `b`: v, F.
struct ConveyorResponse {
  std::array<std::array<double, 2>, 2> a, b;
};
ConveyorResponse linear_response(const DeltaConveyor::Fixed& at, const Belt& belt, double conversion,
                                 double gap);

/// Grains leave with a spectrum of speeds (eq. 4.12):
///     S = alpha v_bix / (v_bix + e) exp(-(v_o - f v_bix + eps v_biy)^2 / beta) + gamma v_bix^2 exp(-v_o /
///     delta)
struct ConveyorSplash {
  double conversion = 0.8;  ///< f
  double alpha = 1.6;
  double beta = 0.5;
  double gamma = 0;
  double delta = 1;
  double saturation = 3;  ///< e
};

class SpectrumConveyor {
 public:
  struct Steady {
    double belt_speed;
    std::vector<double> flux;  ///< of each bin, per unit of speed
    int iterations;
  };

  /// Bins of `width` from zero, launches at their centres. Throws Error for what is not physical.
  SpectrumConveyor(const Belt& belt, const ConveyorSplash& splash, int bins = 40, double width = 0.25);

  double launch_speed(int bin) const { return (bin + 0.5) * width_; }
  /// Grains that leave in each bin, per unit of speed, for one that was launched at `speed` (column of T,
  /// eq. 4.13).
  std::vector<double> column(double speed, double belt_speed) const;
  /// The speed of the belt with these grains (eq. 4.15, with the sign of the friction corrected).
  double belt_speed(const std::vector<double>& flux) const;
  /// One step of eq. 4.16.
  std::vector<double> next(const std::vector<double>& flux) const;
  /// Repeats eq. 4.16 until no bin changes by more than `tolerance`; throws Error after 10000 steps.
  Steady iterate(std::vector<double> flux, double tolerance) const;
  /// The steady state with the belt's speed as the unknown and the flux from the power; zero flux where the
  /// power does not suffice. Throws Error where no speed of the belt makes grains reproduce.
  Steady solve() const;

 private:
  /// Grains for one, when a spectrum of one grain has become its own image at a speed of the belt.
  double reproduction(double belt_speed, std::vector<double>& spectrum) const;
  std::vector<double> image(const std::vector<double>& flux, double belt_speed) const;

  Belt belt_;
  ConveyorSplash splash_;
  int bins_;
  double width_;
};

}  // namespace aeolian
