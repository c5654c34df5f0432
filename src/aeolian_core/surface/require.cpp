#include "aeolian_core/surface/require.hpp"

#include <sstream>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

void Require::refuse(std::string_view property, double value, std::string_view range) const {
  std::ostringstream text;
  text << what_ << ": " << property << " is " << value << ", must be " << range;
  throw Error(text.str());
}

}  // namespace aeolian
