// What the simulated impacts say beside the tables of Werner (1987), ch. III: splash specification, secs. 5.2
// to 5.4.

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "splash_rows.hpp"

#include "aeolian_twin/splash/study.hpp"
#include "aeolian_twin/splash/study_quantities.hpp"
#include "aeolian_twin/splash/thesis_tables.hpp"

namespace aeolian {
namespace {

constexpr int beds = 16;
constexpr int impacts = 160;

using Numbers = std::map<std::string, MeanValue>;

/// What a study fired, and at what.
struct Case {
  std::vector<Bed<2>> beds;
  std::vector<ImpactOutcome> outcomes;
  Numbers numbers;
};

Numbers numbers_of(const ImpactStatistics& statistics) {
  Numbers numbers;
  for (const Quantity& quantity : quantities(statistics)) numbers[quantity.name] = quantity.value;
  return numbers;
}

StudySettings study_of(char letter) {
  return read_study(std::string(AEOLIAN_REPOSITORY) + "/config/splash/werner_case_" +
                    static_cast<char>(letter - 'A' + 'a') + ".yaml");
}

const StudyProgress silent = [](double, const std::string&) {};

StudyBeds<2> beds_of(StudySettings study, int number) {
  for (BedKind& kind : study.beds) kind.number = number;
  return lay_beds<2>(study, silent, false);
}

Case fired(char letter, const StudyBeds<2>& laid, const std::string& folder) {
  StudySettings study = study_of(letter);
  study.impacts = impacts;
  const std::string notes = fmt::format("{}/case_{}", folder, letter);
  std::filesystem::create_directories(notes);
  StudyJournal journal(
      notes, fmt::format("{} impacts on {} beds\n", study.impacts, laid.kinds.front().size()), false);
  auto points = fire_all<2>(study, laid, journal, silent, false);
  return {laid.kinds.front(), std::move(points.front().outcomes), numbers_of(points.front().statistics)};
}

PrintedValue thesis(char letter, const std::string& quantity) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return printed_value(std::string(1, letter), quantity).value_or(PrintedValue{unknown, unknown});
}

/// The cases of the thesis, with their beds: those of a loose bed share them where the friction is the same.
class Cases {
 public:
  explicit Cases(const std::string& folder) {
    const StudyBeds<2> rough = beds_of(study_of('A'), beds);
    const StudyBeds<2> smooth = beds_of(study_of('D'), beds);
    const StudyBeds<2> dense = beds_of(study_of('G'), 1);
    for (const char letter : std::string("ABCDEFGHI"))
      cases_[letter] = fired(letter, letter == 'D' ? smooth : letter == 'G' ? dense : rough, folder);
  }
  const Case& of(char letter) const { return cases_.at(letter); }
  const MeanValue& of(char letter, const std::string& quantity) const {
    return of(letter).numbers.at(quantity);
  }

