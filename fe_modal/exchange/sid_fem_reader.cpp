// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "fe_modal/exchange/foreign_number.h"
#include "fe_modal/exchange/sid_fem.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/text_file.h"

namespace flexneck::fe_modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t kMaxBytes = std::size_t{1} << 28U;
constexpr Index kMaxModes = 1000;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Reads a file line by line.
class Lines {
 public:
  Lines(std::filesystem::path path, std::string_view text) : path_(std::move(path)), rest_(text) {}

  /// Goes to the next line that is not empty, split at its first '='; the value is empty if there
  /// is none.
  void next() {
    do {
      if (rest_.empty()) refuse("the file ends too early");
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
    } while (line_.empty());
    const std::size_t equals = line_.find('=');
    key_ = trimmed(line_.substr(0, equals));
    value_ =
        equals == std::string_view::npos ? std::string_view() : trimmed(line_.substr(equals + 1));
  }
  std::string_view line() const { return line_; }
  std::string_view key() const { return key_; }
  std::string_view value() const { return value_; }
  std::size_t number() const { return number_; }

  void expect(std::string_view line) {
    if (key_ != line)
      refuse("expected '" + std::string(line) + "', found '" + std::string(key_) + "'");
  }
  double real() const {
    double value = 0;
    if (!read_number(std::string(value_), value))
      refuse("expected a number, found '" + std::string(value_) + "'");
    return value;
  }
  /// Whole number that is the value of a key.
  Index whole(std::string_view name, Index least, Index most) {
    expect(name);
    Index value = 0;
    const auto [after, error] =
        std::from_chars(value_.data(), value_.data() + value_.size(), value);
    if (error != std::errc() || after != value_.data() + value_.size() || value < least ||
        value > most)
      refuse("expected '" + std::string(name) + "' from " + std::to_string(least) + " to " +
             std::to_string(most) + ", found '" + std::string(value_) + "'");
    return value;
  }
  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(path_.string() + ":" + std::to_string(number_) + ": " + problem);
  }

 private:
  std::filesystem::path path_;
  std::string_view rest_, line_, key_, value_;
  std::size_t number_ = 0;
};

/// A matrix that depends on the modal coordinates q: m0 + sum_k q_k m1[k].
struct Series {
  MatrixXd m0;
  std::vector<MatrixXd> m1;  ///< empty at order 0
  std::size_t line = 0;
};

/// Indices in a key such as "m1( 2, 1,12)".
std::vector<Index> indices_of(const Lines& file) {
  std::string_view key = file.key();
  std::vector<Index> indices;
  if (key.size() < 5 || key[2] != '(' || key.back() != ')')
    file.refuse("expected an entry m0(i,j) or m1(i,k,j), found '" + std::string(key) + "'");
  key = key.substr(3, key.size() - 4);
  while (!key.empty()) {
    const std::size_t comma = std::min(key.find(','), key.size());
    const std::string_view text = trimmed(key.substr(0, comma));
    Index index = 0;
    const auto [after, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || after != text.data() + text.size())
      file.refuse("expected whole numbers in '" + std::string(file.key()) + "'");
    indices.push_back(index - 1);
    key.remove_prefix(std::min(comma + 1, key.size()));
  }
  return indices;
}

/// Codes of matrix structures in the file.
constexpr Index kSymmetric = 2, kUnit = 4;

void read_entry(const Lines& file, Index structure, Series& series) {
  const std::vector<Index> at = indices_of(file);
  const bool is_first = file.key().starts_with("m1");
  if (at.size() != (is_first ? 3U : 2U) || !(is_first || file.key().starts_with("m0")))
    file.refuse("expected an entry m0(i,j) or m1(i,k,j), found '" + std::string(file.key()) + "'");
  const Index i = at.front(), j = at.back(), k = is_first ? at[1] : 0;
  if (i < 0 || i >= series.m0.rows() || j < 0 || j >= series.m0.cols() || k < 0 ||
      (is_first && k >= static_cast<Index>(series.m1.size())))
    file.refuse("'" + std::string(file.key()) + "' is outside the block");
  MatrixXd& matrix = is_first ? series.m1[static_cast<std::size_t>(k)] : series.m0;
  matrix(i, j) = file.real();
  if (structure == kSymmetric && j < matrix.rows() && i < matrix.cols())
    matrix(j, i) = matrix(i, j);
}

