// ripple_theory: redraws Werner's (1987) theory of ripples that collide and merge, and Haff's bed, as tables
// and pictures.

#include <cstdint>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_twin/tools/collision_pictures.hpp"
#include "aeolian_twin/tools/haff_picture.hpp"
#include "aeolian_twin/tools/program.hpp"
#include "aeolian_twin/tools/worm_picture.hpp"

namespace aeolian {
namespace {

constexpr const char* description =
    R"(Redraws Werner's (1987) theory of wind ripples as tables and pictures.

    ripple_theory --out DIR [--seed S]

Written to DIR, each as CSV and SVG: collisions (triangular ripples that run into each other, by target and by brink
ejection), limiting_wavelengths (how long ripples can be and still merge), worms (growth of worms on a ring, mergers of
two), haff (profiles of Haff's bed, with and without a limit to the stoss). Takes some ten seconds.)";

int run(int argc, char** argv) {
  CLI::App app(description);
  std::string out;
  std::uint64_t seed = 1;
  app.add_option("--out", out, "folder for the results, created when it does not exist")->required();
  app.add_option("--seed", seed, "decides everything random, default 1");
  if (const auto code = parse(app, argc, argv)) return *code;
  make_directory(out);
  draw_collisions(out);
  draw_limiting_wavelengths(out);
  draw_worms(out, seed);
  draw_haff(out, seed);
  fmt::print("collisions, limiting_wavelengths, worms, haff -> {}\n", out);
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  return aeolian::run_program("ripple_theory", [&] { return aeolian::run(argc, argv); });
}