// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/modal_body_file.h"

#include <algorithm>
#include <span>

#include "fe_modal/body/basis_table.h"
#include "fe_modal/body/geometric_stiffness_file.h"
#include "fe_modal/body/modal_body_check.h"
#include "fe_modal/body/mode_count_study.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::string_view kShapeUnit = "kg^-0.5";
constexpr std::string_view kRotationUnit = "kg^-0.5 m^-1";
/// Units of the four blocks, row by row.
constexpr std::string_view kComplianceUnit = "m/N, 1/N; 1/N, 1/(N m)";
constexpr std::string_view kResponseMassUnit = "kg m^2/N^2, kg m/N^2; kg m/N^2, kg/N^2";
constexpr std::string_view kRigidMassUnit = "kg, kg m; kg m, kg m^2";

/// Texts for the two kinds of motion of the sides of a slit.
constexpr std::string_view kOpens = "not below zero";
constexpr std::string_view kSlides = "free";

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::size_t extent(Eigen::Index n) { return static_cast<std::size_t>(n); }

void write_vector(Hdf5Writer& file, const std::string& dataset, const Eigen::VectorXd& values,
                  std::string_view unit) {
  file.write(dataset, {values.data(), extent(values.size())}, {extent(values.size())}, unit);
}

void write_matrix(Hdf5Writer& file, const std::string& dataset, const RowMajor& values,
                  std::string_view unit) {
  file.write(dataset, {values.data(), extent(values.size())},
             {extent(values.rows()), extent(values.cols())}, unit);
}

Eigen::VectorXd read_vector(const Hdf5Reader& file, const std::string& dataset, std::size_t size,
                            std::string_view unit) {
  const std::vector<double> values = file.read_doubles(dataset, {size}, unit);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

RowMajor read_matrix(const Hdf5Reader& file, const std::string& dataset, std::size_t rows,
                     std::size_t columns, std::string_view unit) {
  const std::vector<double> values = file.read_doubles(dataset, {rows, columns}, unit);
  return Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(rows),
                                    static_cast<Eigen::Index>(columns));
}

/// Writes a list of equally large matrices, flattened row-major behind leading extents.
template <class Matrix>
void write_list(Hdf5Writer& file, const std::string& dataset, const std::vector<Matrix>& list,
                Shape shape, std::string_view unit) {
  std::vector<double> values;
  for (const Matrix& each : list) {
    const RowMajor matrix = each;
    values.insert(values.end(), matrix.data(), matrix.data() + matrix.size());
  }
  shape.push_back(extent(Matrix::RowsAtCompileTime));
  if (Matrix::ColsAtCompileTime > 1) shape.push_back(extent(Matrix::ColsAtCompileTime));
  file.write(dataset, values, shape, unit);
}

template <class Matrix>
std::vector<Matrix> read_list(const Hdf5Reader& file, const std::string& dataset, Shape shape,
                              std::string_view unit) {
  shape.push_back(extent(Matrix::RowsAtCompileTime));
  if (Matrix::ColsAtCompileTime > 1) shape.push_back(extent(Matrix::ColsAtCompileTime));
  const std::vector<double> values = file.read_doubles(dataset, shape, unit);
  std::vector<Matrix> list;
  for (std::size_t first = 0; first < values.size(); first += extent(Matrix::SizeAtCompileTime)) {
    list.push_back(Eigen::Map<const RowMajor>(values.data() + first, Matrix::RowsAtCompileTime,
                                              Matrix::ColsAtCompileTime));
  }
  return list;
}

void write_shapes(Hdf5Writer& file, const ModalBody& body) {
  std::vector<double> values;  // a (3, n) column-major matrix is (n, 3) row-major
  for (const Eigen::Matrix3Xd& shape : body.shapes) {
    values.insert(values.end(), shape.data(), shape.data() + shape.size());
  }
  const std::size_t n = extent(body.nodes_m.cols());
  file.write("/nodes", {body.nodes_m.data(), 3 * n}, {n, 3}, "m");
  file.write("/shapes", values, {body.shapes.size(), n, 3}, kShapeUnit);
}

void read_shapes(const Hdf5Reader& file, std::size_t m, ModalBody& body) {
  const std::vector<double> nodes = file.read_doubles("/nodes", {kAnyExtent, 3}, "m");
  const std::size_t n = nodes.size() / 3;
  if (n == 0) file.refuse("/nodes", "expected at least one node, found none");
  body.nodes_m = Eigen::Map<const Eigen::Matrix3Xd>(nodes.data(), 3, static_cast<Eigen::Index>(n));
  const std::vector<double> values = file.read_doubles("/shapes", {m, n, 3}, kShapeUnit);
  for (std::size_t k = 0; k < m; ++k) {
    body.shapes.emplace_back(Eigen::Map<const Eigen::Matrix3Xd>(values.data() + 3 * n * k, 3,
                                                                static_cast<Eigen::Index>(n)));
  }
}