struct Block {
  Index rows, columns, order;  ///< the last at most
};

/// Reads the lines of a block behind its name, to its end.
Series read_series(Lines& file, const std::string& name, const Block& block, Index modes) {
  Series series;
  series.line = file.number();
  const auto next = [&](std::string_view key, Index least, Index most) {
    file.next();
    return file.whole(key, least, most);
  };
  const auto [rows, columns, max_order] = block;
  const Index order = next("order", 0, max_order);
  next("nrow", rows, rows);
  next("ncol", columns, columns);
  next("nq", modes, modes);
  next("nqn", 0, 0);
  const Index structure = next("structure", 0, kUnit);
  series.m0 = structure == kUnit ? MatrixXd::Identity(rows, columns).eval()
                                 : MatrixXd::Zero(rows, columns).eval();
  if (order > 0) series.m1.assign(static_cast<std::size_t>(modes), MatrixXd::Zero(rows, columns));
  for (file.next(); file.line() != "end " + name; file.next()) read_entry(file, structure, series);
  return series;
}

Interface read_node(Lines& file, const std::map<std::string, std::string>& names, Index modes) {
  const std::string id(file.value());
  const auto named = names.find(id);
  Interface node{named != names.end() ? named->second : "node " + id, Eigen::Vector3d::Zero(),
                 Eigen::Matrix3Xd::Zero(3, modes), Eigen::Matrix3Xd::Zero(3, modes)};
  for (file.next(); file.line() != "end node"; file.next()) {
    if (file.key() == "rframe") continue;
    if (file.line() == "origin") {
      node.position_m = read_series(file, "origin", {3, 1, 1}, modes).m0;
    } else if (file.line() == "phi") {
      node.translation = read_series(file, "phi", {3, modes, 0}, modes).m0;
    } else if (file.line() == "psi") {
      node.rotation = read_series(file, "psi", {3, modes, 0}, modes).m0;
    } else if (file.line() == "AP") {
      if (!read_series(file, "AP", {3, 3, 1}, modes).m0.isIdentity(1e-9))
        file.refuse(
            "expected nodes whose axes are parallel to those of the body; rotated axes are "
            "supported only by the markers of a model");
    } else {
      file.refuse("expected origin, phi, psi or AP, found '" + std::string(file.line()) + "'");
    }
  }
  return node;
}

/// Contents of the file, by the names of its blocks.
struct Contents {
  double mass = 0;
  Index modes = 0;
  std::vector<ModeRecord> records;
  std::vector<Interface> nodes;
  std::map<std::string, Series> blocks;
};

/// Names of the nodes in the first line, "…; 1 = base; 2 = top".
std::map<std::string, std::string> names_in(std::string_view text) {
  std::map<std::string, std::string> names;
  for (std::size_t place = text.find(';'); place != std::string_view::npos;) {
    const std::size_t next = text.find(';', place + 1);
    const std::string_view part = text.substr(place + 1, next - place - 1);
    if (const std::size_t equals = part.find(" = "); equals != std::string_view::npos)
      names.emplace(trimmed(part.substr(0, equals)), trimmed(part.substr(equals + 3)));
    place = next;
  }
  return names;
}

void read_reference(Lines& file, Contents& contents) {
  for (file.next(); file.line() != "end refmod"; file.next()) {
    if (file.key() == "mass") {
      contents.mass = file.real();
    } else if (file.key() == "nelastq") {
      contents.modes = file.whole("nelastq", 1, kMaxModes);
    } else if (file.key().starts_with("ielastq")) {
      const std::size_t place = file.value().find("Hz: ");
      contents.records.push_back(place == std::string_view::npos
                                     ? ModeRecord{}
                                     : mode_of_text(std::string(file.value().substr(place + 4))));
    } else {
      file.refuse("expected mass, nelastq or ielastq, found '" + std::string(file.line()) + "'");
    }
  }
  if (contents.modes == 0)
    file.refuse("expected nelastq, the number of modes, in refmod, found none");
  if (contents.records.size() != static_cast<std::size_t>(contents.modes)) contents.records.clear();
}

