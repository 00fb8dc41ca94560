// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace flexneck::fe_modal {

/// A coefficient times a degree of freedom.
struct DofTerm {
  std::int32_t dof;
  double coefficient;
};

/// Constraints of degrees of freedom as linear combinations of independent ones, without a
/// constant: supports, ties, rigid couplings and multi-point constraints are all lines of this kind
/// (the idea of deal.II's AffineConstraints). Every line is always in terms of independent degrees
/// of freedom, so that chains are resolved and cycles cannot arise.
class AffineConstraints {
 public:
  /// @param scales displacement per unit of each degree of freedom, so that coefficients of
  /// translations (1) and of rotations (a length) compare; empty: all 1
  /// @param describe names a degree of freedom for messages
  AffineConstraints(std::int32_t dof_count, std::vector<double> scales,
                    std::function<std::string(std::int32_t)> describe);

  /// Adds the line dof = sum of the terms.
  /// @param source name of the constraint in messages
  /// @throws InputError naming both constraints if another one determines the degree of freedom, or
  /// if the terms depend on it (a cycle).
  void add_line(std::int32_t dof, std::span<const DofTerm> terms, const std::string& source);
  /// Adds the equation sum of the terms = 0: the independent degree of freedom with the largest
  /// coefficient becomes dependent. Nothing changes if the sum is zero already.
  void add_equation(std::span<const DofTerm> terms, const std::string& source);

  /// Largest |coefficient| / scale.
  double size_of(std::span<const DofTerm> terms) const;
  bool is_dependent(std::int32_t dof) const { return line_of_[static_cast<std::size_t>(dof)] >= 0; }
  /// Terms of a dependent degree of freedom, in ascending independent ones; empty if it is zero.
  std::span<const DofTerm> line(std::int32_t dof) const {
    return lines_[static_cast<std::size_t>(line_of_[static_cast<std::size_t>(dof)])].terms;
  }
  std::int32_t dof_count() const { return static_cast<std::int32_t>(line_of_.size()); }

 private:
  struct Line {
    std::int32_t dof;
    std::vector<DofTerm> terms;
    std::size_t source;
  };

  double scale(std::int32_t dof) const {
    return scales_.empty() ? 1 : scales_[static_cast<std::size_t>(dof)];
  }
  /// The terms in independent degrees of freedom, ascending; terms that cancel but for rounding are
  /// dropped.
  std::vector<DofTerm> expanded(std::span<const DofTerm> terms) const;
  void insert(std::int32_t dof, std::vector<DofTerm> terms, const std::string& source);
  const std::string& source_of(std::int32_t dof) const;

  std::vector<std::int32_t> line_of_;  ///< line of each degree of freedom; -1: independent
  std::vector<double> scales_;
  std::function<std::string(std::int32_t)> describe_;
  std::vector<Line> lines_;
  std::vector<std::string> sources_;
  /// Lines by the independent degrees of freedom among their terms, present or former.
  std::unordered_map<std::int32_t, std::vector<std::size_t>> users_;
};

}  // namespace flexneck::fe_modal
