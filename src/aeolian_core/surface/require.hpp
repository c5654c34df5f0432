#pragma once

#include <string_view>

namespace aeolian {

/// Refuses numbers that are not allowed, in the words that all rooms use.
///
///     constexpr Require require{"bed"};
///     require(radius > 0, "radius", radius, "positive");  // bed: radius is -1, must be positive
class Require {
 public:
  /// `what` the numbers belong to, a literal.
  constexpr explicit Require(const char* what) : what_(what) {}

  /// Throws Error "WHAT: PROPERTY is VALUE, must be RANGE" unless allowed.
  void operator()(bool allowed, std::string_view property, double value, std::string_view range) const {
    if (!allowed) refuse(property, value, range);
  }
  [[noreturn]] void refuse(std::string_view property, double value, std::string_view range) const;

 private:
  const char* what_;
};

}  // namespace aeolian
