#include "aeolian_twin/splash/study_journal.hpp"

#include <cmath>
#include <filesystem>
#include <optional>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

/// What a row holds, in its order; the archive writes or reads each number.
/// @{
template <class Archive>
void exchange(Archive& row, FirstContact& c) {
  row(c.target, c.step, c.normal_angle, c.approach, c.departure, c.struck, c.effective_mass);
}
template <class Archive>
void exchange(Archive& row, RisenGrain& g) {
  row(g.grain, g.time, g.radius, g.spin, g.place, g.velocity, g.origin, g.layer, g.kind);
}
template <class Archive>
void exchange(Archive& row, ImpactOutcome& o) {
  row(o.number, o.shot.speed, o.shot.angle, o.shot.size_ratio, o.shot.along, o.shot.across, o.incident_mass,
      o.steps, o.contact, o.rebound, o.ejecta);
}
/// @}

class Writer {
 public:
  template <class... Parts>
  void operator()(Parts&... parts) {
    (add(parts), ...);
  }
  const std::string& text() const { return text_; }

 private:
  void add(double value) {
    if (!text_.empty()) text_ += ',';
    append_number(text_, value);
  }
  void add(Origin origin) { add(static_cast<double>(origin)); }
  void add(Eigen::Vector3d& vector) { (*this)(vector.x(), vector.y(), vector.z()); }
  template <class Part>
  void add(std::optional<Part>& part) {
    add(part ? 1.0 : 0.0);
    if (part) exchange(*this, *part);
  }
  void add(std::vector<RisenGrain>& grains) {
    add(static_cast<double>(grains.size()));
    for (RisenGrain& grain : grains) exchange(*this, grain);
  }
  std::string text_;
};

/// Tells by whole() whether the row was one.
class Reader {
 public:
  explicit Reader(std::string_view row) : rest_(row) {}

  template <class... Parts>
  void operator()(Parts&... parts) {
    (take(parts), ...);
  }
  bool whole() const { return good_ && rest_.empty(); }

 private:
  double number() {
    const std::size_t comma = rest_.find(',');
    const auto value = parse_number(rest_.substr(0, comma));
    good_ = good_ && value;
    rest_.remove_prefix(comma == std::string_view::npos ? rest_.size() : comma + 1);
    return value.value_or(0);
  }
  /// A whole number up to `most`.
  int count(int most) {
    const double value = number();
    good_ = good_ && value >= 0 && value <= most && value == std::floor(value);
    return good_ ? static_cast<int>(value) : 0;
  }
  void take(double& value) { value = number(); }
  void take(int& value) {
    const double read = number();
    good_ = good_ && std::abs(read) < 1e9;
    value = good_ ? static_cast<int>(read) : 0;
  }
  void take(Origin& origin) { origin = static_cast<Origin>(count(static_cast<int>(Origin::other))); }
  void take(Eigen::Vector3d& vector) { (*this)(vector.x(), vector.y(), vector.z()); }
  template <class Part>
  void take(std::optional<Part>& part) {
    if (count(1) == 0) return;
    part.emplace();
    exchange(*this, *part);
  }
  void take(std::vector<RisenGrain>& grains) {
    grains.resize(static_cast<std::size_t>(count(1000000)));
    for (RisenGrain& grain : grains) exchange(*this, grain);
  }

  std::string_view rest_;
  bool good_ = true;
};

}  // namespace

StudyJournal::StudyJournal(const std::string& folder, const std::string& settings, bool fresh)
    : path_(folder + "/unfinished.csv") {
  std::string head = "# aeolian: impacts of a study that is not finished; the same command goes on\n";
  for (std::string_view rest = settings; !rest.empty();) head += "# " + std::string(take_line(rest)) + "\n";
  std::string kept = head;
  if (!fresh && std::filesystem::exists(path_)) {
    const std::string text = read_text(path_, "splash study");
    if (text.compare(0, head.size(), head) != 0)
      throw Error(path_ +
                  ": is of a study with other settings; give another --out, or --fresh to begin anew");
    kept = text.substr(0, text.rfind('\n') + 1);
    read(kept.substr(head.size()));
  }
  write_text_atomically(path_, kept);
  file_.open(path_, std::ios::app);
}

void StudyJournal::read(const std::string& text) {
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view line = take_line(rest);
    Reader row(line);
    int point = 0;
    ImpactOutcome outcome;
    row(point);
    exchange(row, outcome);
    if (!row.whole() || point < 0)
      throw Error(path_ + ": '" + std::string(line.substr(0, 40)) +
                  "...' is no impact; --fresh begins the study anew");
    points_[static_cast<std::size_t>(point)][outcome.number] = std::move(outcome);
  }
}

std::vector<ImpactOutcome> StudyJournal::done(std::size_t point) const {
  std::vector<ImpactOutcome> outcomes;
  const auto found = points_.find(point);
  if (found == points_.end()) return outcomes;
  for (const auto& [number, outcome] : found->second) outcomes.push_back(outcome);
  return outcomes;
}

std::size_t StudyJournal::count() const {
  std::size_t sum = 0;
  for (const auto& [point, outcomes] : points_) sum += outcomes.size();
  return sum;
}

void StudyJournal::add(std::size_t point, const ImpactOutcome& outcome) {
  Writer row;
  auto number = static_cast<int>(point);
  ImpactOutcome written = outcome;
  row(number);
  exchange(row, written);
  file_ << row.text() + "\n" << std::flush;
  if (!file_) throw Error(path_ + ": cannot be written");
}

void StudyJournal::finish() {
  file_.close();
  std::filesystem::remove(path_);
}

}  // namespace aeolian
