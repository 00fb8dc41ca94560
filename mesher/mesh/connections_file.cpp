// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/connections_file.h"

#include <algorithm>
#include <span>

namespace flexneck::mesher {
namespace {

const std::string kGroup = "/connections/";

template <std::size_t N>
void append(const std::array<double, N>& from, std::vector<double>& to) {
  to.insert(to.end(), from.begin(), from.end());
}

template <std::size_t N>
std::array<double, N> row(const std::vector<double>& values, std::size_t k) {
  std::array<double, N> result{};
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(N * k), N, result.begin());
  return result;
}

template <typename Item>
void write_names(Hdf5Writer& file, const std::string& group, const std::vector<Item>& items) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.name);
  file.write(group + "names", names);
}

/// Writes lists of different lengths, concatenated: offsets (items + 1) and entries. Returns the
/// entries.
template <typename Item, typename Entry>
std::vector<Entry> write_lists(Hdf5Writer& file, const std::string& group,
                               const std::vector<Item>& items, std::vector<Entry> Item::*list) {
  std::vector<std::int32_t> offsets = {0};
  std::vector<Entry> entries;
  for (const Item& item : items) {
    entries.insert(entries.end(), (item.*list).begin(), (item.*list).end());
    offsets.push_back(static_cast<std::int32_t>(entries.size()));
  }
  file.write(group + "offsets", offsets, {offsets.size()});
  return entries;
}

template <typename Item>
void write_nodes(Hdf5Writer& file, const std::string& group, const std::vector<Item>& items) {
  const std::vector<std::int32_t> nodes = write_lists(file, group, items, &Item::nodes);
  file.write(group + "nodes", nodes, {nodes.size()});
  std::vector<std::int32_t> directions;
  for (const Item& item : items) {
    for (const bool direction : item.directions) directions.push_back(direction ? 1 : 0);
  }
  file.write(group + "directions", directions, {items.size(), 3});
}

template <typename Item>
void write_terms(Hdf5Writer& file, const std::string& group, const std::vector<Item>& items) {
  write_names(file, group, items);
  std::vector<std::int32_t> sites;
  std::vector<double> coefficients;
  for (const Term& term : write_lists(file, group, items, &Item::terms)) {
    sites.push_back(term.site);
    append(term.coefficients, coefficients);
  }
  file.write(group + "sites", sites, {sites.size()});
  file.write(group + "coefficients", coefficients, {sites.size(), 3}, "1");
}

/// Names of a group's items; none if there is no such group.
std::vector<std::string> names_in(const Hdf5Reader& file, const std::string& group) {
  return file.has(group + "names") ? file.read_strings(group + "names")
                                   : std::vector<std::string>();
}

/// Reads the offsets of concatenated lists.
/// @param entries total length of the lists
std::vector<std::int32_t> read_offsets(const Hdf5Reader& file, const std::string& group,
                                       std::size_t items, std::size_t entries) {
  const std::string dataset = group + "offsets";
  std::vector<std::int32_t> offsets = file.read_integers(dataset, {items + 1});
  if (offsets.front() != 0 || !std::is_sorted(offsets.begin(), offsets.end()) ||
      static_cast<std::size_t>(offsets.back()) != entries) {
    file.refuse(dataset, "expected ascending numbers from 0 to " + std::to_string(entries));
  }
  return offsets;
}

template <typename Entry>
std::vector<Entry> list_of(const std::vector<Entry>& entries,
                           const std::vector<std::int32_t>& offsets, std::size_t k) {
  return {entries.begin() + offsets[k], entries.begin() + offsets[k + 1]};
}

template <typename Item>
void read_nodes(const Hdf5Reader& file, const std::string& group, std::vector<Item>& items) {
  const std::vector<std::int32_t> nodes = file.read_integers(group + "nodes", {kAnyExtent});
  const std::vector<std::int32_t> offsets = read_offsets(file, group, items.size(), nodes.size());
  const std::vector<std::int32_t> directions =
      file.read_integers(group + "directions", {items.size(), 3});
  for (std::size_t k = 0; k < items.size(); ++k) {
    items[k].nodes = list_of(nodes, offsets, k);
    for (std::size_t a = 0; a < 3; ++a) items[k].directions[a] = directions[3 * k + a] != 0;
  }
}

