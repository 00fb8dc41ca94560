// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include <Eigen/Geometry>

#include "fe_modal/body/skew.h"
#include "fe_modal/exchange/foreign_number.h"
#include "fe_modal/exchange/mbdyn_fem.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/text_file.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kMaxBytes = std::size_t{1} << 28U;
constexpr int kGroups = 19;

struct Word {
  std::string text;
  std::size_t line;
};

/// A file as its groups of words, without comments within a group.
class Groups {
 public:
  explicit Groups(const std::filesystem::path& path) : path_(path) {
    const std::string text = read_text(path, kMaxBytes);
    std::size_t number = 0;
    bool goes_on = true;
    for (std::size_t begin = 0; goes_on && begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      goes_on = take(std::string_view(text).substr(begin, end - begin), ++number);
      begin = end + 1;
    }
    if (words_.empty()) refuse(1, "expected '** RECORD GROUP 1', found none");
    // A truncated last number would still be read as a number.
    if (goes_on) refuse(number, "expected '** END OF FILE', found none: the file ends too early");
  }

  bool has(int group) const { return words_.count(group) > 0; }
  const std::vector<Word>& words(int group) const {
    const auto found = words_.find(group);
    if (found == words_.end())
      refuse(number_of_lines_, "there is no RECORD GROUP " + std::to_string(group));
    return found->second;
  }
  /// The numbers of a group as a matrix, rows x columns.
  MatrixXd matrix(int group, double rows, double columns) const {
    const std::vector<Word>& all = words(group);
    if (rows * columns != static_cast<double>(all.size()))
      refuse(all.empty() ? number_of_lines_ : all.front().line,
             "expected " + std::to_string(static_cast<std::size_t>(rows * columns)) +
                 " numbers in RECORD GROUP " + std::to_string(group) + ", found " +
                 std::to_string(all.size()));
    MatrixXd result(static_cast<Index>(rows), static_cast<Index>(columns));
    for (Index k = 0; k < result.size(); ++k)
      result(k / result.cols(), k % result.cols()) = number(all[static_cast<std::size_t>(k)]);
    return result;
  }
  double number(const Word& word) const {
    double value = 0;
    if (!read_number(word.text, value))
      refuse(word.line, "expected a number, found '" + word.text + "'");
    return value;
  }
  /// A count, no larger than the number of words in the file.
  std::size_t count(const Word& word, std::size_t least) const {
    const double value = number(word);
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(count_)) ||
        value != std::floor(value))
      refuse(word.line, "expected a count, found '" + word.text + "'");
    return static_cast<std::size_t>(value);
  }
  /// Names of interfaces, behind "** INTERFACE <label>", and texts of modes, behind the colon of
  /// each mode's line.
  const std::map<std::string, std::string>& interfaces() const { return interfaces_; }
  const std::vector<std::string>& mode_texts() const { return modes_; }

  [[noreturn]] void refuse(std::size_t line, const std::string& problem) const {
    throw InputError(path_.string() + ":" + std::to_string(line) + ": " + problem);
  }

 private:
  /// Takes a line.
  /// @return false at the end
  bool take(std::string_view line, std::size_t number) {
    number_of_lines_ = number;
    constexpr std::string_view kGroup = "** RECORD GROUP ";
    if (line.starts_with("** END OF FILE")) return false;
    if (line.starts_with(kGroup)) {
      line.remove_prefix(kGroup.size());
      const auto [after, error] = std::from_chars(line.data(), line.data() + line.size(), group_);
      if (error != std::errc() || group_ < 1 || group_ > kGroups)
        refuse(number, "expected a RECORD GROUP from 1 to " + std::to_string(kGroups));
      if (!words_.try_emplace(group_).second)
        refuse(number, "RECORD GROUP " + std::to_string(group_) + " occurs twice");
    } else if (line.starts_with("**")) {
      comment(line.substr(2));
    } else {
      add_words(line, number);
    }
    return true;
  }
  void comment(std::string_view text) {
    constexpr std::string_view kInterface = " INTERFACE ";
    if (text.starts_with(kInterface)) {
      text.remove_prefix(kInterface.size());
      const std::size_t space = std::min(text.find(' '), text.size() - 1);
      interfaces_.emplace(text.substr(0, space), text.substr(space + 1));
    } else if (group_ == 8 && !text.empty()) {
      const std::size_t colon = text.find(": ");
      modes_.emplace_back(colon == std::string_view::npos ? "" : text.substr(colon + 2));
    }
  }
  void add_words(std::string_view line, std::size_t number) {
    constexpr std::string_view kBlanks = " \t\r,";
    for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
      if (group_ == 0) refuse(number, "expected '** RECORD GROUP 1' before any number");
      words_[group_].push_back({std::string(line.substr(begin, end - begin)), number});
      ++count_;
      begin = line.find_first_not_of(kBlanks, end);
    }
  }

  std::filesystem::path path_;
  int group_ = 0;
  std::size_t count_ = 0, number_of_lines_ = 1;
  std::map<int, std::vector<Word>> words_;
  std::map<std::string, std::string> interfaces_;
  std::vector<std::string> modes_;
};

