// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "pipeline/experiments/verification/verification.h"

using namespace flexneck;
using namespace flexneck::pipeline;
using Status = VerificationRow::Status;

namespace {

fe_modal::ModalBody body_with(const std::vector<std::pair<std::string, double>>& modes) {
  fe_modal::ModalBody body;
  body.frequencies_Hz.resize(static_cast<Eigen::Index>(modes.size()));
  for (std::size_t k = 0; k < modes.size(); ++k) {
    fe_modal::ModeRecord record;
    record.name = modes[k].first;
    body.modes.push_back(record);
    body.frequencies_Hz[static_cast<Eigen::Index>(k)] = modes[k].second;
  }
  body.invariants.mass = 1;
  return body;
}

Reference example() {
  Reference reference;
  reference.tolerance_percent = 1;
  reference.bending_Hz = {10, 11};
  reference.torsion_Hz = {20};
  reference.mode_order = {"bending", "bending", "torsion"};
  reference.weight_kg = 1;
  return reference;
}

const VerificationRow& row(const VerificationTable& table, const std::string& quantity) {
  for (const VerificationRow& each : table.rows) {
    if (each.quantity == quantity) return each;
  }
  throw std::runtime_error("no row " + quantity);
}

}  // namespace

TEST_CASE("frequencies are paired by kind and rank, whatever lies between them") {
  const VerificationTable table = verify(Study(),
                                         body_with({{"lateral bending 1", 10.05},
                                                    {"axial 1", 10.5},
                                                    {"fore-aft bending 1", 11.05},
                                                    {"torsion 1", 20.15}}),
                                         {}, example());
  CHECK(table.passed());
  CHECK(row(table, "bending 1").detail == "lateral bending 1");
  CHECK(row(table, "bending 2").detail == "fore-aft bending 1");
  CHECK(*row(table, "bending 1").error_percent == Approx(0.5));
  CHECK(*row(table, "torsion 1").error_percent == Approx(0.75));
  CHECK(row(table, "mode order").detail == "bending, torsion, axial: differs");
}

TEST_CASE("a frequency beyond the tolerance, or missing, fails the verification") {
  const VerificationTable off = verify(
      Study(),
      body_with({{"lateral bending 1", 10.0}, {"fore-aft bending 1", 11.12}, {"torsion 1", 20.0}}),
      {}, example());
  CHECK_FALSE(off.passed());
  CHECK(row(off, "bending 1").status == Status::passed);
  CHECK(row(off, "bending 2").status == Status::failed);
  CHECK(row(off, "mode order").detail == "bending, torsion, axial: the same");

  const VerificationTable low = verify(
      Study(),
      body_with({{"lateral bending 1", 9.88}, {"fore-aft bending 1", 11}, {"torsion 1", 19.9}}), {},
      example());
  CHECK_FALSE(low.passed());
  CHECK(row(low, "bending 1").status == Status::failed);
  CHECK(*row(low, "bending 1").error_percent == Approx(-1.2));
  CHECK(row(low, "torsion 1").status == Status::passed);
  const VerificationTable low_torsion = verify(
      Study(),
      body_with({{"lateral bending 1", 10}, {"fore-aft bending 1", 11}, {"torsion 1", 19.7}}), {},
      example());
  CHECK(row(low_torsion, "torsion 1").status == Status::failed);

  const VerificationTable missing = verify(
      Study(), body_with({{"lateral bending 1", 10}, {"fore-aft bending 1", 11}}), {}, example());
  CHECK(row(missing, "torsion 1").status == Status::failed);
}

