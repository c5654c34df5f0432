#pragma once

#include <pcl/console/print.h>

namespace aeolian {

/// While it lives PCL prints nothing of its own.
class QuietPcl {
 public:
  QuietPcl() : before_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }

 private:
  pcl::console::VERBOSITY_LEVEL before_;
};

}  // namespace aeolian