Contents read_contents(Lines& file) {
  Contents contents;
  file.next();
  const std::size_t colon = file.line().find(':');
  if (colon == std::string_view::npos)
    file.refuse("expected the numbers of nodes and modes, a colon and a text");
  const auto names = names_in(file.line().substr(colon));
  file.next();
  file.expect("part");
  file.next();
  file.expect("new modal");
  file.next();
  file.expect("refmod");
  read_reference(file, contents);
  const Index m = contents.modes;
  file.next();
  file.expect("frame");
  for (file.next(); file.line() != "end frame"; file.next()) {
    file.expect("new node");
    contents.nodes.push_back(read_node(file, names, m));
  }
  const std::map<std::string, Block, std::less<>> kinds = {
      {"mdCM", {3, 1, 1}},   {"J", {6, 1, 1}},      {"Ct", {m, 3, 1}},     {"Cr", {m, 3, 1}},
      {"Me", {m, m, 0}},     {"Gr", {3, 3 * m, 1}}, {"Ge", {m, 3 * m, 0}}, {"Oe", {m, 6, 1}},
      {"ksigma", {m, 1, 0}}, {"Ke", {m, m, 0}},     {"De", {m, m, 0}}};
  for (file.next(); file.line() != "end modal"; file.next()) {
    const auto kind = kinds.find(file.line());
    if (kind == kinds.end())
      file.refuse("expected a block such as mdCM, J or Ke, found '" + std::string(file.line()) +
                  "'");
    Series series = read_series(file, kind->first, kind->second, m);
    if (!contents.blocks.emplace(kind->first, std::move(series)).second)
      file.refuse(kind->first + " occurs twice");
  }
  for (const auto& [name, block] : kinds)
    if (contents.blocks.count(name) == 0) file.refuse("the block " + name + " is missing");
  return contents;
}

/// Symmetric tensor from xx, yy, zz, xy, xz, yz.
Eigen::Matrix3d tensor_of(const MatrixXd& six) {
  Eigen::Matrix3d J;
  J << six(0), six(3), six(4), six(3), six(1), six(5), six(4), six(5), six(2);
  return J;
}

/// Symmetric tensor from the factors of wx^2, wy^2, wz^2, wx wy, wy wz, wx wz.
Eigen::Matrix3d tensor_of_products(const Eigen::RowVectorXd& six) {
  Eigen::Matrix3d G;
  G << six[0], six[3] / 2, six[5] / 2, six[3] / 2, six[1], six[4] / 2, six[5] / 2, six[4] / 2,
      six[2];
  return G;
}

