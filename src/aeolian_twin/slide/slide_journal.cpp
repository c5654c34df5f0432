#include <filesystem>

#include <fmt/format.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"
#include "aeolian_twin/slide/slide_jobs.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t numbers_of_pile = 5;

std::string joined(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) {
    if (!text.empty()) text += ',';
    append_number(text, number);
  }
  return text;
}

/// All numbers that decide a job.
std::string key_of(const SlideJob& job) {
  const SlideScene& s = job.scene;
  const SnowLaw& w = s.snow;
  return joined({static_cast<double>(w.yield),
                 w.density,
                 w.youngs_modulus,
                 w.poisson_ratio,
                 w.friction,
                 w.consolidation,
                 w.cohesion,
                 w.hardening,
                 s.panel_length,
                 s.panel_width,
                 s.tilt,
                 s.panel_height,
                 static_cast<double>(s.height_of),
                 s.panel_friction,
                 s.slab_thickness,
                 s.slab_width,
                 s.cell,
                 s.particles_per_cell,
                 s.jitter,
                 static_cast<double>(s.transfer),
                 static_cast<double>(s.between),
                 static_cast<double>(s.seed),
                 s.still,
                 s.still_for,
                 s.longest,
                 s.stuck_after,
                 static_cast<double>(job.events),
                 static_cast<double>(job.dimensions)});
}

std::string line_of(const std::string& key, const SlideOutcome& outcome) {
  std::vector<double> numbers;
  for (const PileSize& p : outcome.piles)
    for (const double v : {p.height, p.length, p.head, p.tail, p.raw_length}) numbers.push_back(v);
  return key + "|" + joined(numbers) + "|" + outcome.ended + "\n";
}

/// Nothing when it is no such line.
std::optional<std::pair<std::string, SlideOutcome>> read_line(std::string_view line) {
  const std::size_t first = line.find('|');
  const std::size_t second = first == std::string_view::npos ? first : line.find('|', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  std::vector<double> numbers;
  for (std::string_view rest = line.substr(first + 1, second - first - 1); !rest.empty();) {
    const std::size_t comma = rest.find(',');
    const auto number = parse_number(rest.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  if (numbers.size() % numbers_of_pile != 0) return std::nullopt;
  SlideOutcome outcome;
  outcome.ended = line.substr(second + 1);
  for (std::size_t k = 0; k < numbers.size(); k += numbers_of_pile) {
    PileSize pile;
    pile.height = numbers[k];
    pile.length = numbers[k + 1];
    pile.head = numbers[k + 2];
    pile.tail = numbers[k + 3];
    pile.raw_length = numbers[k + 4];
    outcome.piles.push_back(pile);
  }
  return std::pair(std::string(line.substr(0, first)), outcome);
}

std::string name_of(std::size_t rank) {
  return rank == 0 ? "unfinished.csv" : fmt::format("unfinished.{}.csv", rank);
}

std::vector<std::string> journals_in(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().rfind("unfinished", 0) == 0 && entry.path().extension() == ".csv")
      paths.push_back(entry.path().string());
  return paths;
}

void remove_journals(const std::string& folder) {
  for (const std::string& path : journals_in(folder)) fs::remove(path);
}

}  // namespace

SlideJournal::SlideJournal(const std::string& folder, const std::string& settings, bool fresh,
                           const Ranks& ranks)
    : path_(folder + "/" + name_of(ranks.rank())) {
  std::string head = "# aeolian: slides of a study that is not finished; the same command goes on\n";
  for (std::string_view rest = settings; !rest.empty();) head += "# " + std::string(take_line(rest)) + "\n";
  std::string own = head;
  if (fresh && ranks.rank() == 0) remove_journals(folder);
  if (!fresh)
    for (const std::string& path : journals_in(folder)) {
      const std::string text = read_text(path, "slide study");
      const std::string whole = text.substr(0, text.rfind('\n') + 1);
      if (whole.empty()) continue;
      if (whole.compare(0, head.size(), head) != 0)
        throw Error(path +
                    ": is of a study with other settings; give another --out, or --fresh to begin anew");
      take(whole.substr(head.size()), path);
      if (path == path_) own = whole;
    }
  ranks.share("");  // all have read before one writes
  write_text_atomically(path_, own);
  file_.open(path_, std::ios::app);
}

const SlideOutcome* SlideJournal::find(const SlideJob& job) const {
  const auto found = done_.find(key_of(job));
  return found == done_.end() ? nullptr : &found->second;
}

void SlideJournal::add(const SlideJob& job, const SlideOutcome& outcome) {
  const std::string key = key_of(job);
  file_ << line_of(key, outcome) << std::flush;
  if (!file_) throw Error(path_ + ": cannot be written");
  done_[key] = outcome;
}

void SlideJournal::finish() {
  file_.close();
  remove_journals(fs::path(path_).parent_path().string());
}

std::string SlideJournal::lines_of(const std::vector<SlideJob>& jobs) const {
  std::string text;
  for (const SlideJob& job : jobs) {
    const auto found = done_.find(key_of(job));
    if (found != done_.end()) text += line_of(found->first, found->second);
  }
  return text;
}

void SlideJournal::take(const std::string& lines, const std::string& from) {
  for (std::string_view rest = lines; !rest.empty();) {
    const std::string_view line = take_line(rest);
    const auto read = read_line(line);
    if (!read)
      throw Error(from + ": '" + std::string(line.substr(0, 40)) +
                  "...' is no outcome of a slide; --fresh begins the study anew");
    done_.insert(*read);
  }
}

}  // namespace aeolian
