#include "aeolian_twin/nodes/health.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace aeolian {

void Health::set(State& state, bool good, const std::string& line) {
  if (state.since.isZero() || state.good != good) state.since = ros::WallTime::now();
  state.good = good;
  state.line = line;
}

bool Health::good(const std::string& thing, const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  State& state = things_[thing];
  set(state, true, line);
  const bool ends_a_complaint = !state.told.empty();
  state.told.clear();
  return ends_a_complaint;
}

bool Health::bad(const std::string& thing, const std::string& line) {
  const std::lock_guard<std::mutex> lock(mutex_);
  State& state = things_[thing];
  set(state, false, line);
  state.unreported = line;
  const ros::WallTime now = ros::WallTime::now();
  const bool recently = !state.told_at.isZero() && now - state.told_at < ros::WallDuration(10.0);
  if (recently || state.told == line) return false;
  state.told = line;
  state.told_at = now;
  return true;
}

void Health::fill(diagnostic_msgs::DiagnosticStatus& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string complaints;
  for (auto& [thing, state] : things_) {
    const std::time_t since = state.since.sec;
    diagnostic_msgs::KeyValue entry;
    entry.key = thing;
    entry.value = fmt::format("{} (since {:%H:%M:%S} UTC)", state.line, fmt::gmtime(since));
    status.values.push_back(entry);
    const std::string& complaint = state.good ? state.unreported : state.line;
    if (!complaint.empty()) complaints += (complaints.empty() ? "" : "; ") + complaint;
    state.unreported.clear();
  }
  status.level =
      complaints.empty() ? diagnostic_msgs::DiagnosticStatus::OK : diagnostic_msgs::DiagnosticStatus::WARN;
  status.message = complaints.empty() ? "running" : complaints;
}

}  // namespace aeolian
