// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

// The BLAS and LAPACK in both precisions; PETSc declares that of its own numbers.
extern "C" {
void dgemm_(const char* turn_a, const char* turn_b, const int* m, const int* n, const int* k,
            const double* factor, const double* a, const int* lda, const double* b, const int* ldb,
            const double* keep, double* c, const int* ldc);
void sgemm_(const char* turn_a, const char* turn_b, const int* m, const int* n, const int* k,
            const float* factor, const float* a, const int* lda, const float* b, const int* ldb,
            const float* keep, float* c, const int* ldc);
void dsyrk_(const char* triangle, const char* turn, const int* n, const int* k,
            const double* factor, const double* a, const int* lda, const double* keep, double* c,
            const int* ldc);
void ssyrk_(const char* triangle, const char* turn, const int* n, const int* k, const float* factor,
            const float* a, const int* lda, const float* keep, float* c, const int* ldc);
void dtrsm_(const char* side, const char* triangle, const char* turn, const char* diagonal,
            const int* m, const int* n, const double* factor, const double* a, const int* lda,
            double* b, const int* ldb);
void strsm_(const char* side, const char* triangle, const char* turn, const char* diagonal,
            const int* m, const int* n, const float* factor, const float* a, const int* lda,
            float* b, const int* ldb);
void dpotrf_(const char* triangle, const int* n, double* a, const int* lda, int* info);
void spotrf_(const char* triangle, const int* n, float* a, const int* lda, int* info);
}

namespace flexneck::fe_modal {

/// A dense matrix, column by column, whose columns are `stride` numbers apart.
template <typename Scalar>
struct DenseBlock {
  Scalar* values;
  int rows;
  int columns;
  int stride;

  Scalar* column(int j) const { return values + static_cast<std::ptrdiff_t>(j) * stride; }
  DenseBlock part(int row, int column_number, int row_count, int column_count) const {
    return {column(column_number) + row, row_count, column_count, stride};
  }
  operator DenseBlock<const Scalar>() const { return {values, rows, columns, stride}; }
};

template <typename Scalar>
void copy_to(const DenseBlock<const Scalar>& from, const DenseBlock<Scalar>& to) {
  for (int j = 0; j < from.columns; ++j) std::copy_n(from.column(j), from.rows, to.column(j));
}

/// result = factor a b^T + keep result
inline void multiply_by_transpose(double factor, const DenseBlock<const double>& a,
                                  const DenseBlock<const double>& b, double keep,
                                  const DenseBlock<double>& result) {
  dgemm_("N", "T", &result.rows, &result.columns, &a.columns, &factor, a.values, &a.stride,
         b.values, &b.stride, &keep, result.values, &result.stride);
}
inline void multiply_by_transpose(float factor, const DenseBlock<const float>& a,
                                  const DenseBlock<const float>& b, float keep,
                                  const DenseBlock<float>& result) {
  sgemm_("N", "T", &result.rows, &result.columns, &a.columns, &factor, a.values, &a.stride,
         b.values, &b.stride, &keep, result.values, &result.stride);
}

/// The lower triangle of result = factor a a^T + keep result.
inline void multiply_by_own_transpose(double factor, const DenseBlock<const double>& a, double keep,
                                      const DenseBlock<double>& result) {
  dsyrk_("L", "N", &result.rows, &a.columns, &factor, a.values, &a.stride, &keep, result.values,
         &result.stride);
}
inline void multiply_by_own_transpose(float factor, const DenseBlock<const float>& a, float keep,
                                      const DenseBlock<float>& result) {
  ssyrk_("L", "N", &result.rows, &a.columns, &factor, a.values, &a.stride, &keep, result.values,
         &result.stride);
}

/// b = b L^-T, of the lower triangle L of a.
inline void divide_by_transpose(const DenseBlock<const double>& a, const DenseBlock<double>& b) {
  constexpr double kOne = 1;
  dtrsm_("R", "L", "T", "N", &b.rows, &b.columns, &kOne, a.values, &a.stride, b.values, &b.stride);
}
inline void divide_by_transpose(const DenseBlock<const float>& a, const DenseBlock<float>& b) {
  constexpr float kOne = 1;
  strsm_("R", "L", "T", "N", &b.rows, &b.columns, &kOne, a.values, &a.stride, b.values, &b.stride);
}

/// The lower triangle of a becomes L of a = L L^T.
/// @return whether there is one
inline bool factorise_in_place(const DenseBlock<double>& a) {
  int info = 0;
  dpotrf_("L", &a.rows, a.values, &a.stride, &info);
  return info == 0;
}
inline bool factorise_in_place(const DenseBlock<float>& a) {
  int info = 0;
  spotrf_("L", &a.rows, a.values, &a.stride, &info);
  return info == 0;
}

}  // namespace flexneck::fe_modal