double largest(const MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

void require_first_order(const Lines& file, const Contents& contents, const std::string& name,
                         const std::string& what) {
  if (contents.blocks.at(name).m1.empty())
    file.refuse(name + " has no first-order terms, so that the file lacks the " + what);
}

InertiaInvariants invariants_of(const Lines& file, const Contents& contents) {
  const auto& at = contents.blocks;
  require_first_order(file, contents, "Oe", "centrifugal terms of deformed modes");
  require_first_order(file, contents, "J", "changes of the moments of inertia");
  require_first_order(file, contents, "Cr", "coupling of deformed modes with rotations");
  const Index m = contents.modes;
  InertiaInvariants inertia;
  inertia.mass = contents.mass;
  inertia.S1 = at.at("mdCM").m0;
  inertia.J0 = tensor_of(at.at("J").m0);
  inertia.S2 = at.at("Ct").m0.transpose();
  inertia.N0 = at.at("Cr").m0.transpose();
  inertia.Maa = at.at("Me").m0;
  for (Index l = 0; l < m; ++l) inertia.G0.push_back(at.at("Gr").m0.middleCols<3>(3 * l) / 2);
  for (Index k = 0; k < m; ++k) {
    for (Index l = 0; l < m; ++l) {
      inertia.N.emplace_back(at.at("Cr").m1[static_cast<std::size_t>(k)].row(l).transpose());
      const Eigen::Matrix3d symmetric =
          -tensor_of_products(at.at("Oe").m1[static_cast<std::size_t>(k)].row(l));
      inertia.G.push_back(inertia_integral(symmetric, inertia.N.back()));
    }
  }
  return inertia;
}

/// Error of Ge in the better of two orders of its columns: three columns a mode, as readers take
/// it, or, as in the samples of EMBS_ModelicaLib by PY_SID, a column a mode for each axis.
double difference_of_Ge(const MatrixXd& Ge, const InertiaInvariants& inertia) {
  const Index m = Ge.rows();
  double by_modes = 0, by_axes = 0;
  for (Index k = 0; k < m; ++k)
    for (Index l = 0; l < m; ++l)
      for (Index axis = 0; axis < 3; ++axis) {
        const double expected = 2 * inertia.N[static_cast<std::size_t>(k * m + l)][axis];
        by_modes = std::max(by_modes, std::abs(Ge(l, 3 * k + axis) - expected));
        by_axes = std::max(by_axes, std::abs(Ge(l, axis * m + k) - expected));
      }
  return std::min(by_modes, by_axes);
}

/// Checks data that is redundant among blocks, beyond the checks of import_modes().
void check_blocks(const Contents& contents, const InertiaInvariants& inertia) {
  const auto& at = contents.blocks;
  const Index m = contents.modes;
  const double mass = largest(inertia.Maa);
  require_agreement("Cr and Ge", difference_of_Ge(at.at("Ge").m0, inertia), mass);
  for (Index k = 0; k < m; ++k) {
    const auto index = static_cast<std::size_t>(k);
    const std::string mode = " of mode " + std::to_string(k + 1);
    const Eigen::Matrix3d& G0 = inertia.G0[index];
    require_agreement("J and Gr" + mode,
                      largest(tensor_of(at.at("J").m1[index]) - G0 - G0.transpose()), G0.norm());
    require_agreement("Oe and Gr" + mode,
                      largest(2 * tensor_of_products(at.at("Oe").m0.row(k)) + G0 + G0.transpose()),
                      G0.norm());
    if (const auto& first = at.at("mdCM").m1; !first.empty())
      require_agreement("mdCM and Ct" + mode, largest(first[index] - inertia.S2.col(k)),
                        inertia.S2.col(k).norm());
    for (Index l = 0; l < m; ++l) {
      const auto pair = static_cast<std::size_t>(k * m + l);
      const std::string modes = mode + " with " + std::to_string(l + 1);
      if (const auto& first = at.at("Gr").m1; !first.empty())
        require_agreement("Gr and Oe" + modes,
                          largest(first[index].middleCols<3>(3 * l) / 2 - inertia.G[pair]), mass);
    }
  }
}

ReducedBody reduced_body(const Lines& file, const Contents& contents) {
  ReducedBody body;
  body.invariants = invariants_of(file, contents);
  body.stiffness = contents.blocks.at("Ke").m0;
  body.damping = contents.blocks.at("De").m0;
  body.modes = contents.records;
  body.nodes = contents.nodes;
  const Series& stress = contents.blocks.at("ksigma");
  if (!stress.m0.isZero(0)) body.notes.emplace_back("stresses of the reference (ksigma) are lost");
  if (!contents.blocks.at("Ct").m1.empty())
    body.notes.emplace_back("geometric stiffening (first order of Ct) is lost");
  return body;
}

}  // namespace

ImportedModes read_sid_fem(const std::filesystem::path& path) {
  const std::string text = read_text(path, kMaxBytes);
  Lines file(path, text);
  const Contents contents = read_contents(file);
  const ReducedBody body = reduced_body(file, contents);
  try {
    check_blocks(contents, body.invariants);
    return import_modes(body);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace flexneck::fe_modal
