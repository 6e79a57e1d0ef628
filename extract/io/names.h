#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace stride {

/// Whether an enumerator has this value: compilers print `E::name` or, of another value, `(E)7`.
template <auto kValue>
consteval bool is_enumerator() {
  const std::string_view signature = __PRETTY_FUNCTION__;
  const std::size_t value = signature.rfind("kValue = ");
  return signature.at(value + std::string_view("kValue = ").size()) != '(';
}

/// Number of enumerators of an enumeration whose values are 0, 1, 2, …
template <typename Enum, int kFrom = 0>
consteval std::size_t enumerator_count() {
  if constexpr (is_enumerator<static_cast<Enum>(kFrom)>())
    return enumerator_count<Enum, kFrom + 1>();
  else
    return kFrom;
}

template <typename Enum>
struct Named {
  Enum value{};
  std::string_view name;
};

/// The names of an enumeration in files and options, one row an enumerator, in its order:
///
///     constexpr Names<Facing> kFacings({{Facing::right, "right"}, {Facing::left, "left"}});
///
/// A row that is missing, empty or out of order does not compile.
template <typename Enum>
class Names {
 public:
  static constexpr std::size_t kCount = enumerator_count<Enum>();

  consteval Names(const Named<Enum> (&rows)[kCount]) {
    for (std::size_t i = 0; i < kCount; ++i) rows_[i] = rows[i];
    for (std::size_t i = 0; i < kCount; ++i)
      if (rows_[i].value != static_cast<Enum>(i) || rows_[i].name.empty())
        throw "each enumerator needs one row with a name, in the order of the enumeration";
  }

  constexpr std::string_view operator[](Enum value) const {
    return rows_[static_cast<std::size_t>(value)].name;
  }

  constexpr std::optional<Enum> find(std::string_view name) const {
    for (const Named<Enum>& row : rows_)
      if (row.name == name) return row.value;
    return std::nullopt;
  }

  /// `pf1, pf2, pf3`, or with "or" as the last separator `pf1, pf2 or pf3`: for messages.
  std::string list(std::string_view last_separator = ", ") const {
    std::string text;
    for (std::size_t i = 0; i < kCount; ++i) {
      if (i > 0) text += i + 1 < kCount ? ", " : last_separator;
      text += rows_[i].name;
    }
    return text;
  }

  constexpr auto begin() const { return rows_.begin(); }
  constexpr auto end() const { return rows_.end(); }

 private:
  std::array<Named<Enum>, kCount> rows_{};
};

}  // namespace stride
