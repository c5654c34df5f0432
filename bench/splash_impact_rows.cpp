// What the simulated impacts say beside the tables of Werner (1987), ch. III: splash specification, secs. 5.2
// to 5.4.

#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "splash_rows.hpp"

#include "aeolian_twin/splash/study.hpp"
#include "aeolian_twin/splash/study_quantities.hpp"
#include "aeolian_twin/splash/thesis_tables.hpp"

namespace aeolian {
namespace {

constexpr int beds = 4;
constexpr int impacts = 40;

using Numbers = std::map<std::string, MeanValue>;

Numbers numbers_of(const ImpactStatistics& statistics) {
  Numbers numbers;
  for (const Quantity& quantity : quantities(statistics)) numbers[quantity.name] = quantity.value;
  return numbers;
}

StudySettings study_of(char letter) {
  return read_study(std::string(AEOLIAN_REPOSITORY) + "/config/splash/werner_case_" +
                    static_cast<char>(letter - 'A' + 'a') + ".yaml");
}

StudyBeds<2> beds_of(StudySettings study, int number) {
  for (BedKind& kind : study.beds) kind.number = number;
  return lay_beds<2>(
      study, [](double, const std::string&) {}, false);
}

Numbers numbers_of(StudySettings study, const StudyBeds<2>& laid, int number) {
  study.impacts = number;
  const auto points = fire_all<2>(
      study, laid, [](double, const std::string&) {}, false);
  return numbers_of(points.front().statistics);
}

PrintedValue thesis(char letter, const std::string& quantity) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return printed_value(std::string(1, letter), quantity).value_or(PrintedValue{unknown, unknown});
}

/// The cases of the thesis, with their beds: those of a loose bed share them where the friction is the same.
class Cases {
 public:
  Cases() {
    const StudyBeds<2> rough = beds_of(study_of('A'), beds);
    const StudyBeds<2> smooth = beds_of(study_of('D'), beds);
    for (const char letter : std::string("ABCDEFHI"))
      results_[letter] = numbers_of(study_of(letter), letter == 'D' ? smooth : rough, impacts);
    results_['G'] = numbers_of(study_of('G'), beds_of(study_of('G'), 1), impacts);
  }
  const MeanValue& of(char letter, const std::string& quantity) const {
    return results_.at(letter).at(quantity);
  }

 private:
  std::map<char, Numbers> results_;
};

std::string named(char letter, const std::string& what) { return fmt::format("CASE {}, {}", letter, what); }

void rebounds(AccuracyTable& table, const Cases& cases) {
  table.section("Simulated impacts: rebound",
                fmt::format("Tables 3.2 and 3.3 of the thesis (ten impacts on one bed) against {} impacts on "
                            "{} loose beds of 375 "
                            "grains, `config/splash/werner_case_*.yaml`, seed 1; tolerances of the "
                            "specification, checks S1 and S2.",
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
  const double from_brinks = mean('A', "brink_momentum_share") /
                             (mean('A', "target_momentum_share") + mean('A', "brink_momentum_share") +
                              mean('A', "anti_brink_momentum_share") + mean('A', "other_momentum_share"));
  table.range_row("CASE A, share of the ejected forward momentum from brink grains", 0.6, 1.2, from_brinks);
  table.range_row("CASE A, share of the reptation from brink grains", 0.6, 1.5,
                  mean('A', "brink_reptation_m") / mean('A', "reptation_m"));
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

void impact_rows(AccuracyTable& table) {
  const Cases cases;
  rebounds(table, cases);
  ejecta(table, cases);
  contact_state_rows(table);
}

}  // namespace aeolian