constexpr const char* kEnergyFractions = "/basis/energy_fractions";

void write_basis(Hdf5Writer& file, const ModalBody& body) {
  std::vector<std::string> kinds;
  std::vector<double> shares;
  std::vector<double> residuals;
  for (const ModeRecord& mode : body.modes) {
    kinds.push_back(mode.kind);
    shares.insert(shares.end(), mode.shares_percent.begin(), mode.shares_percent.end());
    residuals.push_back(mode.residual);
  }
  const std::size_t m = body.modes.size();
  file.write("/mode_names", names_of(body.modes));
  file.write("/basis/kind", kinds);
  file.write(kEnergyFractions, shares, {m, 4}, "percent");
  file.write("/basis/residual", residuals, {m}, "1");
  file.write_attribute("/basis", "boundary", std::string_view(body.boundary));
  if (!body.prestress.empty()) {
    file.write_attribute("/basis", "prestress", std::string_view(body.prestress));
    write_vector(file, "/basis/prestress_stiffness", body.prestress_stiffness, "1/s^2");
  }
  if (!body.solver.empty()) file.write("/basis/solver", std::vector<std::string>{body.solver});
}

/// Writes quantities that follow from the other data, for the convenience of readers.
void write_basis_table(Hdf5Writer& file, const ModalBody& body) {
  const BasisTable table = basis_table(body);
  write_matrix(file, "/basis/effective_mass", table.effective_mass_kg, "kg");
  write_matrix(file, "/basis/effective_inertia", table.effective_inertia_kg_m2, "kg m^2");
  write_matrix(file, "/basis/inertia_cumulative_fractions", table.inertia_percent, "percent");
  for (const BasisTable::Captured& captured : table.compliance) {
    write_matrix(file, "/interfaces/" + captured.interface + "/compliance_cumulative_fractions",
                 captured.percent, "percent");
  }
}

void read_basis(const Hdf5Reader& file, std::size_t m, ModalBody& body) {
  const std::vector<std::string> names = file.read_strings("/mode_names");
  const std::vector<std::string> kinds = file.read_strings("/basis/kind");
  if (names.size() != m) file.refuse("/mode_names", "expected one name per frequency");
  if (kinds.size() != m) file.refuse("/basis/kind", "expected one kind per frequency");
  const std::vector<double> shares = file.read_doubles(kEnergyFractions, {m, 4}, "percent");
  const std::vector<double> residuals = file.read_doubles("/basis/residual", {m}, "1");
  for (std::size_t k = 0; k < m; ++k) {
    ModeRecord mode{names[k], kinds[k], {}, residuals[k]};
    std::copy_n(shares.begin() + static_cast<std::ptrdiff_t>(4 * k), 4,
                mode.shares_percent.begin());
    body.modes.push_back(mode);
  }
  body.boundary = file.string_attribute("/basis", "boundary");
  const std::vector<std::string> attributes = file.attributes("/basis");
  if (std::find(attributes.begin(), attributes.end(), "prestress") != attributes.end()) {
    body.prestress = file.string_attribute("/basis", "prestress");
    body.prestress_stiffness = read_vector(file, "/basis/prestress_stiffness", m, "1/s^2");
  }
  if (!file.has("/basis/solver")) return;
  const std::vector<std::string> solver = file.read_strings("/basis/solver");
  if (solver.size() != 1) file.refuse("/basis/solver", "expected a single text");
  body.solver = solver[0];
}

void write_slits(Hdf5Writer& file, const ModalBody& body) {
  for (const SlitMotion& motion : body.slits) {
    const std::string dataset = "/slits/" + motion.name;
    write_vector(file, dataset, motion.amplitude.transpose(), kShapeUnit);
    file.write_attribute(dataset, "contact", std::string_view(motion.opens ? kOpens : kSlides));
  }
}

void read_slits(const Hdf5Reader& file, std::size_t m, ModalBody& body) {
  for (const std::string& name : file.members("/slits")) {
    const std::string dataset = "/slits/" + name;
    const std::string contact = file.string_attribute(dataset, "contact");
    if (contact != kOpens && contact != kSlides)
      file.refuse(dataset, "attribute 'contact' is '" + contact + "', expected '" +
                               std::string(kOpens) + "' or '" + std::string(kSlides) + "'");
    body.slits.push_back(
        {name, contact == kOpens, read_vector(file, dataset, m, kShapeUnit).transpose()});
  }
}

