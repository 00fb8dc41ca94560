// SPDX-License-Identifier: GPL-3.0-or-later
// Target: modes.h5, see hdf5_edits.h.
#include "fe_modal/body/basis_table.h"
#include "fe_modal/body/modal_body_file.h"
#include "tests/reliability/fuzz/hdf5_target.h"
#include "tests/support/point_mass_body.h"

using namespace flexneck;
using namespace flexneck::fe_modal;

namespace {

/// Writes modes with an example of everything that such a file may hold.
void write_sound(const std::filesystem::path& path) {
  ModalBodyFile file;
  ModalBody& body = file.body;
  body = testing::make_point_mass_body(1, 2, 5).body;
  body.solver = "none";
  body.modes[0].mesh_error = MeshError{1, 1, 0.01};
  const Eigen::Matrix<double, 6, 6> unit = Eigen::Matrix<double, 6, 6>::Identity();
  for (Interface& interface : body.interfaces)
    if (interface.name == "side") interface.response = StaticResponse{unit, unit};
  Eigen::VectorXd hertz(2);
  hertz << 1, 2;
  body.attached = {{"head", "side", hertz, unit}};
  file.provenance = {"program",
                     "hash",
                     {{"mesh.h5", "0"}},
                     {{"key", "1 m", Origin::published, "note"}},
                     {{"petsc", "3"}}};
  write_modal_body(path, file);
}

void check(const ModalBody& body) {
  const Eigen::Index m = body.mode_count();
  const auto count = static_cast<std::size_t>(m);
  fuzz::require(m > 0 && body.modes.size() == count && body.shapes.size() == count,
                "every mode has a name and a shape");
  fuzz::require(body.frequencies_Hz.allFinite() && (body.frequencies_Hz.array() >= 0).all(),
                "frequencies are finite and not negative");
  for (const Eigen::Matrix3Xd& shape : body.shapes)
    fuzz::require(shape.cols() == body.nodes_m.cols() && shape.allFinite(),
                  "a shape moves all nodes");
  for (const Interface& interface : body.interfaces)
    fuzz::require(interface.translation.cols() == m && interface.rotation.cols() == m,
                  "an interface moves with all modes");
  const InertiaInvariants& inertia = body.invariants;
  fuzz::require(inertia.mass > 0 && inertia.G0.size() == count &&
                    inertia.G.size() == count * count && inertia.N.size() == count * count &&
                    inertia.S2.cols() == m && inertia.N0.cols() == m && inertia.Maa.rows() == m &&
                    inertia.Maa.cols() == m,
                "invariants are those of all modes");
  fuzz::require((inertia.Maa - Eigen::MatrixXd::Identity(m, m)).cwiseAbs().maxCoeff() < 1e-5,
                "modes are mass-normalised");
  for (const AttachedFrequencies& attached : body.attached)
    static_cast<void>(body.interface(attached.interface));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Hdf5Target target(write_sound);
  return target.run(data, size, [](const std::filesystem::path& path) {
    const ModalBodyFile file = read_modal_body(path);
    check(file.body);
    fuzz::require(basis_table(file.body).effective_mass_kg.allFinite(), "its table is finite");
    // A foreign file is used in a run after it has been written as a copy of this program.
    const std::filesystem::path copy = target.folder().path() / "copy.h5";
    write_modal_body(copy, file);
    const ModalBody again = read_modal_body(copy).body;
    fuzz::require(again.frequencies_Hz == file.body.frequencies_Hz &&
                      again.nodes_m == file.body.nodes_m && again.shapes == file.body.shapes,
                  "modes are written and read");
  });
}
