// Schema<T>: declares which keys of the case file fill which members of a plain struct T. Parser, reference and JSON
// schema follow from the one declaration.
//
//   struct Foam {
//     double young_modulus = 0.0;  // Pa
//     double density = 30.0;       // kg/m^3
//     Cells cells = Cells::open;
//     std::optional<Skin> skin;
//
//     static Schema<Foam> schema() {
//       return Schema<Foam>("foam", "Elastic foam.")
//           .quantity("young_modulus", &Foam::young_modulus, dimension::pressure, above(0), "At zero strain")
//           .quantity("density", &Foam::density, dimension::density, above(0), "In the reference state")
//               .by_default()                              // the value in Foam{}; or .by_default("30 kg/m^3")
//               .plausible("10 kg/m^3", "200 kg/m^3")      // a warning outside
//           .choice("cells", &Foam::cells, {{"open", Cells::open}, {"closed", Cells::closed}}, "Kind of cells")
//           .section("skin", &Foam::skin, Skin::schema(), "Skin; none when left out")
//           .check([](const Foam& f, Problems& problems) {
//             if (f.skin && f.cells == Cells::open) problems.add("skin", "open cells have no skin", "leave it out");
//           });
//     }
//   };
//   const Parsed<Foam> foam = parse_text(Foam::schema(), "young_modulus: 20 kPa\ncells: open\n");
//
// Rules. A key is required unless it has a default or its member is a std::optional. `.by_default` and `.plausible`
// belong to the key before them. In place of a pointer to member any callable T& -> member& will do, for members of
// members. Values are stored in SI units.
//
// A std::variant is a Schema with one_of(): exactly one of its keys is present.
//   Schema<Law>("law", "...").one_of().alternative<NeoHooke>(NeoHooke::schema()).alternative<Hgo>(Hgo::schema())
//   -> material: {neo_hooke: {young_modulus: 1 MPa}}    by .section("material", &Wall::law, law_schema(), "...")
//   -> neo_hooke: {...} on the level of the wall itself  by .include(&Wall::law, law_schema())
// An alternative without required keys may be written as its bare name (`rim: no_slip`).
// An alternative that is no struct: .quantity("constant", emplace<double>, dimension::pressure, anything(), "...").
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>

#include "tunica/base/boxed.hpp"
#include "tunica/config/description.hpp"

namespace tunica::config {

namespace detail {

template <class M>
struct Unwrap {
  using Type = M;
  static constexpr bool optional = false;
};
template <class M>
struct Unwrap<std::optional<M>> {
  using Type = M;
  static constexpr bool optional = true;
};
template <class M>
struct Unwrap<Boxed<M>> {
  using Type = M;
  static constexpr bool optional = true;
};

template <class M>
concept Resizable = requires(M m, double x) {
  m.push_back(x);
};
template <class M>
concept Keyed = requires(M m, std::string k) {
  m[k];
};

template <class M>
M& contained(std::optional<M>& member) {
  return member.emplace();
}
template <class M>
M& contained(Boxed<M>& member) {
  return member.emplace();
}
template <class M>
M& contained(M& member) {
  return member;
}

/// Number of doubles in a std::array<double, N>, Vec3<double> and the like.
template <class M>
inline constexpr std::size_t extent = sizeof(M) / sizeof(double);

std::string yaml_of(const std::vector<double>& values, const Dimension& dimension);

}  // namespace detail

/// For variants: the alternative A, made anew.
template <class A>
inline constexpr auto emplace = [](auto& variant) -> A& { return variant.template emplace<A>(); };

template <class T>
class Schema {
  template <class A>
  using Member = std::remove_cvref_t<std::invoke_result_t<A, T&>>;
  template <class A>
  using Plain = typename detail::Unwrap<Member<A>>::Type;

 public:
  using Object = T;

  /// `name` selects it among alternatives; `help` is one sentence or a few.
  Schema(std::string name, std::string help) : description_(std::make_shared<Description>()) {
    description_->name = std::move(name);
    description_->help = std::move(help);
  }

  // --- values -----------------------------------------------------------------------------------------------------

