// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/element/point_tables.h"

#include <cmath>

#include "mesher/mesh/element_kind.h"

namespace flexneck::fe_modal {
namespace {

constexpr std::size_t kLine = 3;
constexpr std::size_t kCube = kLine * kLine * kLine;
/// From a place to the next in directions x, y and z.
constexpr std::size_t kStepX = kLine * kLine;
constexpr std::size_t kStepY = kLine;
constexpr std::size_t kStepZ = 1;

/// y (+)= table x on each of the nine lines in a direction.
template <std::size_t step, bool adds, typename Row>
[[gnu::always_inline]] inline void contract(const double* table, const Row* x, Row* y) {
  for (std::size_t line = 0; line < kLine * kLine; ++line) {
    // Places of the other two directions, of which the lower is below the step.
    const std::size_t first = line / step * step * kLine + line % step;
    for (std::size_t q = 0; q < kLine; ++q) {
      Row sum{};
      if constexpr (adds) sum = y[first + q * step];
      for (std::size_t i = 0; i < kLine; ++i) {
        sum.add(table[q * kLine + i], x[first + i * step]);
      }
      y[first + q * step] = sum;
    }
  }
}

/// y = the same table in all three directions; x is overwritten.
template <typename Row>
[[gnu::always_inline]] inline void contract_all(const double* table, Row* x, Row* y) {
  contract<kStepX, false>(table, x, y);
  contract<kStepY, false>(table, y, x);
  contract<kStepZ, false>(table, x, y);
}

/// Row 3 p + b: derivative b at point p.
Eigen::MatrixXd gradient_table(const mesher::ShapeTable& table) {
  Eigen::MatrixXd result(3 * table.values.cols(), table.values.rows());
  for (Eigen::Index p = 0; p < table.values.cols(); ++p) {
    for (std::size_t b = 0; b < 3; ++b) {
      result.row(3 * p + static_cast<Eigen::Index>(b)) = table.derivatives[b].col(p).transpose();
    }
  }
  return result;
}

/// N N^T of each point.
std::vector<Eigen::MatrixXd> unit_masses(const mesher::ShapeTable& table) {
  std::vector<Eigen::MatrixXd> result;
  for (const auto& at_point : table.values.colwise()) {
    result.emplace_back(at_point * at_point.transpose());
  }
  return result;
}

std::array<double, 9> transposed(const std::array<double, 9>& table) {
  std::array<double, 9> result{};
  for (std::size_t q = 0; q < kLine; ++q) {
    for (std::size_t i = 0; i < kLine; ++i) result[kLine * i + q] = table[kLine * q + i];
  }
  return result;
}

std::variant<FullTables, LineTables> tables_of(mesher::ElementKind kind,
                                               const mesher::Quadrature& rule,
                                               VectorRegisters registers) {
  if (kind == mesher::ElementKind::hex27 && rule.points.cols() == kCube) {
    // The first three points of a product rule differ in the last coordinate.
    return LineTables({rule.points(2, 0), rule.points(2, 1), rule.points(2, 2)}, registers);
  }
  return FullTables(mesher::tabulate(kind, rule.points), registers);
}

}  // namespace

LineTables::LineTables(const std::array<double, 3>& positions, VectorRegisters registers)
    : registers_(registers) {
  std::size_t node = 0;
  for (const auto& coordinates : mesher::reference_nodes(mesher::ElementKind::hex27)) {
    const auto along = [&](std::size_t a) {
      return static_cast<std::size_t>(std::lround(coordinates[a] + 1));
    };
    place_of_node_[node++] = kStepX * along(0) + kStepY * along(1) + kStepZ * along(2);
  }
  for (std::size_t q = 0; q < kLine; ++q) {
    const double x = positions[q];
    const std::array values = {x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2};
    const std::array derivatives = {x - 0.5, -2 * x, x + 0.5};
    for (std::size_t i = 0; i < kLine; ++i) {
      values_[kLine * q + i] = values[i];
      derivatives_[kLine * q + i] = derivatives[i];
    }
  }
  values_transposed_ = transposed(values_);
  derivatives_transposed_ = transposed(derivatives_);
}

void LineTables::to_gradients(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
  run_with(
      registers_, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        using Row = RegisterRow<double, bytes>;
        const double* const values = values_.data();
        const double* const derivatives = derivatives_.data();
        for (std::size_t g = 0; g < groups; ++g) {
          Row nodes[kCube];
          for (std::size_t i = 0; i < kCube; ++i) nodes[place_of_node_[i]].load(x[i * groups + g]);
          Row by_z[kCube];
          contract<kStepZ, false>(derivatives, nodes, by_z);
          Row plain[kCube];
          contract<kStepZ, false>(values, nodes, plain);
          Row by_y[kCube];
          contract<kStepY, false>(derivatives, plain, by_y);
          contract<kStepY, false>(values, plain, nodes);
          contract<kStepY, false>(values, by_z, plain);
          Row result[3][kCube];
          contract<kStepX, false>(derivatives, nodes, result[0]);
          contract<kStepX, false>(values, by_y, result[1]);
          contract<kStepX, false>(values, plain, result[2]);
          for (std::size_t p = 0; p < kCube; ++p) {
            for (std::size_t b = 0; b < 3; ++b) result[b][p].store(y[(3 * p + b) * groups + g]);
          }
        }
      });
}

