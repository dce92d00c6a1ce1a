// Memory of the library as numpy arrays: without copies, and read-only.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <vector>

namespace tunica::python {

/// `owner` keeps the memory alive. `strides` in numbers of T.
template <class T>
pybind11::array view(const T* data, std::vector<pybind11::ssize_t> shape, std::vector<pybind11::ssize_t> strides,
                     const pybind11::object& owner) {
  for (auto& stride : strides) stride *= static_cast<pybind11::ssize_t>(sizeof(T));
  pybind11::array array(pybind11::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// (rows, columns), one row after the other; `Row`: an aggregate of T.
template <class T, class Row>
pybind11::array rows(const std::vector<Row>& values, const pybind11::object& owner) {
  static_assert(sizeof(Row) % sizeof(T) == 0);
  constexpr auto columns = static_cast<pybind11::ssize_t>(sizeof(Row) / sizeof(T));
  return view(reinterpret_cast<const T*>(values.data()), {static_cast<pybind11::ssize_t>(values.size()), columns},
              {columns, 1}, owner);
}

}  // namespace tunica::python