  template <std::invocable<T&> A>
  Schema& quantity(std::string key, A access, Dimension dimension, Range allowed, std::string help) {
    Field& f = leaf<double>(std::move(key), Kind::quantity, access, std::move(help));
    f.dimension = dimension;
    f.allowed = allowed;
    if constexpr (std::is_same_v<Member<A>, double>) f.initial = in_si(initial(access), dimension);
    return *this;
  }
  template <std::invocable<T&> A>
  Schema& number(std::string key, A access, Range allowed, std::string help) {
    return quantity(std::move(key), std::move(access), dimension::none, allowed, std::move(help));
  }
  template <std::invocable<T&> A>
  Schema& integer(std::string key, A access, Range allowed, std::string help) {
    Field& f = leaf<std::int64_t>(std::move(key), Kind::integer, access, std::move(help));
    f.allowed = allowed;
    f.allowed.low = std::max(allowed.low, static_cast<double>(std::numeric_limits<Plain<A>>::lowest()));
    f.allowed.high = std::min(allowed.high, static_cast<double>(std::numeric_limits<Plain<A>>::max()));
    if constexpr (std::integral<Member<A>>) f.initial = std::to_string(initial(access));
    return *this;
  }
  template <std::invocable<T&> A>
  Schema& flag(std::string key, A access, std::string help) {
    Field& f = leaf<bool>(std::move(key), Kind::flag, access, std::move(help));
    if constexpr (std::is_same_v<Member<A>, bool>) f.initial = initial(access) ? "true" : "false";
    return *this;
  }
  template <std::invocable<T&> A>
  Schema& text(std::string key, A access, std::string help) {
    return string(std::move(key), Kind::text, access, std::move(help));
  }
  /// Member: std::vector<std::string>. A single text stands for a list of one.
  template <std::invocable<T&> A>
  Schema& texts(std::string key, A access, std::string help) {
    Field& f = leaf<std::vector<std::string>>(std::move(key), Kind::texts, access, std::move(help));
    f.initial = "[]";
    return *this;
  }
  template <std::invocable<T&> A>
  Schema& file(std::string key, A access, std::string help) {
    return string(std::move(key), Kind::file, access, std::move(help));
  }
  template <std::invocable<T&> A>
  Schema& folder(std::string key, A access, std::string help) {
    return string(std::move(key), Kind::folder, access, std::move(help));
  }
  template <std::invocable<T&> A>
  Schema& path(std::string key, A access, std::string help) {
    return string(std::move(key), Kind::path, access, std::move(help));
  }
  /// One of named values of an enum (or of any other type).
  template <std::invocable<T&> A>
  Schema& choice(std::string key, A access,
                 std::initializer_list<std::pair<const char*, std::type_identity_t<Plain<A>>>> values,
                 std::string help) {
    Field& f = field(std::move(key), Kind::choice, std::move(help));
    f.required = !detail::Unwrap<Member<A>>::optional;
    std::vector<Plain<A>> stored;
    for (const auto& [name, value] : values) {
      f.names.emplace_back(name);
      stored.push_back(value);
      if constexpr (std::equality_comparable<Plain<A>> && !detail::Unwrap<Member<A>>::optional)
        if (f.initial.empty() && initial(access) == value) f.initial = name;
    }
    f.store = [access, stored](void* object, const Value& value) {
      at(access, object) = stored[static_cast<std::size_t>(std::get<std::int64_t>(value))];
    };
    return *this;
  }
  /// Flags of a std::array<bool, N>, listed by name: `axes: [x, z]`; a single name stands for a list of one.
  template <std::invocable<T&> A>
  Schema& any_of(std::string key, A access, std::vector<std::string> names, std::string help) {
    Field& f = field(std::move(key), Kind::any_of, std::move(help));
    f.initial = "[";
    const auto flags = initial(access);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (flags[i]) f.initial += (f.initial.size() > 1 ? ", " : "") + names[i];
    f.initial += "]";
    f.names = std::move(names);
    f.store = [access](void* object, const Value& value) {
      const auto& given = std::get<std::vector<bool>>(value);
      for (std::size_t i = 0; i < given.size(); ++i) at(access, object)[i] = given[i];
    };
    return *this;
  }
  /// List: std::vector<double>, or a fixed number of doubles (std::array, Vec3). `[0 m/s, 0 m/s, 1 m/s]` or
  /// `"[0, 0, 1] m/s"`.
  template <std::invocable<T&> A>
  Schema& quantities(std::string key, A access, Dimension dimension, Range allowed, std::string help) {
    using M = Plain<A>;
    Field& f = field(std::move(key), Kind::quantities, std::move(help));
    f.dimension = dimension;
    f.allowed = allowed;
    f.required = !detail::Unwrap<Member<A>>::optional;
    if constexpr (detail::Resizable<M>) {
      f.store = [access](void* object, const Value& value) {
        at(access, object) = std::get<std::vector<double>>(value);
      };
    } else {
      static_assert(std::is_trivially_copyable_v<M> && sizeof(M) % sizeof(double) == 0);
      f.count = detail::extent<M>;
      f.store = [access](void* object, const Value& value) {
        M& member = detail::contained(at(access, object));
        for (std::size_t i = 0; i < detail::extent<M>; ++i) member[i] = std::get<std::vector<double>>(value)[i];
      };
      if constexpr (!detail::Unwrap<Member<A>>::optional) {
        M member = initial(access);
        std::vector<double> values(detail::extent<M>);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = member[i];
        f.initial = detail::yaml_of(values, dimension);
      }
    }
    return *this;
  }
  /// A unit, for numbers that stand elsewhere: member = SI value of 1 in that unit. A multiple may be given (`0.9 s`).
  template <std::invocable<T&> A>
  Schema& unit(std::string key, A access, Dimension dimension, std::string help) {
    Field& f = leaf<double>(std::move(key), Kind::unit, access, std::move(help));
    f.dimension = dimension;
    f.allowed = above(0);
    if constexpr (std::is_same_v<Member<A>, double>) f.initial = in_si(initial(access), dimension);
    return *this;
  }