template <typename Item>
std::vector<Item> read_terms(const Hdf5Reader& file, const std::string& group) {
  std::vector<Item> items;
  for (const std::string& name : names_in(file, group)) items.emplace_back().name = name;
  if (items.empty()) return items;
  const std::vector<std::int32_t> sites = file.read_integers(group + "sites", {kAnyExtent});
  const std::vector<double> coefficients =
      file.read_doubles(group + "coefficients", {sites.size(), 3}, "1");
  std::vector<Term> terms;
  for (std::size_t t = 0; t < sites.size(); ++t) {
    terms.push_back({sites[t], row<3>(coefficients, t)});
  }
  const std::vector<std::int32_t> offsets = read_offsets(file, group, items.size(), sites.size());
  for (std::size_t k = 0; k < items.size(); ++k) items[k].terms = list_of(terms, offsets, k);
  return items;
}

void write_points(Hdf5Writer& file, const std::vector<ReferencePoint>& points) {
  if (points.empty()) return;
  const std::string group = kGroup + "points/";
  write_names(file, group, points);
  std::vector<double> positions;
  for (const ReferencePoint& point : points) append(point.position_m, positions);
  file.write(group + "positions", positions, {points.size(), 3}, "m");
}

std::vector<ReferencePoint> read_points(const Hdf5Reader& file) {
  const std::string group = kGroup + "points/";
  std::vector<ReferencePoint> points;
  for (const std::string& name : names_in(file, group)) points.push_back({name, {}});
  if (points.empty()) return points;
  const auto positions = file.read_doubles(group + "positions", {points.size(), 3}, "m");
  for (std::size_t k = 0; k < points.size(); ++k) points[k].position_m = row<3>(positions, k);
  return points;
}

void write_couplings(Hdf5Writer& file, const std::vector<Coupling>& couplings) {
  if (couplings.empty()) return;
  const std::string group = kGroup + "couplings/";
  write_names(file, group, couplings);
  write_nodes(file, group, couplings);
  std::vector<std::int32_t> points;
  for (const Coupling& coupling : couplings) points.push_back(coupling.point);
  file.write(group + "points", points, {points.size()});
}

std::vector<Coupling> read_couplings(const Hdf5Reader& file) {
  const std::string group = kGroup + "couplings/";
  std::vector<Coupling> couplings;
  for (const std::string& name : names_in(file, group)) couplings.emplace_back().name = name;
  if (couplings.empty()) return couplings;
  read_nodes(file, group, couplings);
  const auto points = file.read_integers(group + "points", {couplings.size()});
  for (std::size_t k = 0; k < couplings.size(); ++k) couplings[k].point = points[k];
  return couplings;
}

void write_supports(Hdf5Writer& file, const std::vector<Support>& supports) {
  if (supports.empty()) return;
  const std::string group = kGroup + "supports/";
  write_names(file, group, supports);
  write_nodes(file, group, supports);
  std::vector<double> origins;
  std::vector<double> axes;
  std::vector<std::int32_t> cylindrical;
  for (const Support& support : supports) {
    const AxisSystem& system = support.axes;
    origins.insert(origins.end(), system.origin_m.begin(), system.origin_m.end());
    for (const auto& axis : system.axes.colwise())
      axes.insert(axes.end(), axis.begin(), axis.end());
    cylindrical.push_back(system.is_cylindrical ? 1 : 0);
  }
  file.write(group + "origins", origins, {supports.size(), 3}, "m");
  file.write(group + "axes", axes, {supports.size(), 3, 3}, "1");
  file.write(group + "cylindrical", cylindrical, {supports.size()});
}