 private:
  std::map<char, Case> cases_;
};

std::string named(char letter, const std::string& what) { return fmt::format("CASE {}, {}", letter, what); }

void rebounds(AccuracyTable& table, const Cases& cases) {
  table.section(
      "Simulated impacts: rebound",
      fmt::format(
          "Tables 3.2 and 3.3 of the thesis (ten impacts on one bed) against {} impacts on {} loose beds "
          "of 375 grains, "
          "`config/splash/werner_case_*.yaml`, seed 1; tolerances of the specification, "
          "checks S1 and S2.",
          impacts, beds));
  for (const char letter : std::string("ABDEFHI")) {
    const auto judged = [&](const char* what, const char* quantity, double tolerance, bool relative) {
      const MeanValue& ours = cases.of(letter, quantity);
      const double target = thesis(letter, quantity).mean;
      if (relative)
        table.relative_row(named(letter, what), target, ours.mean, tolerance, ours.error);
      else
        table.row(named(letter, what), target, ours.mean, tolerance, ours.error);
    };
    judged("eps_i", "rebound_speed", 0.12, true);
    judged("eps_ix", "rebound_along", 0.15, true);
    judged("eps_iy", "rebound_up", letter == 'B' ? 0.35 : 0.30, true);
    judged("theta_i [degrees]", "rebound_angle_deg", 10, false);
  }
  const MeanValue& steep = cases.of('C', "rebound_up");
  table.relative_row("CASE C, eps_iy", thesis('C', "rebound_up").mean, steep.mean, 0.35, steep.error);
  const auto up = [&](char letter) { return cases.of(letter, "rebound_up").mean; };
  table.statement("eps_iy: I, H > A, E, F > B > C",
                  fmt::format("{:.2f}, {:.2f} > {:.2f}, {:.2f}, {:.2f} > {:.2f} > {:.2f}", up('I'), up('H'),
                              up('A'), up('E'), up('F'), up('B'), up('C')),
                  std::min(up('I'), up('H')) > std::max({up('A'), up('E'), up('F')}) &&
                      std::min({up('A'), up('E'), up('F')}) > up('B') && up('B') > up('C'));
  table.statement("eps_iy above 0.85 at 15 degrees (A, E, F)",
                  fmt::format("{:.2f}, {:.2f}, {:.2f}", up('A'), up('E'), up('F')),
                  std::min({up('A'), up('E'), up('F')}) > 0.85);
  table.statement("CASE D, eps_ix above 0.75", fmt::format("{:.2f}", cases.of('D', "rebound_along").mean),
                  cases.of('D', "rebound_along").mean > 0.75);
  for (const char* quantity : {"rebound_along", "rebound_speed", "rebound_angle_deg"})
    for (const char letter : {'E', 'F'})
      table.relative_row(fmt::format("rebound scales with the speed: {} of {} as of A", quantity, letter),
                         cases.of('A', quantity).mean, cases.of(letter, quantity).mean, 0.12,
                         std::hypot(cases.of('A', quantity).error, cases.of(letter, quantity).error));
  for (const char letter : std::string("ABCDEF"))
    table.row(named(letter, "theta_b [degrees]"), thesis(letter, "bed_angle_deg").mean,
              cases.of(letter, "bed_angle_deg").mean, 4, cases.of(letter, "bed_angle_deg").error);
  for (const char letter : std::string("ABCDEFGHI"))
    for (const auto& [what, quantity] :
         {std::pair{"beta [degrees]", "normal_angle_deg"}, std::pair{"xi_i", "rebound_rolling"}})
      table.remark(named(letter, what), thesis(letter, quantity).mean, cases.of(letter, quantity).mean,
                   cases.of(letter, quantity).error);
  for (const char* quantity :
       {"rebound_speed", "rebound_along", "rebound_up", "rebound_angle_deg", "bed_angle_deg"})
    table.remark(named('G', quantity), thesis('G', quantity).mean, cases.of('G', quantity).mean,
                 cases.of('G', quantity).error);
}

/// Weights of numbers, the least uneven ones with which their mean and standard deviation are as wanted.
std::vector<double> weights_for(const std::vector<double>& values, double mean, double deviation) {
  double slope = 0, curvature = 0;
  std::vector<double> weights(values.size());
  for (int iteration = 0; iteration < 100; ++iteration) {
    double moment[5] = {};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double x = (values[i] - mean) / deviation;
      weights[i] = std::exp(slope * x + curvature * x * x);
      double power = weights[i];
      for (double& m : moment) {
        m += power;
        power *= x;
      }
    }
    for (int k = 4; k >= 0; --k) moment[k] /= moment[0];
    // Newton's step to a mean of zero and a mean square of one.
    const double xx = moment[2] - moment[1] * moment[1], xy = moment[3] - moment[1] * moment[2],
                 yy = moment[4] - moment[2] * moment[2];
    const double off_x = -moment[1], off_y = 1 - moment[2], whole = xx * yy - xy * xy;
    const double size = std::max(1.0, std::hypot(off_x, off_y) * 2);
    slope += (yy * off_x - xy * off_y) / whole / size;
    curvature += (xx * off_y - xy * off_x) / whole / size;
  }
  return weights;
}