  // --- nested -----------------------------------------------------------------------------------------------------

  /// Member: U, std::optional<U> or Boxed<U>.
  template <std::invocable<T&> A, class U>
  Schema& section(std::string key, A access, const Schema<U>& nested, std::string help) {
    Field& f = field(std::move(key), Kind::section, std::move(help));
    f.nested = nested.description();
    f.required = !detail::Unwrap<Member<A>>::optional;
    f.initial = "{}";
    f.open = [access](void* object, const std::string&) -> void* {
      U& member = detail::contained(at(access, object));
      return &member;
    };
    return *this;
  }
  /// Member: std::map<std::string, U>, or std::vector<std::pair<std::string, U or Boxed<U>>> to keep the order of the
  /// file.
  template <std::invocable<T&> A, class U>
  Schema& map(std::string key, A access, const Schema<U>& nested, std::string help) {
    Field& f = field(std::move(key), Kind::map, std::move(help));
    f.nested = nested.description();
    f.initial = "{}";
    f.open = [access](void* object, const std::string& name) -> void* {
      auto& member = at(access, object);
      U* value = nullptr;
      if constexpr (detail::Keyed<Member<A>>)
        value = &member[name];
      else
        value = &detail::contained(member.emplace_back(name, U{}).second);
      return value;
    };
    return *this;
  }
  /// Member: std::vector<U>.
  template <std::invocable<T&> A, class U>
  Schema& list(std::string key, A access, const Schema<U>& nested, std::string help) {
    Field& f = field(std::move(key), Kind::list, std::move(help));
    f.nested = nested.description();
    f.initial = "[]";
    f.open = [access](void* object, const std::string&) -> void* {
      U& member = at(access, object).emplace_back();
      return &member;
    };
    return *this;
  }
  /// The keys of `nested` on this level.
  template <std::invocable<T&> A, class U>
  Schema& include(A access, const Schema<U>& nested) {
    description_->includes.push_back({[access](void* object) -> void* {
                                        U& member = at(access, object);
                                        return &member;
                                      },
                                      nested.description()});
    return *this;
  }

  // --- variants ---------------------------------------------------------------------------------------------------

