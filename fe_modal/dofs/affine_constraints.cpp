// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/affine_constraints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Fraction of the largest term below which a sum has cancelled but for rounding.
constexpr double kCancelled = 1e-13;
/// Fraction of its original coefficients below which those of an expanded equation are rounding, so
/// that it holds already.
constexpr double kHolds = 1e-9;

}  // namespace

AffineConstraints::AffineConstraints(std::int32_t dof_count, std::vector<double> scales,
                                     std::function<std::string(std::int32_t)> describe)
    : line_of_(static_cast<std::size_t>(dof_count), -1),
      scales_(std::move(scales)),
      describe_(std::move(describe)) {}

std::vector<DofTerm> AffineConstraints::expanded(std::span<const DofTerm> terms) const {
  std::vector<DofTerm> all;
  for (const DofTerm& term : terms) {
    if (!is_dependent(term.dof)) {
      all.push_back(term);
      continue;
    }
    for (const DofTerm& inner : line(term.dof)) {
      all.push_back({inner.dof, term.coefficient * inner.coefficient});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const DofTerm& one, const DofTerm& other) { return one.dof < other.dof; });
  std::vector<DofTerm> sums;
  for (std::size_t first = 0; first < all.size();) {
    double sum = 0;
    double largest = 0;
    std::size_t k = first;
    for (; k < all.size() && all[k].dof == all[first].dof; ++k) {
      sum += all[k].coefficient;
      largest = std::max(largest, std::abs(all[k].coefficient));
    }
    if (std::abs(sum) > kCancelled * largest) sums.push_back({all[first].dof, sum});
    first = k;
  }
  return sums;
}

double AffineConstraints::size_of(std::span<const DofTerm> terms) const {
  double size = 0;
  for (const DofTerm& term : terms) {
    size = std::max(size, std::abs(term.coefficient) / scale(term.dof));
  }
  return size;
}

const std::string& AffineConstraints::source_of(std::int32_t dof) const {
  return sources_[lines_[static_cast<std::size_t>(line_of_[static_cast<std::size_t>(dof)])].source];
}

void AffineConstraints::add_line(std::int32_t dof, std::span<const DofTerm> terms,
                                 const std::string& source) {
  std::vector<DofTerm> equation(terms.begin(), terms.end());
  if (is_dependent(dof)) {
    equation.push_back({dof, -1});
    if (size_of(expanded(equation)) <= kHolds * size_of(equation)) return;
    throw InputError(source + " and " + source_of(dof) + " contradict each other: both determine " +
                     describe_(dof));
  }
  std::vector<DofTerm> line = expanded(terms);
  const auto is_dof = [dof](const DofTerm& term) { return term.dof == dof; };
  if (std::any_of(line.begin(), line.end(), is_dof)) {
    std::string other = "itself";
    for (const DofTerm& term : terms) {
      if (!is_dependent(term.dof)) continue;
      const std::span<const DofTerm> inner = this->line(term.dof);
      if (std::any_of(inner.begin(), inner.end(), is_dof)) other = source_of(term.dof);
    }
    throw InputError(source + " and " + other + " form a cycle: " + describe_(dof) +
                     " would depend on itself");
  }
  insert(dof, std::move(line), source);
}

void AffineConstraints::add_equation(std::span<const DofTerm> terms, const std::string& source) {
  const std::vector<DofTerm> rest = expanded(terms);
  const auto size = [&](const DofTerm& term) {
    return std::abs(term.coefficient) / scale(term.dof);
  };
  const auto pivot = std::max_element(
      rest.begin(), rest.end(),
      [&](const DofTerm& one, const DofTerm& other) { return size(one) < size(other); });
  if (pivot == rest.end() || size(*pivot) <= kHolds * size_of(terms)) return;
  std::vector<DofTerm> line;
  for (auto term = rest.begin(); term != rest.end(); ++term) {
    if (term == pivot || size(*term) <= kCancelled * size(*pivot)) continue;
    line.push_back({term->dof, -term->coefficient / pivot->coefficient});
  }
  insert(pivot->dof, std::move(line), source);
}

void AffineConstraints::insert(std::int32_t dof, std::vector<DofTerm> terms,
                               const std::string& source) {
  if (sources_.empty() || sources_.back() != source) sources_.push_back(source);
  const std::size_t added = lines_.size();
  line_of_[static_cast<std::size_t>(dof)] = static_cast<std::int32_t>(added);
  for (const DofTerm& term : terms) users_[term.dof].push_back(added);
  lines_.push_back({dof, std::move(terms), sources_.size() - 1});
  const auto found = users_.find(dof);
  if (found == users_.end()) return;
  const std::vector<std::size_t> users = std::move(found->second);
  users_.erase(found);
  for (const std::size_t user : users) {
    std::vector<DofTerm>& line = lines_[user].terms;
    line = expanded(line);
    for (const DofTerm& term : lines_[added].terms) {
      std::vector<std::size_t>& known = users_[term.dof];
      if (known.empty() || known.back() != user) known.push_back(user);
    }
  }
}

}  // namespace flexneck::fe_modal
