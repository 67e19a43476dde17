// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>
#include <string>

namespace ps {

/// A failure that a person must hear of. The message says what happened, where, and what to do, in that order:
/// "ice.json:/materials/0/id: must be a name, not a number".
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bad input (a project, a number, an argument): the command line answers with exit code 2.
class InputError : public Error {
 public:
  using Error::Error;
};

}  // namespace ps