struct Extents {
  std::size_t nodes = 0, modes = 0;
};

Extents extents_of(const Groups& file) {
  const std::vector<Word>& header = file.words(1);
  if (header.size() != 6 || header.front().text != "REV0")
    file.refuse(header.empty() ? 1 : header.front().line,
                "expected 'REV0' and five counts in RECORD GROUP 1");
  Extents extents{file.count(header[1], 1), 0};
  for (std::size_t k = 2; k < 5; ++k) extents.modes += file.count(header[k], 0);
  if (extents.modes == 0) file.refuse(header[2].line, "the body has no modes");
  return extents;
}

std::vector<Interface> nodes_of(const Groups& file, const Extents& extents) {
  const auto n = static_cast<double>(extents.nodes);
  const auto m = static_cast<double>(extents.modes);
  const std::vector<Word>& labels = file.words(2);
  if (labels.size() != extents.nodes)
    file.refuse(labels.empty() ? 1 : labels.front().line,
                "expected " + std::to_string(extents.nodes) + " labels in RECORD GROUP 2, found " +
                    std::to_string(labels.size()));
  Eigen::MatrixXd places(3, static_cast<Index>(extents.nodes));
  for (int axis = 0; axis < 3; ++axis) places.row(axis) = file.matrix(5 + axis, 1, n);
  const MatrixXd shapes = file.matrix(8, n * m, 6);
  std::vector<Interface> nodes;
  for (std::size_t k = 0; k < extents.nodes; ++k) {
    const auto named = file.interfaces().find(labels[k].text);
    Interface node{named != file.interfaces().end() ? named->second : "node " + labels[k].text,
                   places.col(static_cast<Index>(k)), Eigen::Matrix3Xd(3, extents.modes),
                   Eigen::Matrix3Xd(3, extents.modes)};
    for (std::size_t l = 0; l < extents.modes; ++l) {
      const auto row = static_cast<Index>(l * extents.nodes + k);
      const auto column = static_cast<Index>(l);
      node.translation.col(column) = shapes.row(row).head<3>().transpose();
      node.rotation.col(column) = shapes.row(row).tail<3>().transpose();
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

/// List of the matrices that stand side by side in a group.
template <class Matrix>
std::vector<Matrix> list_of(const MatrixXd& all, double factor) {
  std::vector<Matrix> list;
  for (Index column = 0; column < all.cols(); column += Matrix::ColsAtCompileTime)
    list.push_back(factor * all.middleCols<Matrix::ColsAtCompileTime>(column));
  return list;
}

InertiaInvariants exact_invariants(const Groups& file, const Extents& extents) {
  const auto m = static_cast<double>(extents.modes);
  InertiaInvariants inertia;
  const MatrixXd rigid = file.matrix(12, 1, 13);
  inertia.mass = rigid(0);
  const Eigen::Vector3d center = rigid.middleCols<3>(1).transpose();
  Eigen::Matrix3d J;
  for (Index k = 0; k < 9; ++k) J(k / 3, k % 3) = rigid(4 + k);
  inertia.S1 = inertia.mass * center;
  inertia.J0 = J + inertia.mass * (center.squaredNorm() * Eigen::Matrix3d::Identity() -
                                   center * center.transpose());
  inertia.S2 = file.matrix(14, 3, m);
  inertia.N0 = file.matrix(15, 3, m);
  inertia.G0 = list_of<Eigen::Matrix3d>(file.matrix(16, 3, 3 * m), 1);
  inertia.N = list_of<Eigen::Vector3d>(file.matrix(17, 3, m * m), 1);
  inertia.G = list_of<Eigen::Matrix3d>(file.matrix(18, 3, 3 * m * m), -1);
  return inertia;
}

/// Inertia invariants as sums over the nodes, equations.md section 2.
InertiaInvariants lumped_invariants(const Groups& file, const Extents& extents,
                                    const std::vector<Interface>& nodes) {
  const MatrixXd lumps = file.matrix(11, static_cast<double>(extents.nodes), 6);
  if (!lumps.rightCols<3>().isZero(0))
    file.refuse(file.words(11).front().line,
                "lumped masses with rotary inertia are not supported; use a file with the "
                "invariants in RECORD GROUP 12 and 14 to 18");
  const std::size_t m = extents.modes;
  InertiaInvariants sum;
  sum.S1.setZero();
  sum.J0.setZero();
  sum.S2.setZero(3, static_cast<Index>(m));
  sum.N0.setZero(3, static_cast<Index>(m));
  sum.G0.assign(m, Eigen::Matrix3d::Zero());
  sum.G.assign(m * m, Eigen::Matrix3d::Zero());
  sum.N.assign(m * m, Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto row = static_cast<Index>(k);
    const double mass = lumps(row, 0);
    if (lumps(row, 1) != mass || lumps(row, 2) != mass)
      file.refuse(file.words(11)[6 * k].line, "expected the same mass in all three directions");
    const Eigen::Vector3d& s = nodes[k].position_m;
    const Eigen::Matrix3Xd& psi = nodes[k].translation;
    sum.mass += mass;
    sum.S1 += mass * s;
    sum.J0 -= mass * skew(s) * skew(s);
    sum.S2 += mass * psi;
    sum.N0 += mass * skew(s) * psi;
    for (std::size_t j = 0; j < m; ++j) {
      const Eigen::Vector3d psi_j = psi.col(static_cast<Index>(j));
      sum.G0[j] -= mass * skew(s) * skew(psi_j);
      for (std::size_t l = 0; l < m; ++l) {
        const Eigen::Vector3d psi_l = psi.col(static_cast<Index>(l));
        sum.G[j * m + l] -= mass * skew(psi_j) * skew(psi_l);
        sum.N[j * m + l] += mass * psi_j.cross(psi_l);
      }
    }
  }
  return sum;
}

InertiaInvariants invariants_of(const Groups& file, const Extents& extents,
                                const std::vector<Interface>& nodes) {
  InertiaInvariants inertia =
      file.has(11) ? lumped_invariants(file, extents, nodes) : exact_invariants(file, extents);
  const auto size = static_cast<double>(extents.modes);
  inertia.Maa = file.matrix(9, size, size);
  return inertia;
}

ReducedBody reduced_body(const Groups& file) {
  const Extents extents = extents_of(file);
  const auto m = static_cast<double>(extents.modes);
  ReducedBody body;
  body.nodes = nodes_of(file, extents);
  body.invariants = invariants_of(file, extents, body.nodes);
  body.stiffness = file.matrix(10, m, m);
  body.damping = file.has(13) ? file.matrix(13, m, m)
                              : MatrixXd::Zero(body.stiffness.rows(), body.stiffness.cols());
  if (file.mode_texts().size() == extents.modes)
    for (const std::string& text : file.mode_texts()) body.modes.push_back(mode_of_text(text));
  if (file.has(3) || file.has(4))
    body.notes.emplace_back(
        "initial modal coordinates and rates (RECORD GROUP 3 and 4) belong to a model, as "
        "modal_coordinates and modal_rates of its body");
  if (file.has(19)) body.notes.emplace_back("stress stiffening (RECORD GROUP 19) is lost");
  return body;
}

}  // namespace

ImportedModes read_mbdyn_fem(const std::filesystem::path& path) {
  const Groups file(path);
  const ReducedBody body = reduced_body(file);
  try {
    return import_modes(body);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace flexneck::fe_modal
