#pragma once

#include <cstdlib>
#include <string>

#include "child_process.hpp"
#include <unistd.h>

namespace aeolian::bench {

/// A ROS master of this program's own, which what it starts will find, too.
class OwnMaster {
 public:
  OwnMaster() {
    setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + port_).c_str(), 1);
    setenv("ROS_IP", "127.0.0.1", 1);
  }

 private:
  std::string port_ = std::to_string(20000 + ::getpid() % 20000);
  ChildProcess master_{{"rosmaster", "--core", "-p", port_}, SIGINT, ChildProcess::Output::dropped};
};

}  // namespace aeolian::bench
