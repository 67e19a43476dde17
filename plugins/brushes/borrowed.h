// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <type_traits>
#include <utility>

namespace ps::brushes {

template <class Signature>
class Borrowed;

/// A function that is lent for the time of a call, as an argument: unlike std::function it copies nothing, and so
/// allocates nothing for each sample of a stroke.
template <class Result, class... Arguments>
class Borrowed<Result(Arguments...)> {
 public:
  template <class Function>
  requires(!std::is_same_v<Function, Borrowed>) Borrowed(const Function& function)  // NOLINT: lent by writing it down
      : m_function(std::addressof(function)), m_call([](const void* lent, Arguments... arguments) -> Result {
          return (*static_cast<const Function*>(lent))(std::forward<Arguments>(arguments)...);
        }) {}
  Result operator()(Arguments... arguments) const { return m_call(m_function, std::forward<Arguments>(arguments)...); }

 private:
  const void* m_function;
  Result (*m_call)(const void*, Arguments...);
};

}  // namespace ps::brushes
