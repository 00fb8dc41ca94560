// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/report/figures/neck_drawings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "geometry/foundation/units.h"
#include "pipeline/results/report/figures/bent_neck.h"
#include "pipeline/results/report/figures/neck_outline.h"
#include "pipeline/results/report/head_shape.h"

namespace flexneck::pipeline {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const char* const kThin = "lw 1 lc rgb '#555555'";
const char* const kDashed = "lw 1.2 dt (5,4) lc rgb '#808890'";
const char* const kVector = "lw 2 lc rgb '#0072b2'";
const char* const kForce = "lw 3 lc rgb '#d55e00'";

double inches(double metres) { return metres * factor_from_si("m", "in"); }

Vector2d inches_in_plane(const Vector3d& metres) {
  return {inches(metres.x()), inches(metres.z())};
}

Matrix2d turned(double angle_rad) {
  Matrix2d turn;
  turn << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad), std::cos(angle_rad);
  return turn;
}

Drawing::Shape line(const std::string& name, const Vector2d& from, const Vector2d& to,
                    const std::string& style) {
  Drawing::Shape shape{name, Drawing::Points(2, 2), "", style};
  shape.points << from, to;
  return shape;
}

Drawing::Shape box(const std::string& name, double left, double right, double bottom, double top,
                   const std::string& fill) {
  Drawing::Shape shape{name, Drawing::Points(2, 5), fill};
  shape.points << left, right, right, left, left, bottom, bottom, top, top, bottom;
  return shape;
}