void LineTables::from_gradients(const RowOf<double>* x, std::size_t groups,
                                RowOf<double>* y) const {
  run_with(
      registers_, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        using Row = RegisterRow<double, bytes>;
        const double* const values = values_transposed_.data();
        const double* const derivatives = derivatives_transposed_.data();
        for (std::size_t g = 0; g < groups; ++g) {
          Row given[3][kCube];
          for (std::size_t p = 0; p < kCube; ++p) {
            for (std::size_t b = 0; b < 3; ++b) given[b][p].load(x[(3 * p + b) * groups + g]);
          }
          Row by_x[kCube];
          contract<kStepX, false>(derivatives, given[0], by_x);
          Row by_y[kCube];
          contract<kStepX, false>(values, given[1], by_y);
          Row by_z[kCube];
          contract<kStepX, false>(values, given[2], by_z);
          Row plain[kCube];
          contract<kStepY, false>(values, by_x, plain);
          contract<kStepY, true>(derivatives, by_y, plain);
          contract<kStepY, false>(values, by_z, by_x);
          Row nodes[kCube];
          contract<kStepZ, false>(values, plain, nodes);
          contract<kStepZ, true>(derivatives, by_x, nodes);
          for (std::size_t i = 0; i < kCube; ++i) nodes[place_of_node_[i]].store(y[i * groups + g]);
        }
      });
}

void LineTables::to_values(const RowOf<double>* x, std::size_t groups, RowOf<double>* y) const {
  run_with(
      registers_, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        using Row = RegisterRow<double, bytes>;
        for (std::size_t g = 0; g < groups; ++g) {
          Row nodes[kCube];
          for (std::size_t i = 0; i < kCube; ++i) nodes[place_of_node_[i]].load(x[i * groups + g]);
          Row points[kCube];
          contract_all(values_.data(), nodes, points);
          for (std::size_t p = 0; p < kCube; ++p) points[p].store(y[p * groups + g]);
        }
      });
}

void LineTables::multiply_by_mass(const Eigen::VectorXd& masses_kg, const RowOf<double>* x,
                                  std::size_t groups, RowOf<double>* y) const {
  run_with(
      registers_, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        using Row = RegisterRow<double, bytes>;
        const double* const masses = masses_kg.data();
        for (std::size_t g = 0; g < groups; ++g) {
          Row nodes[kCube];
          for (std::size_t i = 0; i < kCube; ++i) nodes[place_of_node_[i]].load(x[i * groups + g]);
          Row points[kCube];
          contract_all(values_.data(), nodes, points);
          for (std::size_t p = 0; p < kCube; ++p) {
            Row momentum{};
            momentum.add(masses[p], points[p]);
            points[p] = momentum;
          }
          contract_all(values_transposed_.data(), points, nodes);
          for (std::size_t i = 0; i < kCube; ++i) nodes[place_of_node_[i]].store(y[i * groups + g]);
        }
      });
}

FullTables::FullTables(const mesher::ShapeTable& table, VectorRegisters registers)
    : registers_(registers),
      gradients_(gradient_table(table)),
      gradients_transposed_(gradient_table(table).transpose()),
      values_(table.values.transpose()),
      mass_(unit_masses(table)) {}

void FullTables::multiply_by_mass(const Eigen::VectorXd& masses_kg, const RowOf<double>* x,
                                  std::size_t groups, RowOf<double>* y) {
  mass_.with(masses_kg, registers_).multiply(x, groups, y, registers_);
}

PointTables::PointTables(mesher::ElementKind kind, const mesher::Quadrature& rule,
                         VectorRegisters registers)
    : tables_(tables_of(kind, rule, registers)) {}

}  // namespace flexneck::fe_modal
