// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <vector>

#include <Eigen/Core>

namespace flexneck::python {

namespace py = pybind11;

/// A read-only array of numbers that belong to `owner`, which lives as long as the array.
/// @param shape  shape of the numbers, in row-major order
template <class Number>
py::array view(const std::vector<py::ssize_t>& shape, const Number* numbers, py::handle owner) {
  py::array array(py::dtype::of<Number>(), shape, numbers, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Eigen's columns as NumPy's rows: (3, n) in Eigen is (n, 3) in NumPy, without a copy.
template <class Matrix>
py::array rows_view(const Matrix& columns, py::handle owner) {
  static_assert(!Matrix::IsRowMajor || Matrix::IsVectorAtCompileTime);
  if constexpr (Matrix::IsVectorAtCompileTime)
    return view({static_cast<py::ssize_t>(columns.size())}, columns.data(), owner);
  else
    return view(
        {static_cast<py::ssize_t>(columns.cols()), static_cast<py::ssize_t>(columns.rows())},
        columns.data(), owner);
}

/// Copy of a matrix with the same shape, (rows, columns).
inline py::array copied(const Eigen::MatrixXd& matrix) {
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  auto numbers = array.mutable_unchecked<2>();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) numbers(i, j) = matrix(i, j);
  return array;
}

}  // namespace flexneck::python