void rebounds_at_their_angles(AccuracyTable& table, const Cases& cases) {
  table.section(
      "Simulated impacts: rebound, at the thesis' contact angles",
      "A rebound is a matter of the place that is hit, beta, and ten impacts are a small sample of that: our "
      "impacts, weighted such that mean and half-width of beta are those of table 3.2. Tolerances as above.");
  for (const char letter : std::string("ABEFHI")) {
    std::vector<double> angles, along, up, theta, bed;
    for (const ImpactOutcome& o : cases.of(letter).outcomes) {
      if (!o.rebound) continue;
      const Eigen::Vector3d& v = o.rebound->velocity;
      angles.push_back(o.contact->normal_angle * 180 / M_PI);
      along.push_back(v.x() / (o.shot.speed * std::cos(o.shot.angle)));
      up.push_back(v.z() / (o.shot.speed * std::sin(o.shot.angle)));
      theta.push_back(std::atan2(v.x(), v.z()) * 180 / M_PI);
      bed.push_back(std::atan2(o.shot.speed * std::sin(o.shot.angle) + v.z(),
                               o.shot.speed * std::cos(o.shot.angle) - v.x()) *
                    180 / M_PI);
    }
    const PrintedValue beta = thesis(letter, "normal_angle_deg");
    const std::vector<double> weights = weights_for(angles, beta.mean, beta.half_width);
    const auto weighted = [&](const std::vector<double>& values) {
      double sum = 0, total = 0, squares = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        sum += weights[i] * values[i];
        total += weights[i];
      }
      const double mean = sum / total;
      for (std::size_t i = 0; i < values.size(); ++i) squares += std::pow(weights[i] * (values[i] - mean), 2);
      return MeanValue{mean, 0, std::sqrt(squares) / total, static_cast<int>(values.size())};
    };
    const MeanValue ix = weighted(along), iy = weighted(up), turned = weighted(theta), given = weighted(bed);
    table.relative_row(named(letter, "eps_ix"), thesis(letter, "rebound_along").mean, ix.mean, 0.15,
                       ix.error);
    table.relative_row(named(letter, "eps_iy"), thesis(letter, "rebound_up").mean, iy.mean,
                       letter == 'B' ? 0.35 : 0.30, iy.error);
    table.row(named(letter, "theta_i [degrees]"), thesis(letter, "rebound_angle_deg").mean, turned.mean, 10,
              turned.error);
    if (letter == 'H' || letter == 'I') continue;  // no target for the bed's momentum (check S2)
    table.row(named(letter, "theta_b [degrees]"), thesis(letter, "bed_angle_deg").mean, given.mean, 4,
              given.error);
  }
}

/// A sum over a part of the ejecta of some impacts, over that of all of them.
struct Share {
  std::vector<double> parts, wholes;
  void add(double part, double whole) {
    parts.push_back(part);
    wholes.push_back(whole);
  }
  double value() const {
    return std::accumulate(parts.begin(), parts.end(), 0.0) /
           std::accumulate(wholes.begin(), wholes.end(), 0.0);
  }
  double error() const {
    double squares = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) squares += std::pow(parts[i] - value() * wholes[i], 2);
    return std::sqrt(squares) / std::abs(std::accumulate(wholes.begin(), wholes.end(), 0.0));
  }
};

bool brink_within(const Bed<2>& bed, double from, double reach) {
  for (const int grain : bed.grains.numbers()) {
    const double x = bed.grains.position(grain).x();
    if (bed.surface.step(grain) == Origin::brink && x >= from && x <= from + reach) return true;
  }
  return false;
}

/// Check S5, of the impacts that it speaks of: with a brink within ten diameters downstream.
void brink_shares(AccuracyTable& table, const Case& a) {
  Share momentum, reptation;
  for (const ImpactOutcome& outcome : a.outcomes) {
    const Bed<2>& bed = a.beds[static_cast<std::size_t>(outcome.number) % a.beds.size()];
    if (!outcome.contact || !brink_within(bed, outcome.shot.along, 20 * bed.radius)) continue;
    double all[2] = {}, brinks[2] = {};
    for (const RisenGrain& grain : outcome.ejecta) {
      const double values[2] = {grain.velocity.x(), ballistic_hop(grain.velocity)};
      for (int k = 0; k < 2; ++k) {
        all[k] += values[k];
        if (grain.kind == Origin::brink) brinks[k] += values[k];
      }
    }
    momentum.add(brinks[0], all[0]);
    reptation.add(brinks[1], all[1]);
  }
  const std::string of = fmt::format(" from brink grains, {} impacts with a brink within 10 d downstream",
                                     momentum.parts.size());
  table.range_row("CASE A, share of the ejected forward momentum" + of, 0.6, 1.2, momentum.value(),
                  momentum.error());
  table.range_row("CASE A, share of the reptation" + of, 0.6, 1.5, reptation.value(), reptation.error());
}