void append(std::vector<Drawing::Shape>& to, std::vector<Drawing::Shape> from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

/// Adds the axes of a frame with their names.
void add_frame(Drawing& drawing, const Vector2d& origin, const Matrix2d& axes, double length,
               const std::string& x, const std::string& z) {
  for (int k = 0; k < 2; ++k) {
    const Vector2d end = origin + length * axes.col(k);
    drawing.arrows.push_back({origin, end, "lw 1.6 lc rgb '#222222'"});
    drawing.labels.push_back({k == 0 ? x : z, end + 0.25 * axes.col(k), "center"});
  }
}

Figure kinematics(const Results& results, const geometry::NeckParameters& neck) {
  Figure figure{1, "Kinematics of a deformable body",
                "The neck as the deformable body, its first mode as the deformation."};
  if (!results.modes) {
    figure.missing = "the modes";
    return figure;
  }
  const fe_modal::ModalBody& body = *results.modes;
  const double length = neck.length;
  const Vector3d tip_shape = body.interface("top").translation.col(0);
  const double amplitude = 0.22 * length / tip_shape.norm();
  const NeckOutline undeformed(neck);
  NeckOutline deformed = undeformed;
  deformed.deform(body, {0}, Eigen::VectorXd::Constant(1, amplitude));

  const Matrix2d turn = turned(-0.35);
  const Vector2d origin(5, 2.5);
  const Vector3d& top_m = body.interface("top").position_m;
  const Vector2d joint(inches(top_m.x()), inches(top_m.z()));
  const Vector2d moved = joint + inches(amplitude) * Vector2d(tip_shape.x(), tip_shape.z());
  Drawing drawing;
  drawing.unit = "in";
  drawing.shapes = deformed.shapes(turn, origin);
  append(drawing.shapes, undeformed.lines(turn, origin, " undeformed", kDashed));
  const Vector2d before = origin + turn * joint;
  const Vector2d after = origin + turn * moved;
  add_frame(drawing, Vector2d::Zero(), Matrix2d::Identity(), 2, "X", "Z");
  add_frame(drawing, origin, turn, 2.2, "x", "z");
  drawing.arrows.push_back({Vector2d::Zero(), origin, kVector});
  drawing.arrows.push_back({origin, before, kVector});
  drawing.arrows.push_back({before, after, kForce});
  drawing.arrows.push_back({Vector2d::Zero(), after, "lw 1.2 dt (5,4) lc rgb '#0072b2'"});
  drawing.labels.push_back({"x", origin / 2 + Vector2d(0.2, -0.35)});
  drawing.labels.push_back({"s_k0", origin + 0.62 * (before - origin) + Vector2d(-1.1, 0)});
  drawing.labels.push_back({"u = Ψ a", (before + after) / 2 + Vector2d(-0.2, 0.4), "center"});
  drawing.labels.push_back({"node k", after + Vector2d(0.25, 0.1)});
  drawing.labels.push_back({"x_k", after / 2 + Vector2d(-0.3, 0.4), "right"});
  draw(drawing, figure);
  return figure;
}

/// Number of dimensions of each origin: "published 4, inferred 7, …".
std::string origins_of_dimensions(const Study& study) {
  std::array<int, kOriginNames.size()> counts{};
  for (const geometry::NeckDimension& dimension : geometry::neck_dimensions())
    for (const Parameter& parameter : study.parameters)
      if (parameter.key == std::string("geometry.") + dimension.name)
        ++counts.at(static_cast<std::size_t>(parameter.origin));
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts.at(k) > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", kOriginNames.at(k), counts.at(k));
  return text;
}

Figure section(const Study& study) {
  const geometry::NeckParameters& neck = study.neck()->dimensions;
  Figure figure{2, "Hybrid III dummy neck",
                "Section in the plane of symmetry, front to the right; light: plates, dark: rubber "
                "sections. Its dimensions by origin: " +
                    origins_of_dimensions(study) + "."};
  Drawing drawing;
  drawing.unit = "in";
  drawing.height = 620;
  drawing.shapes = NeckOutline(neck).shapes(Matrix2d::Identity(), Vector2d::Zero());
  const double hole = inches(neck.hole_diameter / 2);
  const double top = inches(neck.length);
  drawing.shapes.push_back(box("hole", -hole, hole, 0, top, "#ffffff"));
  double right = 0;
  for (const geometry::NeckLayer& layer : geometry::layers_of(neck)) {
    right = std::max(right, inches(layer.offset_m + layer.diameter_m / 2));
  }
  for (const geometry::NeckLayer& layer : geometry::layers_of(neck)) {
    const double height = inches(layer.bottom_m + layer.thickness_m / 2);
    drawing.shapes.push_back(line(layer.part + " leader",
                                  {inches(layer.offset_m + layer.diameter_m / 2), height},
                                  {right + 0.25, height}, "lw 0.8 lc rgb '#888888'"));
    drawing.labels.push_back({fmt::format("{}: {:.3f} in, Ø {:.3f} in", layer.part,
                                          inches(layer.thickness_m), inches(layer.diameter_m)),
                              {right + 0.35, height}});
  }
  drawing.labels.push_back({"", {right + 3.6, top / 2}});  // room for the names
  drawing.arrows.push_back({{-right - 0.4, 0}, {-right - 0.4, top}, "lw 1 lc rgb '#222222'", true});
  drawing.labels.push_back({fmt::format("{:.2f} in", top), {-right - 0.5, top / 2}, "right"});
  drawing.labels.push_back({"", {-right - 1.7, top / 2}});
  draw(drawing, figure);
  return figure;
}

/// True if a static test is loaded as in figure 5.
bool pushes_forward_at_top(const Study& study, const std::string& name) {
  const auto test = std::find_if(study.cases.begin(), study.cases.end(), [&](const auto& each) {
    return each.name == name && each.kind == CaseSection::Kind::static_test;
  });
  if (test == study.cases.end()) return false;
  const multibody::Model& model = test->model.model;
  const auto& forces = model.forces.of<multibody::PointForce>();
  return std::all_of(forces.begin(), forces.end(), [&](const multibody::PointForce& force) {
    return model.markers[force.marker].name == "neck.top" && !force.follows &&
           force.direction.isApprox(Vector3d::UnitX());
  });
}

Figure static_tester(const Results& results, const Study& study) {
  Figure figure{5, "Static test neck model",
                "Clamped at the base, loaded at the occipital condyles; drawn at the end of the "
                "ramp, dashed without load. The load keeps its direction in space."};
  const Experiment* const run = results.find(Experiment::Kind::static_test, "flexion");
  if (run == nullptr || !results.modes || !pushes_forward_at_top(study, run->name)) {
    figure.missing = "the static test 'flexion', pushed forward at its top, and the modes";
    return figure;
  }
  const multibody::History& history = run->file.history;
  const auto bent = bent_neck(history, *results.modes, history.time_s.size() - 1);
  if (!bent) {
    figure.missing = "a static test 'flexion' with these modes";
    return figure;
  }
  const NeckOutline undeformed(study.neck()->dimensions);
  NeckOutline deformed = undeformed;
  deformed.deform(*results.modes, bent->modes, bent->coordinates);
  Drawing drawing;
  drawing.unit = "in";
  drawing.shapes.push_back(box("bench", -3.2, 3.2, -0.5, 0, "#f0f0f0"));
  append(drawing.shapes, deformed.shapes(Matrix2d::Identity(), Vector2d::Zero()));
  append(drawing.shapes,
         undeformed.lines(Matrix2d::Identity(), Vector2d::Zero(), " undeformed", kDashed));
  const Vector2d joint = inches_in_plane(joint_of(*results.modes, *bent));
  drawing.arrows.push_back({joint, joint + Vector2d(2.6, 0), kForce});
  drawing.labels.push_back({"F", joint + Vector2d(2.8, 0)});
  drawing.labels.push_back({"clamped", {0, -0.25}, "center"});
  add_frame(drawing, {-4.6, 0}, Matrix2d::Identity(), 1.2, "x", "z");
  draw(drawing, figure);
  return figure;
}

/// Index of the time at which the top of the neck, relative to its base, is farthest from its
/// initial position.
Eigen::Index farthest(const multibody::History& history) {
  const auto& top = history.marker("neck.top").position_m;
  const auto& base = history.marker("neck.base").position_m;
  const Eigen::Matrix3Xd chord = top - base;
  Eigen::Index time = 0;
  (chord.colwise() - chord.col(0)).colwise().norm().maxCoeff(&time);
  return time;
}

/// Drawing of the hanging pendulum, in which the neck's frame is upside down.
Drawing pendulum_drawing(const fe_modal::ModalBody& body,
                         const geometry::NeckParameters& dimensions, const BentNeck& bent,
                         const HeadShape& head) {
  Matrix2d hanging = Matrix2d::Identity();
  hanging(1, 1) = -1;
  NeckOutline neck(dimensions);
  neck.deform(body, bent.modes, bent.coordinates);
  const Vector2d joint = hanging * inches_in_plane(joint_of(body, bent));
  const double phi = tip_angle(body, bent);
  const double phi_neck = std::atan2(joint.x(), -joint.y());

  Drawing drawing;
  drawing.unit = "in";
  drawing.height = 640;
  drawing.shapes.push_back(box("arm", -1.2, 1.2, 0, 5, "#c5ccd3"));
  append(drawing.shapes, neck.lines(hanging, Vector2d::Zero(), "", kThin));
  const Eigen::Matrix3d tilt = Eigen::AngleAxisd(phi, Vector3d::UnitY()).toRotationMatrix();
  const Vector3d centre = tilt * head.centre_m;
  const Vector2d centre_in = joint + hanging * inches_in_plane(centre);
  drawing.shapes.push_back(
      {"head", (inches(1) * hanging * outline_along_y(head, tilt)).colwise() + centre_in, "",
       kThin});

  const Vector2d down(0, -1);
  const Vector2d axis(std::sin(phi), -std::cos(phi));
  drawing.shapes.push_back(line("axis of the arm", {0, 0}, 1.45 * joint.norm() * down, kDashed));
  drawing.shapes.push_back(line("chord of the neck", {0, 0}, joint, kVector));
  drawing.shapes.push_back(line("parallel to the arm", joint, joint + 5.2 * down, kDashed));
  drawing.arrows.push_back({joint, joint + 5.2 * axis, kForce});
  const double pi = std::numbers::pi;
  drawing.shapes.push_back({"phi'", arc({0, 0}, 4.2, pi, pi - phi_neck), "", kVector});
  drawing.shapes.push_back({"phi", arc(joint, 3.6, pi, pi - phi), "", "lw 2 lc rgb '#d55e00'"});
  drawing.labels.push_back(
      {"φ′", 4.75 * Vector2d(std::sin(phi_neck / 2), -std::cos(phi_neck / 2)), "center"});
  drawing.labels.push_back(
      {"φ", joint + 4.15 * Vector2d(std::sin(phi / 2), -std::cos(phi / 2)), "center"});
  drawing.labels.push_back({"pendulum arm", {1.5, 3.5}});
  drawing.labels.push_back({"j1", {-2.3, 0.1}, "right"});
  drawing.labels.push_back({"j2", joint + Vector2d(-1.9, -0.6), "right"});
  drawing.labels.push_back({"c.g.", centre_in + Vector2d(0.25, 0)});
  drawing.shapes.push_back(
      {"centre of gravity",
       (0.12 * Drawing::Points(arc({0, 0}, 1, 0, 2 * pi))).colwise() + centre_in, "#222222"});
  drawing.arrows.push_back({{-4.2, 3.5}, {-2.2, 3.5}, "lw 2 lc rgb '#222222'"});
  drawing.labels.push_back({"motion", {-4.2, 4.1}});
  return drawing;
}

Figure pendulum(const Results& results, const Study& study) {
  Figure figure{7, "Head/Neck Pendulum test model",
                "Neck rotation φ′: of the line from base to occipital condyles against the arm; "
                "head rotation φ: of the head against the arm."};
  const auto run = std::find_if(
      results.experiments.begin(), results.experiments.end(), [](const Experiment& each) {
        return each.kind == Experiment::Kind::pendulum && each.name.starts_with("flexion") &&
               each.name.find("60") != std::string::npos;
      });
  const auto head = head_shape(study);
  if (run == results.experiments.end() || !results.modes || !head) {
    figure.missing = "the pendulum's case flexion-60, the modes and a head";
    return figure;
  }
  const multibody::History& history = run->file.history;
  if (!bent_neck(history, *results.modes, 0)) {
    figure.missing = "a run of the pendulum with these modes in one body";
    return figure;
  }
  const Eigen::Index time = farthest(history);
  const auto bent = bent_neck(history, *results.modes, time);
  figure.remark += fmt::format(" Drawn: {} at {:.0f} ms.", run->name, 1e3 * history.time_s[time]);
  draw(pendulum_drawing(*results.modes, study.neck()->dimensions, *bent, *head), figure);
  return figure;
}

}  // namespace

std::vector<Figure> neck_drawings(const Results& results, const Study& study) {
  if (study.neck() == nullptr) return {};
  return {kinematics(results, study.neck()->dimensions), section(study),
          static_tester(results, study), pendulum(results, study)};
}

}  // namespace flexneck::pipeline
