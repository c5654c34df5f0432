#pragma once

#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

/// The message of the Error that `call` throws; says so when there is none.
template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error was thrown";
}

}  // namespace aeolian