void write_interfaces(Hdf5Writer& file, const ModalBody& body) {
  for (const Interface& interface : body.interfaces) {
    const std::string group = "/interfaces/" + interface.name;
    write_vector(file, group + "/position", interface.position_m, "m");
    write_matrix(file, group + "/translation", interface.translation, kShapeUnit);
    write_matrix(file, group + "/rotation", interface.rotation, kRotationUnit);
    if (!interface.response) continue;
    write_matrix(file, group + "/compliance", interface.response->compliance, kComplianceUnit);
    write_matrix(file, group + "/response_mass", interface.response->mass, kResponseMassUnit);
  }
}

void read_interfaces(const Hdf5Reader& file, std::size_t m, ModalBody& body) {
  for (const std::string& name : file.members("/interfaces")) {
    const std::string group = "/interfaces/" + name;
    body.interfaces.push_back({name, read_vector(file, group + "/position", 3, "m"),
                               read_matrix(file, group + "/translation", 3, m, kShapeUnit),
                               read_matrix(file, group + "/rotation", 3, m, kRotationUnit)});
    if (!file.has(group + "/compliance")) continue;
    body.interfaces.back().response = {
        read_matrix(file, group + "/compliance", 6, 6, kComplianceUnit),
        read_matrix(file, group + "/response_mass", 6, 6, kResponseMassUnit)};
  }
}

void write_invariants(Hdf5Writer& file, const InertiaInvariants& inertia) {
  const std::size_t m = extent(inertia.Maa.rows());
  file.write("/invariants/mass", {&inertia.mass, 1}, {1}, "kg");
  write_vector(file, "/invariants/S1", inertia.S1, "kg m");
  write_matrix(file, "/invariants/S2", inertia.S2, "kg^0.5");
  write_matrix(file, "/invariants/J0", inertia.J0, "kg m^2");
  write_list(file, "/invariants/G0", inertia.G0, {m}, "kg^0.5 m");
  write_list(file, "/invariants/G", inertia.G, {m, m}, "1");
  write_matrix(file, "/invariants/N0", inertia.N0, "kg^0.5 m");
  write_list(file, "/invariants/N", inertia.N, {m, m}, "1");
  write_matrix(file, "/invariants/Maa", inertia.Maa, "1");
}

InertiaInvariants read_invariants(const Hdf5Reader& file, std::size_t m) {
  InertiaInvariants inertia;
  inertia.mass = read_vector(file, "/invariants/mass", 1, "kg")[0];
  inertia.S1 = read_vector(file, "/invariants/S1", 3, "kg m");
  inertia.S2 = read_matrix(file, "/invariants/S2", 3, m, "kg^0.5");
  inertia.J0 = read_matrix(file, "/invariants/J0", 3, 3, "kg m^2");
  inertia.G0 = read_list<Eigen::Matrix3d>(file, "/invariants/G0", {m}, "kg^0.5 m");
  inertia.G = read_list<Eigen::Matrix3d>(file, "/invariants/G", {m, m}, "1");
  inertia.N0 = read_matrix(file, "/invariants/N0", 3, m, "kg^0.5 m");
  inertia.N = read_list<Eigen::Vector3d>(file, "/invariants/N", {m, m}, "1");
  inertia.Maa = read_matrix(file, "/invariants/Maa", m, m, "1");
  return inertia;
}

void write_mesh_errors(Hdf5Writer& file, const ModalBody& body) {
  std::vector<std::string> names;
  std::vector<double> refined;
  std::vector<double> macs;
  std::vector<double> errors;
  for (const ModeRecord& mode : body.modes) {
    if (!mode.mesh_error) continue;
    names.push_back(mode.name);
    refined.push_back(mode.mesh_error->refined_Hz);
    macs.push_back(mode.mesh_error->mac);
    errors.push_back(mode.mesh_error->error);
  }
  if (names.empty()) return;
  file.write("/convergence/mode", names);
  file.write("/convergence/refined_frequency", refined, {names.size()}, "Hz");
  file.write("/convergence/mac", macs, {names.size()}, "1");
  file.write("/convergence/error", errors, {names.size()}, "1");
  if (!body.mesh_error_limits.empty())
    file.write_attribute("/convergence", "limits", std::string_view(body.mesh_error_limits));
}

