// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sweep/sobol_indices.h"

namespace flexneck::pipeline {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Terms whose means give the estimates, a column for each sample: mean and mean square of A and B,
/// the products of the first-order indices, the squares of the total ones.
ArrayXXd terms_of(const MatrixXd& values) {
  const Index inputs = values.rows() - 2;
  const double mean = values.topRows(2).mean();
  const ArrayXXd centred = values.array() - mean;
  ArrayXXd terms(2 + 2 * inputs, values.cols());
  terms.row(0) = (centred.row(0) + centred.row(1)) / 2;
  terms.row(1) = (centred.row(0).square() + centred.row(1).square()) / 2;
  for (Index i = 0; i < inputs; ++i) {
    const auto change = centred.row(2 + i) - centred.row(0);
    terms.row(2 + i) = centred.row(1) * change;
    terms.row(2 + inputs + i) = change.square() / 2;
  }
  return terms;
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const MatrixXd& values, std::uint64_t seed) {
  const Index inputs = values.rows() - 2;
  const ArrayXXd terms = terms_of(values);
  const auto figures_of = [&](const std::vector<Index>& members) -> VectorXd {
    ArrayXd sum = ArrayXd::Zero(terms.rows());
    for (const Index member : members) sum += terms.col(member);
    sum /= static_cast<double>(members.size());
    const double variance = sum[1] - sum[0] * sum[0];
    return sum.tail(2 * inputs) / variance;
  };
  const std::vector<Estimate> estimates = bootstrap({values.cols(), seed, figures_of});
  std::vector<SobolIndex> indices;
  for (Index i = 0; i < inputs; ++i)
    indices.push_back(
        {estimates[static_cast<std::size_t>(i)], estimates[static_cast<std::size_t>(inputs + i)]});
  return indices;
}

}  // namespace flexneck::pipeline