std::vector<Support> read_supports(const Hdf5Reader& file) {
  const std::string group = kGroup + "supports/";
  std::vector<Support> supports;
  for (const std::string& name : names_in(file, group)) supports.emplace_back().name = name;
  if (supports.empty()) return supports;
  read_nodes(file, group, supports);
  const auto origins = file.read_doubles(group + "origins", {supports.size(), 3}, "m");
  const auto axes = file.read_doubles(group + "axes", {supports.size(), 3, 3}, "1");
  const auto cylindrical = file.read_integers(group + "cylindrical", {supports.size()});
  for (std::size_t k = 0; k < supports.size(); ++k) {
    AxisSystem& system = supports[k].axes;
    system.origin_m = Eigen::Vector3d(row<3>(origins, k).data());
    system.axes = Eigen::Matrix3d(row<9>(axes, k).data());
    system.is_cylindrical = cylindrical[k] != 0;
    constexpr double kUnit = 1e-6;  // axes in files may be of single precision
    if (!(system.axes.transpose() * system.axes).isIdentity(kUnit)) {
      file.refuse(group + "axes", "expected three mutually orthogonal unit vectors");
    }
  }
  return supports;
}

void write_springs(Hdf5Writer& file, const std::vector<Spring>& springs) {
  if (springs.empty()) return;
  write_terms(file, kGroup + "springs/", springs);
  std::vector<double> stiffness;
  for (const Spring& spring : springs) stiffness.push_back(spring.stiffness);
  file.write(kGroup + "springs/stiffness", stiffness, {stiffness.size()}, "N/m");
}

std::vector<Spring> read_springs(const Hdf5Reader& file) {
  std::vector<Spring> springs = read_terms<Spring>(file, kGroup + "springs/");
  if (springs.empty()) return springs;
  const auto stiffness = file.read_doubles(kGroup + "springs/stiffness", {springs.size()}, "N/m");
  for (std::size_t k = 0; k < springs.size(); ++k) springs[k].stiffness = stiffness[k];
  return springs;
}

void write_masses(Hdf5Writer& file, const std::vector<PointMass>& masses) {
  if (masses.empty()) return;
  const std::string group = kGroup + "masses/";
  write_names(file, group, masses);
  std::vector<std::int32_t> sites;
  std::vector<double> values;
  std::vector<double> centers;
  std::vector<double> inertias;
  for (const PointMass& mass : masses) {
    sites.push_back(mass.site);
    values.push_back(mass.mass_kg);
    append(mass.center_m, centers);
    append(mass.inertia_kg_m2, inertias);
  }
  file.write(group + "sites", sites, {sites.size()});
  file.write(group + "masses", values, {sites.size()}, "kg");
  file.write(group + "centers", centers, {sites.size(), 3}, "m");
  file.write(group + "inertias", inertias, {sites.size(), 6}, "kg m^2");
}

std::vector<PointMass> read_masses(const Hdf5Reader& file) {
  const std::string group = kGroup + "masses/";
  std::vector<PointMass> masses;
  for (const std::string& name : names_in(file, group)) masses.emplace_back().name = name;
  if (masses.empty()) return masses;
  const std::size_t count = masses.size();
  const auto sites = file.read_integers(group + "sites", {count});
  const auto values = file.read_doubles(group + "masses", {count}, "kg");
  const auto centers = file.read_doubles(group + "centers", {count, 3}, "m");
  const auto inertias = file.read_doubles(group + "inertias", {count, 6}, "kg m^2");
  for (std::size_t k = 0; k < count; ++k) {
    masses[k] = {masses[k].name, sites[k], values[k], row<3>(centers, k), row<6>(inertias, k)};
  }
  return masses;
}

}  // namespace

void write_connections(Hdf5Writer& file, const Connections& connections) {
  write_points(file, connections.points);
  write_couplings(file, connections.couplings);
  write_supports(file, connections.supports);
  if (!connections.equations.empty()) {
    write_terms(file, kGroup + "equations/", connections.equations);
  }
  write_springs(file, connections.springs);
  write_masses(file, connections.masses);
}

Connections read_connections(const Hdf5Reader& file) {
  return {read_points(file),   read_couplings(file),
          read_supports(file), read_terms<Equation>(file, kGroup + "equations/"),
          read_springs(file),  read_masses(file)};
}

}  // namespace flexneck::mesher
