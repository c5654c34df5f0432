#include <array>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/splash/impact_picture.hpp"
#include "aeolian_twin/splash/webp_animation.hpp"

namespace aeolian {
namespace {

/// Of Werner's (1987) fig. 3.1, for grains of radius 1 cm [s].
constexpr std::array<double, 9> thesis_times = {0, .0021, .0049, .0070, .0170, .0270, .0370, .0570, .0700};
const double thesis_unit = std::sqrt(0.01 / gravity);

void write_picture(const cv::Mat& picture, const std::string& path) {
  cv::Mat colours;
  cv::cvtColor(picture, colours, cv::COLOR_BGRA2BGR);
  write_atomically(path, [&](const std::string& temporary) {
    if (!cv::imwrite(temporary, colours)) throw Error("picture '" + path + "': cannot be written");
  });
}

/// Slow at first, when all happens at once.
std::vector<double> moving_times(double unit, double end) {
  std::vector<double> times;
  double step = 0.008 * unit;
  for (int i = -14; i < 0; ++i) times.push_back(i * step);
  for (double time = 0; time < end; time += step) {
    times.push_back(time);
    if (time > 0.16 * unit) step = std::min(step * 1.06, 0.03 * unit);
  }
  return times;
}

template <int Dim>
void write_moving(const Bed<Dim>& bed, const Shot& shot, const ImpactRules& rules, const std::string& title,
                  const std::string& path) {
  const double unit = std::sqrt(bed.radius / gravity);
  const Film film = film_impact<Dim>(bed, shot, rules, moving_times(unit, rules.follow * unit));
  const ImpactPicture picture(film, title, 720);
  const cv::Mat first = picture.draw(0);
  WebpAnimation animation(first.cols, first.rows);
  for (std::size_t i = 0; i < film.frames.size(); ++i)
    animation.add(picture.draw(i), i + 1 == film.frames.size() ? 1500 : 50);
  animation.write(path);
}

}  // namespace

template <int Dim>
void write_impact_pictures(const Bed<Dim>& bed, const Shot& shot, const ImpactRules& rules,
                           const std::string& title, const std::string& folder) {
  const double unit = std::sqrt(bed.radius / gravity);
  std::vector<double> times;
  for (const double time : thesis_times)
    times.push_back(std::min(time / thesis_unit, 0.9999 * rules.follow) * unit);
  const Film film = film_impact<Dim>(bed, shot, rules, times);
  const ImpactPicture picture(film, title, 1200);
  std::vector<cv::Mat> rows(3);
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    const cv::Mat frame = picture.draw(i);
    write_picture(frame, fmt::format("{}/impact_{:02}.png", folder, i));
    cv::Mat small;
    cv::resize(frame, small, {}, 0.5, 0.5, cv::INTER_AREA);
    cv::copyMakeBorder(small, small, 4, 4, 4, 4, cv::BORDER_CONSTANT, cv::Scalar::all(200));
    cv::Mat& row = rows[i / 3];
    if (row.empty())
      row = small;
    else
      cv::hconcat(row, small, row);
  }
  cv::Mat all;
  cv::vconcat(rows, all);
  write_picture(all, folder + "/impact.png");
  write_moving<Dim>(bed, shot, rules, title, folder + "/impact.webp");
}

template void write_impact_pictures(const Bed<2>&, const Shot&, const ImpactRules&, const std::string&,
                                    const std::string&);
template void write_impact_pictures(const Bed<3>&, const Shot&, const ImpactRules&, const std::string&,
                                    const std::string&);

}  // namespace aeolian