void read_mesh_errors(const Hdf5Reader& file, ModalBody& body) {
  if (file.members("/convergence").empty()) return;
  const std::vector<std::string> names = file.read_strings("/convergence/mode");
  const std::size_t k = names.size();
  const auto read = [&](const std::string& dataset, std::string_view unit) {
    return file.read_doubles("/convergence/" + dataset, {k}, unit);
  };
  const std::vector<double> refined = read("refined_frequency", "Hz");
  const std::vector<double> macs = read("mac", "1");
  const std::vector<double> errors = read("error", "1");
  const std::vector<std::string> attributes = file.attributes("/convergence");
  if (std::find(attributes.begin(), attributes.end(), "limits") != attributes.end())
    body.mesh_error_limits = file.string_attribute("/convergence", "limits");
  const std::vector<std::string> known = names_of(body.modes);
  for (std::size_t l = 0; l < k; ++l) {
    const auto mode = std::find(known.begin(), known.end(), names[l]);
    if (mode == known.end())
      file.refuse("/convergence/mode", "there is no mode with the name " + names[l]);
    body.modes[static_cast<std::size_t>(mode - known.begin())].mesh_error =
        MeshError{refined[l], macs[l], errors[l]};
  }
}

void write_attached(Hdf5Writer& file, const ModalBody& body) {
  for (const AttachedFrequencies& attached : body.attached) {
    const std::string group = "/attached/" + attached.body;
    write_vector(file, group + "/frequencies", attached.frequencies_Hz, "Hz");
    file.write_attribute(group, "interface", std::string_view(attached.interface));
    if (!attached.mass_matrix) continue;
    write_matrix(file, group + "/mass_matrix", *attached.mass_matrix, kRigidMassUnit);
    for (const ModeCountRow& row : mode_count_study(body, attached)) {
      const std::string study = group + "/mode_counts/" + row.kept;
      write_vector(file, study + "/modes_only", row.modes_only_Hz, "Hz");
      write_vector(file, study + "/corrected", row.corrected_Hz, "Hz");
    }
  }
}

void read_attached(const Hdf5Reader& file, ModalBody& body) {
  for (const std::string& name : file.members("/attached")) {
    const std::string group = "/attached/" + name;
    body.attached.push_back({name, file.string_attribute(group, "interface"),
                             read_vector(file, group + "/frequencies", kAnyExtent, "Hz")});
    if (!file.has(group + "/mass_matrix")) continue;
    body.attached.back().mass_matrix =
        read_matrix(file, group + "/mass_matrix", 6, 6, kRigidMassUnit);
  }
}

}  // namespace

void write_modal_body(const std::filesystem::path& path, const ModalBodyFile& content) {
  const ModalBody& body = content.body;
  check_names(names_of(body.interfaces), "interface");
  check_names(names_of(body.slits), "slit");
  Hdf5Writer file(path, kModalBodyFormat);
  write_vector(file, "/frequencies", body.frequencies_Hz, "Hz");
  write_basis(file, body);
  write_basis_table(file, body);
  write_shapes(file, body);
  write_interfaces(file, body);
  write_slits(file, body);
  write_invariants(file, body.invariants);
  write_attached(file, body);
  if (body.geometric_stiffness) write_geometric_stiffness(file, *body.geometric_stiffness);
  write_mesh_errors(file, body);
  file.write("/certificate/orthogonality", {&body.orthogonality, 1}, {1}, "1");
  file.write_attribute("/certificate", "status", std::string_view(body.completeness));
  write_provenance(file, content.provenance);
  file.commit();
}

ModalBodyFile read_modal_body(const std::filesystem::path& path) {
  const Hdf5Reader file(path, kModalBodyFormat);
  ModalBodyFile content;
  ModalBody& body = content.body;
  body.frequencies_Hz = read_vector(file, "/frequencies", kAnyExtent, "Hz");
  const std::size_t m = extent(body.frequencies_Hz.size());
  if (m == 0) file.refuse("/frequencies", "expected at least one mode, found none");
  read_basis(file, m, body);
  read_shapes(file, m, body);
  read_interfaces(file, m, body);
  read_slits(file, m, body);
  body.invariants = read_invariants(file, m);
  read_attached(file, body);
  body.geometric_stiffness = read_geometric_stiffness(file, m);
  read_mesh_errors(file, body);
  body.orthogonality = read_vector(file, "/certificate/orthogonality", 1, "1")[0];
  body.completeness = file.string_attribute("/certificate", "status");
  try {
    check_modal_body(body);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  content.provenance = read_provenance(file);
  return content;
}

}  // namespace flexneck::fe_modal