void ejecta(AccuracyTable& table, const Cases& cases) {
  table.section(
      "Simulated impacts: ejecta",
      "Checks S4 to S7; then tables 3.4, 3.5 and 3.9, which are told and not judged: they are ten impacts on "
      "one bed, and "
      "number, speed and reptation vary by a factor of 2 with the bed's state (specification, sec. 5.4).");
  const auto mean = [&](char letter, const char* quantity) { return cases.of(letter, quantity).mean; };
  const auto range = [&](char letter, const char* what, const char* quantity, double low, double high) {
    table.range_row(named(letter, what), low, high, mean(letter, quantity), cases.of(letter, quantity).error);
  };
  range('A', "ejecta", "ejecta_number", 3, 12);
  range('E', "ejecta", "ejecta_number", 0, 1.5);
  table.statement(
      "ejecta: E << A < F, A < C",
      fmt::format("{:.2f} << {:.2f} < {:.2f}, {:.2f}", mean('E', "ejecta_number"), mean('A', "ejecta_number"),
                  mean('F', "ejecta_number"), mean('C', "ejecta_number")),
      3 * mean('E', "ejecta_number") < mean('A', "ejecta_number") &&
          mean('A', "ejecta_number") < std::min(mean('F', "ejecta_number"), mean('C', "ejecta_number")));
  for (const char letter : std::string("ABCDF")) {
    range(letter, "ejecta speed [m/s]", "ejecta_speed_m_s", 0.6, 2);
    table.statement(
        named(letter, "v_y over speed of ejecta at least 0.8"),
        fmt::format("{:.2f}", mean(letter, "ejecta_upward_m_s") / mean(letter, "ejecta_speed_m_s")),
        mean(letter, "ejecta_upward_m_s") >= 0.8 * mean(letter, "ejecta_speed_m_s"));
    range(letter, "ejecta angle [degrees]", "ejecta_angle_deg", 0, 25);
    range(letter, "ejected energy over incident", "ejected_energy", 0.01, 0.05);
  }
  brink_shares(table, cases.of('A'));
  range('A', "angle of target grains [degrees]", "target_angle_deg", -5, 5);
  range('A', "angle of brink grains [degrees]", "brink_angle_deg", 35, 55);
  table.range_row("CASE A, share of ejecta from the first two layers", 0.8, 1,
                  mean('A', "from_upper_layers"));
  range('A', "depth of origin [m]", "origin_up_m", -0.015, -0.006);
  table.relative_row("ejecta speed of F as of A, for an impact faster by a third",
                     mean('A', "ejecta_speed_m_s"), mean('F', "ejecta_speed_m_s"), 0.3,
                     cases.of('F', "ejecta_speed_m_s").error);
  for (const char letter : std::string("ABCDEFGHI"))
    for (const char* quantity : {"ejecta_number", "ejecta_speed_m_s", "ejecta_upward_m_s", "ejecta_angle_deg",
                                 "reptation_m", "ejected_momentum_along", "ejected_momentum_up",
                                 "origin_along_m", "origin_up_m", "origin_distance_m"})
      table.remark(named(letter, quantity), thesis(letter, quantity).mean, cases.of(letter, quantity).mean,
                   cases.of(letter, quantity).error);
}

}  // namespace

void impact_rows(AccuracyTable& table, const std::string& folder) {
  const Cases cases(folder);
  rebounds(table, cases);
  rebounds_at_their_angles(table, cases);
  ejecta(table, cases);
  contact_state_rows(table);
}

}  // namespace aeolian
