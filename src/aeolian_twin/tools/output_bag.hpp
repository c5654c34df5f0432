#pragma once

#include <functional>
#include <memory>
#include <string>

#include <rosbag/bag.h>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {

/// Writes a compressed bag beside its place and renames it, for programs that end when it cannot be. Throws
/// Error naming the bag.
inline void write_bag_atomically(const std::string& path, const std::function<void(rosbag::Bag&)>& write) {
  write_atomically(path, [&](const std::string& temporary) {
    auto bag = std::make_unique<rosbag::Bag>();
    try {
      bag->open(temporary, rosbag::bagmode::Write);
      bag->setCompression(rosbag::compression::LZ4);
      write(*bag);
      bag->close();
    } catch (const rosbag::BagException& error) {
      // Its destructor would try to finish the file, throw again and so abort the program, which is about to
      // end anyway.
      static_cast<void>(bag.release());
      throw Error("bag '" + path + "': " + error.what());
    }
  });
}

}  // namespace aeolian
