// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace flexneck::fe_modal {

/// What to do about a factor that is too large.
inline constexpr const char* kOrAnotherSolution =
    "take a coarser mesh, --solver iterative, or more ranks with mpirun";

/// Which order of elimination CHOLMOD takes.
enum class CholmodOrder {
  best,      ///< AMD's, METIS's on all degrees of freedom where AMD fills much: the better one
  given,     ///< one given with the matrix, in a postorder of its tree
  numbering  ///< that of the matrix itself, which is taken without a copy
};

/// CHOLMOD's settings and workspace. It prints nothing.
class CholmodSession {
 public:
  explicit CholmodSession(CholmodOrder order);
  ~CholmodSession() { cholmod_finish(&common_); }
  CholmodSession(const CholmodSession&) = delete;
  CholmodSession& operator=(const CholmodSession&) = delete;

  cholmod_common* get() { return &common_; }

 private:
  cholmod_common common_{};
};

struct FreeCholmodFactor {
  CholmodSession* session;
  void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, session->get()); }
};
/// Must not outlive its session.
using CholmodFactor = std::unique_ptr<cholmod_factor, FreeCholmodFactor>;

/// A symmetric matrix whose upper half by rows is stored, columns ascending; it is only read.
/// Without values: the places of entries alone, both halves.
cholmod_sparse cholmod_view(std::span<const int> offsets, std::span<const int> columns,
                            std::span<const double> values);

/// An order of nodes as one of degrees of freedom, three each.
std::vector<int> order_of_dofs(std::span<const std::int32_t> node_order);

/// The places of the factor's entries, in the order of the session.
/// @param order  of elimination if it is given, a permutation
/// @throws InputError if CHOLMOD's integers do not count them, ComputationError if memory runs out.
CholmodFactor analyse(const cholmod_sparse& matrix, std::span<const int> order,
                      CholmodSession& session);
/// A supernodal factor.
/// @throws ComputationError if the matrix is not positive definite or memory runs out.
void factorise(const cholmod_sparse& matrix, CholmodFactor& factor, CholmodSession& session);

/// Of a supernodal factor, where fe_modal/algebra/supernodes.h has the places.
std::span<const double> values_of(const cholmod_factor& factor);

}  // namespace flexneck::fe_modal
