// An optional value on the heap. A struct that holds one need not know its type: a header then declares it alone, and
// what the type is made of recompiles only the sources that look into it.
#pragma once

#include <cassert>
#include <optional>
#include <utility>

namespace tunica {

/// As std::optional<T>, copied with its value, for a T that may be incomplete wherever none is made or looked at.
template <class T>
class Boxed {
 public:
  Boxed() = default;
  Boxed(std::nullopt_t) {}
  Boxed(T value) : value_(new T(std::move(value))), actions_(&actions) {}
  Boxed(const Boxed& other)
      : value_(other.value_ ? other.actions_->copy(*other.value_) : nullptr), actions_(other.actions_) {}
  Boxed(Boxed&& other) noexcept : value_(std::exchange(other.value_, nullptr)), actions_(other.actions_) {}
  ~Boxed() { reset(); }
  Boxed& operator=(Boxed other) noexcept {
    std::swap(value_, other.value_);
    std::swap(actions_, other.actions_);
    return *this;
  }

  bool has_value() const { return value_ != nullptr; }
  explicit operator bool() const { return has_value(); }
  T& operator*() { return assert(value_), *value_; }
  const T& operator*() const { return assert(value_), *value_; }
  T* operator->() { return &**this; }
  const T* operator->() const { return &**this; }
  /// Throws std::bad_optional_access without a value.
  const T& value() const { return value_ ? *value_ : throw std::bad_optional_access(); }

  T& emplace() { return *(*this = Boxed(T{})); }
  void reset() {
    if (value_) actions_->destroy(std::exchange(value_, nullptr));
  }

 private:
  /// What can be done by those alone who know the type; a value brings it along from where it was made.
  struct Actions {
    T* (*copy)(const T&);
    void (*destroy)(T*);
  };
  static constexpr Actions actions{[](const T& value) { return new T(value); }, [](T* value) { delete value; }};

  T* value_ = nullptr;
  const Actions* actions_ = nullptr;
};

}  // namespace tunica
