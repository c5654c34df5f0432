#pragma once

#include <map>
#include <mutex>
#include <string>

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/time.h>

namespace aeolian {

/// What a node says about itself: for each thing it cares about ("clouds", "transform") whether that is well,
/// in one line, and since when. Safe to use from any thread.
class Health {
 public:
  /// Each returns whether the log should have the line too: a complaint that is new, or has changed and was
  /// not told in the last ten seconds; the end of one that was told.
  bool good(const std::string& thing, const std::string& line);
  bool bad(const std::string& thing, const std::string& line);

  /// WARN with all complaints when there is any, else OK; every thing with its line and since when as a key
  /// and value. A complaint is reported at least once, however soon things were well again.
  void fill(diagnostic_msgs::DiagnosticStatus& status);

 private:
  struct State {
    bool good = true;
    std::string line;
    std::string unreported;  ///< complaint that no report has shown yet
    std::string told;        ///< complaint that the log has
    ros::WallTime told_at;
    ros::WallTime since;
  };
  static void set(State& state, bool good, const std::string& line);

  std::mutex mutex_;
  std::map<std::string, State> things_;
};

}  // namespace aeolian
