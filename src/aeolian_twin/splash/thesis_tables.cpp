#include "aeolian_twin/splash/thesis_tables.hpp"

#include <array>
#include <map>

namespace aeolian {
namespace {

using Row = std::array<PrintedValue, 9>;  // cases A to I

constexpr PrintedValue none{0, -1};

// As printed: angles in degrees, lengths in cm, speeds in cm/s, momenta in g cm/s.
const std::map<std::string, Row> tables = {
    {"rebound_along",
     {{{.59, .08},
       {.53, .16},
       {.54, .64},
       {.85, .07},
       {.60, .11},
       {.55, .06},
       {.67, .14},
       {.53, .25},
       {.47, .09}}}},
    {"rebound_up",
     {{{1.12, .29},
       {.68, .22},
       {.25, .07},
       {1.07, .32},
       {1.06, .39},
       {1.26, .21},
       {.85, .46},
       {1.39, .78},
       {1.66, .32}}}},
    {"rebound_speed",
     {{{.65, .04},
       {.58, .10},
       {.37, .07},
       {.87, .04},
       {.66, .05},
       {.63, .03},
       {.70, .08},
       {.69, .08},
       {.63, .01}}}},
    {"rebound_angle_deg",
     {{{62, 9}, {57, 16}, {30, 37}, {71, 7}, {64, 12}, {58, 7}, {70, 14}, {53, 26}, {46, 11}}}},
    {"rebound_rolling",
     {{{.85, .18},
       {.88, .31},
       {.85, .72},
       {0, 0},
       {.82, .23},
       {.87, .18},
       {.74, .26},
       {1.14, .58},
       {1.28, .14}}}},
    {"normal_angle_deg",
     {{{17, 5}, {16, 12}, {-4, 19}, {17, 5}, {13, 9}, {18, 10}, {7, 9}, {16, 13}, {21, 5}}}},
    {"bed_along",
     {{{.41, .08},
       {.47, .16},
       {.46, .64},
       {.15, .07},
       {.40, .11},
       {.45, .06},
       {.33, .14},
       {.47, .25},
       {.53, .09}}}},
    {"bed_down",
     {{{2.12, .29},
       {1.68, .22},
       {1.25, .07},
       {2.08, .32},
       {2.06, .39},
       {2.26, .25},
       {1.85, .46},
       {2.39, .78},
       {2.66, .32}}}},
    {"bed_angle_deg", {{{54, 2}, {60, 5}, {83, 10}, {75, 5}, {55, 3}, {54, 2}, {57, 4}, {44, 13}, {53, 1}}}},
    {"effective_mass",
     {{{1.9, .3}, {1.9, .3}, {2.3, .2}, {1.3, .2}, {2.2, .3}, {1.8, .3}, {2.0, .3}, none, none}}},
    {"ejecta_speed_m_s",
     {{{185, 90},
       {180, 85},
       {185, 125},
       {150, 95},
       {110, 40},
       {215, 130},
       {120, 60},
       {160, 95},
       {190, 130}}}},
    {"ejecta_upward_m_s",
     {{{160, 30},
       {165, 85},
       {175, 125},
       {135, 85},
       {110, 45},
       {195, 115},
       {100, 50},
       {155, 95},
       {175, 130}}}},
    {"ejecta_angle_deg",
     {{{17, 20}, {9, 25}, {8, 20}, {14, 25}, {15, 15}, {10, 20}, {8, 30}, {2, 14}, {9, 25}}}},
    {"reptation_m",
     {{{120, 85}, {55, 35}, {65, 100}, {105, 100}, {2, 3}, {250, 180}, {45, 65}, {4, 50}, {80, 90}}}},
    {"ejecta_number", {{{6, 2}, {7, 2}, {8, 2}, {8, 4}, {.4, .5}, {9, 2}, {7, 4}, {2, 2}, {6, 3}}}},
    {"ejected_momentum_along",
     {{{2100, 1100},
       {1300, 800},
       {1200, 1300},
       {2000, 1100},
       {50, 85},
       {2800, 1500},
       {950, 1100},
       {110, 690},
       {1100, 200}}}},
    {"ejected_momentum_up",
     {{{5900, 1500},
       {7400, 2600},
       {8200, 1300},
       {6400, 3300},
       {270, 390},
       {11300, 1500},
       {4700, 2900},
       {2240, 2000},
       {6600, 2200}}}},
    {"origin_along_m",
     {{{3.4, 4.4},
       {3.1, 4.6},
       {-2.1, 6.9},
       {.9, 10.1},
       {1.3, 2},
       {2.5, 5.7},
       {6.2, 13},
       {1.8, 2.4},
       {3.3, 5.1}}}},
    {"origin_up_m",
     {{{-1.3, .7},
       {-1.4, .8},
       {-1.2, .8},
       {-1.1, .7},
       {-1, .01},
       {-1.4, .9},
       {-1.1, .7},
       {-1.2, .6},
       {-1.2, .7}}}},
    {"origin_distance_m",
     {{{4.4, 3.7},
       {4.6, 3.4},
       {5.5, 4.9},
       {7.5, 6.9},
       {1.8, 1.7},
       {5.2, 3.8},
       {8.5, 11.3},
       {2.7, 1.8},
       {4.6, 4.1}}}},
};

/// Size of the incident momentum [g cm/s].
constexpr std::array<double, 9> incident_momentum = {18850, 18850, 18850, 18850, 6283,
                                                     25133, 18850, 9425,  12723};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::optional<PrintedValue> printed_value(const std::string& thesis_case, const std::string& quantity) {
  const auto row = tables.find(quantity);
  if (row == tables.end() || thesis_case.size() != 1) return std::nullopt;
  const auto index = static_cast<std::size_t>(thesis_case[0] - 'A');
  if (index >= row->second.size()) return std::nullopt;
  PrintedValue value = row->second[index];
  if (value.half_width < 0) return std::nullopt;
  double factor = 1;
  if (ends_with(quantity, "_m") || ends_with(quantity, "_m_s")) factor = 0.01;
  if (quantity.rfind("ejected_momentum", 0) == 0) factor = 1 / incident_momentum[index];
  return PrintedValue{factor * value.mean, factor * value.half_width};
}

}  // namespace aeolian