  /// Exactly one of the keys is present.
  Schema& one_of() {
    description_->one_of = true;
    return *this;
  }
  /// T is a std::variant; `nested.name` is the key, its help the help.
  template <class U>
  Schema& alternative(const Schema<U>& nested) {
    return section(nested.description()->name, emplace<U>, nested, nested.description()->help);
  }

  // --- modifiers --------------------------------------------------------------------------------------------------

  /// The key may be left out; `text` (YAML) is then read in its place.
  Schema& by_default(const std::string& text) {
    last().default_text = text;
    last().required = false;
    return *this;
  }
  /// The key may be left out; the value is then that of T{} (of a section: the defaults of all its keys).
  Schema& by_default() { return by_default(last().initial); }
  /// The key may be left out, and the member then keeps the value of T{}, which the reference does not show.
  Schema& optional() {
    last().required = false;
    return *this;
  }
  /// The key must be there, although its member could be empty.
  Schema& required() {
    last().required = true;
    return *this;
  }
  /// Outside of these a warning is given, with the unit that was likely meant.
  Schema& plausible(std::string_view low, std::string_view high) {
    const Dimension& d = last().dimension;
    last().plausible_text = std::string(low).append(" to ").append(high);
    last().plausible = range(std::get<double>(parse_quantity(low, d)), std::get<double>(parse_quantity(high, d)));
    return *this;
  }
  /// A plain value in place of this section stands for `key`.
  Schema& shorthand(std::string key) {
    description_->shorthand = std::move(key);
    return *this;
  }
  /// Looks at the section as a whole; called when its keys were read without error.
  template <std::invocable<const T&, Problems&> F>
  Schema& check(F function) {
    description_->checks.push_back(
        [function](const void* object, Problems& problems) { function(*static_cast<const T*>(object), problems); });
    return *this;
  }

  const std::shared_ptr<Description>& description() const { return description_; }

 private:
  template <class A>
  static decltype(auto) at(const A& access, void* object) {
    return std::invoke(access, *static_cast<T*>(object));
  }
  template <class A>
  static Plain<A> initial(const A& access) {
    T prototype{};
    return std::invoke(access, prototype);
  }
  Field& last() { return description_->fields.back(); }
  Field& field(std::string key, Kind kind, std::string help) {
    Field& f = description_->fields.emplace_back();
    f.key = std::move(key);
    f.kind = kind;
    f.help = std::move(help);
    return f;
  }
  template <class Held, class A>
  Field& leaf(std::string key, Kind kind, A access, std::string help) {
    Field& f = field(std::move(key), kind, std::move(help));
    f.required = !detail::Unwrap<Member<A>>::optional;
    f.store = [access](void* object, const Value& value) {
      at(access, object) = static_cast<Plain<A>>(std::get<Held>(value));
    };
    return f;
  }
  template <class A>
  Schema& string(std::string key, Kind kind, A access, std::string help) {
    Field& f = leaf<std::string>(std::move(key), kind, access, std::move(help));
    if constexpr (!detail::Unwrap<Member<A>>::optional) {
      const Plain<A> value = initial(access);
      if constexpr (std::is_same_v<Plain<A>, std::string>)
        f.initial = value;
      else
        f.initial = value.string();
      if (f.initial.empty()) f.initial = "\"\"";
    }
    return *this;
  }

  std::shared_ptr<Description> description_;
};

/// What was read, and what looks odd but may be meant.
template <class T>
struct Parsed {
  T value{};
  std::vector<Problem> warnings;
};

/// Throws InputError with everything that is wrong.
template <class T>
Parsed<T> parse_text(const Schema<T>& schema, const std::string& yaml, const Origin& origin = {}) {
  Parsed<T> parsed;
  parsed.warnings = parse(*schema.description(), &parsed.value, yaml, origin);
  return parsed;
}
/// Paths in the file are relative to its folder.
template <class T>
Parsed<T> parse_file(const Schema<T>& schema, const std::filesystem::path& file) {
  return parse_text(schema, read_text(file), Origin{file.string(), file.parent_path()});
}

}  // namespace tunica::config
