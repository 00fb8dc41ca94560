// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/static_solution_file.h"

#include <algorithm>
#include <map>
#include <span>

namespace flexneck::fe_modal {
namespace {

/// Largest relative sum of reactions and loads: far above rounding, far below a mistake.
constexpr double kBalanced = 1e-6;

/// Writes the columns of a matrix: (rows, n) column-major is (n, rows) row-major.
template <int rows>
void write_columns(Hdf5Writer& file, const std::string& dataset,
                   const Eigen::Matrix<double, rows, Eigen::Dynamic>& values,
                   std::string_view unit) {
  file.write(dataset, {values.data(), static_cast<std::size_t>(values.size())},
             {static_cast<std::size_t>(values.cols()), static_cast<std::size_t>(rows)}, unit);
}

template <int rows>
Eigen::Matrix<double, rows, Eigen::Dynamic> read_columns(const Hdf5Reader& file,
                                                         const std::string& dataset,
                                                         std::size_t count, std::string_view unit) {
  const std::vector<double> values =
      file.read_doubles(dataset, {count, static_cast<std::size_t>(rows)}, unit);
  return Eigen::Map<const Eigen::Matrix<double, rows, Eigen::Dynamic>>(
      values.data(), rows, static_cast<Eigen::Index>(values.size()) / rows);
}

void write_stresses(Hdf5Writer& file, const std::string& group, const Stresses& stress_Pa) {
  write_columns<6>(file, group + "/stress", stress_Pa, "Pa");
  std::vector<double> von_mises;
  for (const auto& stress : stress_Pa.colwise()) von_mises.push_back(von_mises_Pa(stress));
  file.write(group + "/von_mises", von_mises, {von_mises.size()}, "Pa");
}

std::string group_of(const PointStresses& block) {
  return "/integration_points/" + block.part + "/" + block.kind;
}

void check_balance(const Hdf5Reader& file, const StaticSolution& solution) {
  const Resultant loads = resultant_of(solution.nodes_m, solution.applied_N);
  const Resultant reactions = resultant_of(solution.nodes_m, solution.reactions_N);
  const double size =
      solution.applied_N.colwise().norm().sum() + solution.reactions_N.colwise().norm().sum();
  const double length = solution.nodes_m.colwise().norm().maxCoeff();
  const Eigen::Vector3d force = loads.force_N + reactions.force_N;
  const Eigen::Vector3d moment = loads.moment_Nm + reactions.moment_Nm;
  if (force.norm() <= kBalanced * size && moment.norm() <= kBalanced * size * length) return;
  file.refuse("/reactions", "the reactions are not in equilibrium with /applied");
}

}  // namespace

void write_static_solution(const std::filesystem::path& path, const StaticSolutionFile& content) {
  const StaticSolution& solution = content.solution;
  Hdf5Writer file(path, kStaticSolutionFormat);
  write_columns<3>(file, "/nodes", solution.nodes_m, "m");
  write_columns<3>(file, "/displacements", solution.displacements_m, "m");
  write_columns<3>(file, "/applied", solution.applied_N, "N");
  write_columns<3>(file, "/reactions", solution.reactions_N, "N");
  for (const NodalStresses& each : solution.at_nodes) {
    const std::string group = "/nodal_stress/" + each.material;
    file.write(group + "/nodes", each.nodes, {each.nodes.size()});
    write_stresses(file, group, each.stress_Pa);
  }
  for (const PointStresses& each : solution.at_points) {
    write_columns<3>(file, group_of(each) + "/positions", each.positions_m, "m");
    write_stresses(file, group_of(each), each.stress_Pa);
    file.write_attribute(group_of(each), "points_per_element",
                         static_cast<std::int64_t>(each.points_per_element));
  }
  file.write("/step/loads", solution.loads);
  file.write("/step/imbalance", {&solution.imbalance, 1}, {1}, "1");
  file.write_attribute("/step", "boundary", std::string_view(solution.boundary));
  file.write_attribute("/step", "solver", std::string_view(solution.solver));
  write_provenance(file, content.provenance);
  file.commit();
}

StaticSolutionFile read_static_solution(const std::filesystem::path& path) {
  const Hdf5Reader file(path, kStaticSolutionFormat);
  StaticSolutionFile content;
  StaticSolution& solution = content.solution;
  solution.nodes_m = read_columns<3>(file, "/nodes", kAnyExtent, "m");
  const auto n = static_cast<std::size_t>(solution.nodes_m.cols());
  if (n == 0) file.refuse("/nodes", "expected at least one node, found none");
  solution.displacements_m = read_columns<3>(file, "/displacements", n, "m");
  solution.applied_N = read_columns<3>(file, "/applied", n, "N");
  solution.reactions_N = read_columns<3>(file, "/reactions", n, "N");
  for (const std::string& material : file.members("/nodal_stress")) {
    const std::string group = "/nodal_stress/" + material;
    NodalStresses each{material, file.read_integers(group + "/nodes", {kAnyExtent}), {}};
    const bool in_range = std::all_of(each.nodes.begin(), each.nodes.end(), [&](std::int32_t node) {
      return node >= 0 && static_cast<std::size_t>(node) < n;
    });
    if (!in_range) file.refuse(group + "/nodes", "a node number is out of range");
    each.stress_Pa = read_columns<6>(file, group + "/stress", each.nodes.size(), "Pa");
    solution.at_nodes.push_back(std::move(each));
  }
  for (const std::string& part : file.members("/integration_points")) {
    for (const std::string& kind : file.members("/integration_points/" + part)) {
      PointStresses each{part, kind, 0, {}, {}};
      const std::string group = group_of(each);
      const std::int64_t points = file.integer_attribute(group, "points_per_element");
      each.positions_m = read_columns<3>(file, group + "/positions", kAnyExtent, "m");
      const Eigen::Index count = each.positions_m.cols();
      if (points < 1 || count % points != 0)
        file.refuse(group + "/positions", "expected positions for a whole number of elements");
      each.points_per_element = static_cast<int>(points);
      each.stress_Pa =
          read_columns<6>(file, group + "/stress", static_cast<std::size_t>(count), "Pa");
      solution.at_points.push_back(std::move(each));
    }
  }
  solution.loads = file.read_strings("/step/loads");
  solution.imbalance = file.read_doubles("/step/imbalance", {1}, "1").front();
  solution.boundary = file.string_attribute("/step", "boundary");
  solution.solver = file.string_attribute("/step", "solver");
  content.provenance = read_provenance(file);
  check_balance(file, solution);
  return content;
}

}  // namespace flexneck::fe_modal
