#include "aeolian_core/twin/plot_data.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

const char* const plot_style = R"(
set border 3 lc rgb '#8a7f76'
set tics nomirror out scale 0.5 textcolor rgb '#4a413b'
set grid y lc rgb '#e6dfd6' lw 1
set key textcolor rgb '#4a413b'
set datafile missing 'nan'
measured = '#2e2723'
forecast = '#c2571a'
truth = '#e0bd8a'
baseline = '#8a8f98'
second = '#3c6e9f'
)";

bool Curve::has_value() const {
  return std::any_of(y.begin(), y.end(), [](double v) { return std::isfinite(v); });
}

double Curve::largest() const {
  double result = 0;
  for (const double v : y)
    if (std::isfinite(v)) result = std::max(result, v);
  return result;
}

Curve Curve::scaled(double factor_x, double factor_y) const {
  Curve result = *this;
  for (double& v : result.x) v *= factor_x;
  for (auto* column : {&result.y, &result.lower, &result.upper})
    for (double& v : *column) v *= factor_y;
  return result;
}

void write_data(std::ostream& out, const std::string& name, const Curve& curve) {
  out << "$" << name << " << EOD\n";
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    out << curve.x[i];
    for (const auto* column : {&curve.y, &curve.lower, &curve.upper}) {
      if (column->empty()) continue;
      if (std::isfinite((*column)[i]))
        out << ' ' << (*column)[i];
      else
        out << " nan";
    }
    out << '\n';
  }
  out << "EOD\n";
}

double tic_step(double range) {
  const double rough = range / 4;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  const double first = rough / power;
  return power * (first < 1.5 ? 1 : first < 3.5 ? 2 : first < 7.5 ? 5 : 10);
}

}  // namespace aeolian