TEST_CASE("a neck that was fitted to other figures is shown beside published ones") {
  const fe_modal::ModalBody body =
      body_with({{"lateral bending 1", 15}, {"fore-aft bending 1", 16}});
  Study study;
  NeckSection& neck = study.structure.emplace().neck.emplace();
  neck.fitted_values = "the hash of a fit";
  const auto is_judged = [&](const std::vector<std::string>& fitted_to) {
    neck.fitted_to = fitted_to;
    const VerificationTable table = verify(study, body, {}, example());
    CHECK(why_unjudged(study, table).empty() != table.passed());
    return !table.passed();
  };
  CHECK_FALSE(is_judged({}));
  CHECK_FALSE(is_judged({"weight", "system frequency"}));
  CHECK_FALSE(is_judged({"static stiffness of the top"}));
  CHECK_FALSE(is_judged({"bending 4"}));  // these references do not have it
  CHECK(is_judged({"weight", "bending 1"}));
}

TEST_CASE("a geometry of the user's own is shown beside published figures, not judged by them") {
  const fe_modal::ModalBody body =
      body_with({{"lateral bending 1", 15}, {"fore-aft bending 1", 16}});
  const auto verified = [&](const std::string& key, const std::string& value, Origin origin,
                            const std::string& reference_origins) {
    Study study;
    study.parameters = {{key, value, origin, ""}};
    Reference reference = example();
    reference.origins = reference_origins;
    return verify(study, body, {}, reference);
  };
  const auto is_judged = [&](const auto&... arguments) {
    const VerificationTable table = verified(arguments...);
    for (const char* const each : {"bending 1", "bending 2", "torsion 1"}) {
      const Status expected = table.passed() ? Status::unjudged : Status::failed;
      CHECK(row(table, each).status == expected);
    }
    return !table.passed();
  };
  const std::string plate = "geometry.plate_thickness";
  CHECK(is_judged(plate, "0.3 in", Origin::published, "published"));
  CHECK(is_judged(plate, "0.3 in", Origin::calibrated, "published"));
  CHECK_FALSE(is_judged(plate, "0.3 in", Origin::synthetic, "published"));
  CHECK_FALSE(is_judged("geometry.materials.butyl.density", "1 kg/m^3", Origin::synthetic,
                        "published, inferred"));
  CHECK_FALSE(is_judged("geometry.slits", "\"open\"", Origin::synthetic, "published"));
  CHECK(is_judged("geometry.slits", "\"closed\"", Origin::synthetic, "published"));
  CHECK(is_judged("mesh.refine", "1", Origin::synthetic, "published"));
  // With the user's own figures it is judged.
  CHECK(is_judged(plate, "0.3 in", Origin::synthetic, "synthetic"));
  CHECK(
      *row(verified(plate, "0.3 in", Origin::synthetic, "published"), "bending 1").error_percent ==
      Approx(50));
}

TEST_CASE("fitted is said beside what the geometry was fitted to, and only there") {
  Study study;
  study.structure.emplace().neck.emplace().fitted_to = {"frequencies"};
  const VerificationTable table = verify(
      study, body_with({{"lateral bending 1", 10}, {"fore-aft bending 1", 11}, {"torsion 1", 20}}),
      {}, example());
  CHECK(row(table, "bending 1").fitted);
  CHECK(row(table, "torsion 1").fitted);
  CHECK_FALSE(row(table, "weight").fitted);
  CHECK_FALSE(row(table, "mode order").fitted);
  // Names as flexneck fit writes them: one by its rank, one by its mode.
  study.structure->neck->fitted_to = {"bending 2", "torsion 1", "weight"};
  const VerificationTable some = verify(
      study, body_with({{"lateral bending 1", 10}, {"fore-aft bending 1", 11}, {"torsion 1", 20}}),
      {}, example());
  CHECK_FALSE(row(some, "bending 1").fitted);
  CHECK(row(some, "bending 2").fitted);
  CHECK(row(some, "torsion 1").fitted);
  CHECK(row(some, "weight").fitted);
  study.structure->neck->fitted_to = {"lateral bending 1"};
  const VerificationTable one = verify(
      study, body_with({{"lateral bending 1", 10}, {"fore-aft bending 1", 11}, {"torsion 1", 20}}),
      {}, example());
  CHECK(row(one, "bending 1").fitted);
  CHECK_FALSE(row(one, "bending 2").fitted);
}
