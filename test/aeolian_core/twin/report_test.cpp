#include "aeolian_core/twin/report.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>
#include <stdlib.h>

#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/forecast.hpp"

namespace aeolian {
namespace {

using TwinRun = Run;  // within a test, Run is a function of its base

const GridGeometry grid(0, 0, 0.005, 60, 40);

HeightMap map_of(double shift) {
  HeightMap map(grid);
  HeightMap::Layer& z = map.add(layer::elevation, 0);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(0.003 * std::sin(2 * M_PI * (grid.x(grid.cell_at(i).x) - shift) / 0.08));
  return map;
}

Run::Score score_of(double time, double lead, double rmse) {
  Comparison c;
  c.cells = grid.size();
  c.rmse = rmse;
  c.rmse_persistence = 2 * rmse;
  c.rmse_translation = 1.5 * rmse;
  c.skill_persistence = 0.75;
  c.skill_translation = 1 - 1 / 2.25;
  c.bias = -0.00002;
  c.wavelength_measured = 0.0812;
  c.wavelength_predicted = 0.0779;
  c.height_measured = c.height_predicted = 0.0043;
  c.displacement_measured = 0.0123;
  c.displacement_predicted = NAN;
  c.volume_change_measured = 1.5e-5;
  return {time, lead, c};
}

/// A run of ten minutes with two lead times; numbers chosen to be found again in the page.
Run make_run() {
  Run run;
  run.title = "Plot <7> & \"neighbours\"";
  run.source = "field.bag";
  run.wind_direction = 0;
  for (int t = 0; t <= 600; t += 60)
    run.states.push_back({double(t), t < 120 ? NAN : 0.08, 0.004, 0.9, 0.31});
  for (int t = 120; t <= 600; t += 60) run.scores.push_back(score_of(t, 60, 0.00123));
  for (int t = 360; t <= 600; t += 60) run.scores.push_back(score_of(t, 300, 0.00456));
  run.forecasts = 20;
  run.measured = map_of(0.02);
  run.forecast = map_of(0.018);
  run.forecast.add(layer::initial, map_of(0).layer(layer::elevation));
  run.forecast_lead = 300;
  return run;
}

class Report : public testing::Test {
 protected:
  std::string write(const TwinRun& run) const {
    write_report(run, folder_.file("report"));
    return content_of(folder_.file("report/index.html"));
  }
  std::string file(const std::string& name) const { return folder_.file("report/" + name); }

  /// Every picture and table that the page names is there, every element is closed, and no number is "nan".
  void expect_whole(const std::string& page) const {
    const std::regex link("(?:src|href)=\"([^\"]+)\"");
    std::size_t links = 0;
    for (std::sregex_iterator it(page.begin(), page.end(), link), end; it != end; ++it, ++links) {
      const std::string target = (*it)[1];
      EXPECT_EQ(target.find("//"), std::string::npos) << target << ": the page must need no network";
      EXPECT_TRUE(std::filesystem::exists(file(target))) << target;
      EXPECT_GT(std::filesystem::file_size(file(target)), 0U) << target;
    }
    EXPECT_GT(links, 0U);
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_FALSE(std::regex_search(page, std::regex("[>\\s(-]nan\\b", std::regex::icase)));
    for (const std::string element : {"html", "body", "main", "div", "table", "thead", "tbody", "tr", "td",
                                      "th", "figure", "figcaption", "p", "h2", "svg", "style"}) {
      const auto count = [&](const std::string& pattern) {
        const std::regex regex(pattern);
        return std::distance(std::sregex_iterator(page.begin(), page.end(), regex), std::sregex_iterator());
      };
      EXPECT_EQ(count("<" + element + "[ >]"), count("</" + element + ">")) << element;
    }
  }

