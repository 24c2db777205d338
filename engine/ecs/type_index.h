// Small sequential numbers for types, so that a typed look-up is an array access. They differ from run to run: never store them.
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

namespace antumbra::ecs {

/// 1, 2, 3...
uint32_t takeTypeIndex();

namespace detail {

template <class T>
struct TypeIndex
{
    static inline const uint32_t value = takeTypeIndex();
};

} // namespace detail

/// The same for T and const T. Zero before main has begun: no World lives that early.
template <class T>
uint32_t typeIndex()
{
    return detail::TypeIndex<std::remove_const_t<T>>::value;
}

/// The name as the compiler writes it, for messages.
template <class T>
constexpr std::string_view typeName()
{
    const std::string_view text = __PRETTY_FUNCTION__; // "... [with T = NAME; ...]" or "... [T = NAME]"
    const size_t first = text.find("T = ") + 4;
    return text.substr(first, text.find_first_of(";]", first) - first);
}

} // namespace antumbra::ecs
