#pragma once

#include <stdexcept>

namespace aeolian {

/// Bad input, told in one line: what, where, which value, what is allowed.
/// Programs print it and exit non-zero; nodes put it into their diagnostics and keep their last good state.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace aeolian