  const TemporaryFolder folder_;
};

TEST_F(Report, ShowsTheNumbersOfTheRun) {
  const std::string page = write(make_run());
  expect_whole(page);
  // Longest lead in the verdict; both leads in the table.
  EXPECT_NE(page.find("Looking 5 min ahead"), std::string::npos);
  EXPECT_NE(page.find("4.56 mm against 9.12 mm"), std::string::npos);
  EXPECT_NE(page.find("median of 5 forecasts; skill +0.75"), std::string::npos);
  for (const char* number :
       {">1.23<", ">4.56<", ">2.46<", ">6.84<", ">+0.75<", ">+0.56<", ">−0.020<", ">8.12<", ">7.79<",
        ">12.3<", ">15.0<", "30.0 × 20.0 cm", "60 × 40 of 5.00 mm", "from 270°"})
    EXPECT_NE(page.find(number), std::string::npos) << number;
  EXPECT_NE(page.find("not available"), std::string::npos);  // the displacement of the forecast
  EXPECT_NE(page.find("Plot &lt;7&gt; &amp; &quot;neighbours&quot;"), std::string::npos);
  for (const char* picture :
       {"measured.png", "forecast.png", "change.png", "difference.png", "growth.svg", "skill.svg"})
    EXPECT_NE(page.find(picture), std::string::npos) << picture;
}

TEST_F(Report, TablesHoldEveryScore) {
  write(make_run());
  const Table scores = read_csv(file("scores.csv"));
  ASSERT_EQ(scores.rows(), 14U);
  EXPECT_EQ(scores.column("rmse_m")[0], 0.00123);
  EXPECT_EQ(scores.column("lead_time_s")[13], 300);
  EXPECT_TRUE(std::isnan(scores.column("displacement_predicted_m")[0]));
  const Table leads = read_csv(file("lead_times.csv"));
  EXPECT_EQ(leads.column("lead_time_s"), (std::vector<double>{60, 300}));
  EXPECT_EQ(leads.column("forecasts"), (std::vector<double>{9, 5}));
  EXPECT_EQ(leads.column("rmse_m_median"), (std::vector<double>{0.00123, 0.00456}));
  EXPECT_EQ(read_csv(file("ripples.csv")).rows(), 11U);
}

TEST_F(Report, ComparesWithTheTruthOnAnotherGrid) {
  TwinRun run = make_run();
  HeightMap truth(GridGeometry(-0.01, -0.01, 0.0025, 128, 88));
  truth.add(layer::elevation, 0);
  run.truth = truth;
  for (float& z : run.measured.layer(layer::elevation)) z = 0.00077F;
  const std::string page = write(run);
  expect_whole(page);
  EXPECT_NE(page.find("map_error.png"), std::string::npos);
  EXPECT_NE(page.find(">0.770<"), std::string::npos);
}

TEST_F(Report, SaysWhyThereAreNoScores) {
  TwinRun run = make_run();
  run.scores.clear();
  run.forecast = HeightMap();
  const std::string page = write(run);
  expect_whole(page);
  EXPECT_NE(page.find("No forecast could be scored: 20 forecasts were made"), std::string::npos);
  EXPECT_EQ(page.find("skill.svg"), std::string::npos);
  run.forecasts = 0;
  EXPECT_NE(write(run).find("No forecast could be scored: the run holds no forecast."), std::string::npos);
}

TEST_F(Report, DoesNotPraiseAForecastThatIsWorse) {
  TwinRun run = make_run();
  for (TwinRun::Score& score : run.scores) score.comparison.skill_persistence = -0.3;
  EXPECT_NE(write(run).find("is worse than assuming that nothing changes"), std::string::npos);
  for (TwinRun::Score& score : run.scores) score.comparison.skill_persistence = 0.01;
  EXPECT_NE(write(run).find("as good as assuming that nothing changes, and no better"), std::string::npos);
}

TEST_F(Report, SurvivesARunWithoutRipplesOrWind) {
  TwinRun run = make_run();
  for (TwinRun::State& state : run.states) state.wavelength = state.height = state.friction_velocity = NAN;
  for (TwinRun::Score& score : run.scores) {
    Comparison& c = score.comparison;
    c.wavelength_measured = c.wavelength_predicted = c.displacement_measured = NAN;
    c.skill_persistence = c.skill_translation = -INFINITY;
    c.rmse_persistence = c.rmse_translation = 0;
  }
  run.wind_direction = NAN;
  expect_whole(write(run));
}

TEST_F(Report, OfASingleMapAtTimeZero) {
  TwinRun run = make_run();
  run.states.resize(1);
  run.scores.clear();
  expect_whole(write(run));
}

TEST_F(Report, NeedsAMapAndADirectory) {
  TwinRun run = make_run();
  EXPECT_NE(error_of([&] { write_report(run, "/proc/report"); }).find("/proc/report"), std::string::npos);
  run.measured = HeightMap(grid);
  EXPECT_EQ(error_of([&] { write(run); }), "report: there is no measured map");
  run.measured.add(layer::elevation);
  EXPECT_EQ(error_of([&] { write(run); }), "report: there is no measured map");
}

TEST_F(Report, SaysThatGnuplotIsMissing) {
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  const std::string message = error_of([&] { write(make_run()); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("gnuplot cannot be run"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(file("index.html")));
}

}  // namespace
}  // namespace aeolian
