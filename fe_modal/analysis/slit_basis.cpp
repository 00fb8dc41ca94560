// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/analysis/slit_basis.h"

#include "fe_modal/reduction/ritz.h"
#include "fe_modal/reduction/static_response.h"
#include "fe_modal/reduction/static_shapes.h"
#include "fe_modal/solve/assembled_system.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// The body with its slits shut, with the nodes of the open one.
class ShutBody {
 public:
  explicit ShutBody(const Model& open)
      : mesh_(tied(open.mesh())),
        open_(open.fields()),
        model_(mesh_, open.options()),
        system_(model_),
        inverse_(shift_inverse(system_, 0)) {
    if (open.options().mode_count > 0)
      modes_ = lowest_eigenpairs(system_.mass(), *inverse_, open.options().mode_count);
  }

  /// Modes in the open body's degrees of freedom, like all shapes below.
  Eigen::MatrixXd modes() const {
    if (modes_.values.size() == 0) return {};
    return open_.restrict(system_.fields().expand(modes_.vectors));
  }
  /// Static shapes under loads on the open body.
  Eigen::MatrixXd shapes(const Eigen::MatrixXd& loads) const { return beyond({}, loads); }
  /// Static shapes less the modes' part.
  Eigen::MatrixXd shapes_beyond_modes(const Eigen::MatrixXd& loads) const {
    return beyond(modes_, loads);
  }

 private:
  Eigen::MatrixXd beyond(const EigenPairs& kept, const Eigen::MatrixXd& loads) const {
    const Eigen::MatrixXd own = system_.fields().gather(open_.expand(loads));
    return open_.restrict(system_.fields().expand(
        static_response_beyond(operators_of(system_, *inverse_), kept, own)));
  }

  static mesher::Mesh tied(mesher::Mesh mesh) {
    for (mesher::Slit& slit : mesh.slits) slit.tied = true;
    return mesh;
  }

  mesher::Mesh mesh_;
  const FieldMap& open_;
  Model model_;
  AssembledSystem system_;
  std::unique_ptr<const LinearSolver> inverse_;
  EigenPairs modes_;
};

}  // namespace

SlitBasis slit_basis(const Model& model, const BodyOperators& open,
                     const std::vector<InterfaceLoads>& loads, const Progress& progress) {
  const mesher::Mesh& mesh = model.mesh();
  const FieldMap& field_map = model.fields();
  // Forces on couplings and in fixed directions do not transfer from one body to the other.
  if (field_map.dof_map().is_constrained())
    throw InputError(
        "slits that open and close are not supported with rigid interfaces, couplings, equations "
        "or supports in single directions");
  const StaticShapes shapes = static_shapes(open, {}, loads);
  const Eigen::MatrixXd combinations = correcting_loads(shapes, loads, progress);

  SlitBasis basis;
  basis.fields = slit_fields(mesh, field_map.expand(shapes.beyond * combinations),
                             model.options().slit_motions == SlitMotions::openings_and_sliding);
  if (progress)
    progress(std::to_string(basis.fields.size()) + " slit opening shapes are added to the basis");
  std::vector<Eigen::Matrix3Xd> parted;
  for (const SlitField& field : basis.fields) parted.push_back(on_nodes(mesh, field));
  const Eigen::MatrixXd jumps = field_map.restrict(parted);

  const ShutBody shut(model);
  const Eigen::MatrixXd modes = shut.modes();
  Eigen::MatrixXd vectors(jumps.rows(), modes.cols() + combinations.cols() + jumps.cols());
  if (modes.cols() > 0) vectors.leftCols(modes.cols()) = modes;
  vectors.rightCols(combinations.cols() + jumps.cols())
      << shut.shapes_beyond_modes(shapes.loads * combinations),
      jumps - shut.shapes(open.stiffness(jumps));
  basis.reduction.pairs = ritz_pairs(open, Eigen::MatrixXd(), std::move(vectors));
  basis.reduction.kinds.assign(static_cast<std::size_t>(basis.reduction.pairs.values.size()),
                               std::string(kConstraintMode));
  basis.reduction.responses = shapes.responses;
  return basis;
}

}  // namespace flexneck::fe_modal
