#include "aeolian_core/twin/report_tables.hpp"

#include <utility>

namespace aeolian {
namespace {

/// Every number of a comparison with the name of its column.
const std::vector<std::pair<const char*, double Comparison::*>> score_columns{
    {"rmse_m", &Comparison::rmse},
    {"rmse_persistence_m", &Comparison::rmse_persistence},
    {"rmse_translation_m", &Comparison::rmse_translation},
    {"skill_persistence", &Comparison::skill_persistence},
    {"skill_translation", &Comparison::skill_translation},
    {"bias_m", &Comparison::bias},
    {"nmad_m", &Comparison::nmad},
    {"volume_change_measured_m3", &Comparison::volume_change_measured},
    {"volume_change_predicted_m3", &Comparison::volume_change_predicted},
    {"wavelength_measured_m", &Comparison::wavelength_measured},
    {"wavelength_predicted_m", &Comparison::wavelength_predicted},
    {"height_measured_m", &Comparison::height_measured},
    {"height_predicted_m", &Comparison::height_predicted},
    {"displacement_measured_m", &Comparison::displacement_measured},
    {"displacement_predicted_m", &Comparison::displacement_predicted},
};

/// Adds a column with the value of `get` for every item.
template <class Items, class Get>
void add_column(Table& table, const std::string& name, const Items& items, Get get) {
  table.names.push_back(name);
  std::vector<double>& column = table.columns.emplace_back();
  for (const auto& item : items) column.push_back(static_cast<double>(get(item)));
}

}  // namespace

Table ripple_table(const Run& run) {
  using State = Run::State;
  Table table;
  add_column(table, "time_s", run.states, [](const State& s) { return s.time; });
  add_column(table, "wavelength_m", run.states, [](const State& s) { return s.wavelength; });
  add_column(table, "height_m", run.states, [](const State& s) { return s.height; });
  add_column(table, "known_share", run.states, [](const State& s) { return s.known_share; });
  add_column(table, "friction_velocity_m_s", run.states, [](const State& s) { return s.friction_velocity; });
  return table;
}

Table score_table(const Run& run) {
  using Score = Run::Score;
  Table table;
  add_column(table, "time_s", run.scores, [](const Score& s) { return s.time; });
  add_column(table, "lead_time_s", run.scores, [](const Score& s) { return s.lead_time; });
  add_column(table, "cells", run.scores, [](const Score& s) { return s.comparison.cells; });
  for (const auto& [name, number] : score_columns) {
    const auto member = number;
    add_column(table, name, run.scores, [member](const Score& s) { return s.comparison.*member; });
  }
  return table;
}

Table lead_table(const std::vector<LeadSummary>& leads) {
  Table table;
  add_column(table, "lead_time_s", leads, [](const LeadSummary& l) { return l.lead_time; });
  add_column(table, "forecasts", leads, [](const LeadSummary& l) { return l.scores.size(); });
  for (const auto& [name, number] : score_columns) {
    const auto member = number;
    const std::string column = name;
    add_column(table, column + "_median", leads,
               [member](const LeadSummary& l) { return l.spread(member).median; });
    add_column(table, column + "_lower_quartile", leads,
               [member](const LeadSummary& l) { return l.spread(member).lower; });
    add_column(table, column + "_upper_quartile", leads,
               [member](const LeadSummary& l) { return l.spread(member).upper; });
  }
  return table;
}

}  // namespace aeolian
