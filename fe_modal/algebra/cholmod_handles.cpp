// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholmod_handles.h"

#include <dlfcn.h>
#include <string>

#include "fe_modal/algebra/cholesky_factor.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

void require_done(CholmodSession& session) {
  const int status = session.get()->status;
  if (status == CHOLMOD_NOT_POSDEF) throw ComputationError(kNotDefinite);
  if (status == CHOLMOD_OUT_OF_MEMORY)
    throw ComputationError(std::string("memory runs out while factorising the stiffness matrix; ") +
                           kOrAnotherSolution);
  if (status == CHOLMOD_TOO_LARGE)
    throw InputError(
        std::string("the factor of the stiffness matrix has more entries than CHOLMOD's "
                    "integers count; ") +
        kOrAnotherSolution);
  if (status < 0)
    throw ComputationError("factorising the stiffness matrix failed: CHOLMOD's status " +
                           std::to_string(status));
}

/// While it lives, what this thread calls has no threads by OpenMP. CHOLMOD asks for four, whatever
/// OMP_NUM_THREADS says, to add up each few hundred rows: at 26 000 degrees of freedom on two
/// processors order and factor took 0.57 s by the clock that way and 0.37 s without.
class WithoutOpenMp {
 public:
  WithoutOpenMp() {
    if (levels_ != nullptr && set_levels_ != nullptr) {
      before_ = levels_();
      set_levels_(0);
    }
  }
  ~WithoutOpenMp() {
    if (levels_ != nullptr && set_levels_ != nullptr) set_levels_(before_);
  }
  WithoutOpenMp(const WithoutOpenMp&) = delete;
  WithoutOpenMp& operator=(const WithoutOpenMp&) = delete;

 private:
  // Of the run-time library that CHOLMOD brings along, if it was built with one.
  int (*levels_)() = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
  void (*set_levels_)(int) = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT,
                                                                   "omp_set_max_active_levels"));
  int before_ = 0;
};

}  // namespace

CholmodSession::CholmodSession(CholmodOrder order) {
  cholmod_start(&common_);
  common_.print = 0;
  // By columns it would make L D L^T, of a matrix that is not definite too.
  common_.supernodal = CHOLMOD_SUPERNODAL;
  if (order == CholmodOrder::best) return;
  // Left to itself CHOLMOD also tries orders of its own and keeps the one it likes best.
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  if (order == CholmodOrder::given) return;
  common_.method[0].ordering = CHOLMOD_NATURAL;
  common_.postorder = 0;
}

cholmod_sparse cholmod_view(std::span<const int> offsets, std::span<const int> columns,
                            std::span<const double> values) {
  // The upper half by rows is, to CHOLMOD, the lower half by columns.
  cholmod_sparse view{};
  view.nrow = view.ncol = offsets.size() - 1;
  view.nzmax = columns.size();
  view.p = const_cast<int*>(offsets.data());
  view.i = const_cast<int*>(columns.data());
  view.x = const_cast<double*>(values.data());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = values.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

std::vector<int> order_of_dofs(std::span<const std::int32_t> node_order) {
  std::vector<int> dofs;
  dofs.reserve(3 * node_order.size());
  for (const std::int32_t node : node_order) {
    for (int a = 0; a < 3; ++a) dofs.push_back(3 * node + a);
  }
  return dofs;
}

CholmodFactor analyse(const cholmod_sparse& matrix, std::span<const int> order,
                      CholmodSession& session) {
  auto* const permutation = order.empty() ? nullptr : const_cast<int*>(order.data());
  CholmodFactor factor(cholmod_analyze_p(const_cast<cholmod_sparse*>(&matrix), permutation, nullptr,
                                         0, session.get()),
                       {&session});
  require_done(session);
  return factor;
}

void factorise(const cholmod_sparse& matrix, CholmodFactor& factor, CholmodSession& session) {
  const WithoutOpenMp alone;
  cholmod_factorize(const_cast<cholmod_sparse*>(&matrix), factor.get(), session.get());
  require_done(session);
}

std::span<const double> values_of(const cholmod_factor& factor) {
  return {static_cast<const double*>(factor.x), factor.xsize};
}

}  // namespace flexneck::fe_modal
