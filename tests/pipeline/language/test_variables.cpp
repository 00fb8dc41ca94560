// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/document/study_document.h"

using Catch::Matchers::Contains;
using flexneck::TemporaryFolder;
using namespace flexneck::pipeline;

namespace {

constexpr Key kPartKeys[] = {
    Key::quantity("mass", "kg", kRequired, "A mass"),
    Key::quantity("half", "kg", kRequired, "A mass"),
    Key::quantities("point", "m", kRequired, "A point", {.size = 3}),
    Key::numbers("axis", kRequired, "An axis", {.size = 3}),
    Key::quantity("area", "m^2", kRequired, "An area"),
    Key::count("count", kRequired, "A whole number"),
    Key::text("file", kRequired, "A text"),
    Key::text("price", kRequired, "A text"),
    Key::quantities("both", "m", kRequired, "Lengths"),
    Key::quantities("mixed", "m", kRequired, "Lengths"),
    Key::quantity("*", "m", kRequired, "A length"),
};

constexpr Key kKeys[] = {
    Key::table("part", "A table", kPartKeys),
    Key::text("variables", kNone, "Nothing that is left of a document"),
};

StudyDocument document_of(const TemporaryFolder& folder, const std::string& text,
                          const std::vector<std::string>& settings = {}) {
  std::ofstream(folder / "study.toml") << text;
  return {folder / "study.toml", settings, kKeys};
}

/// Text "value, origin, note" of a parameter; "none" if there is none.
std::string parameter(const StudyDocument& document, const std::string& key) {
  for (const flexneck::Parameter& each : document.parameters())
    if (each.key == key)
      return each.value + ", " + std::string(name_of(each.origin)) + ", " + each.note;
  return "none";
}

}  // namespace

TEST_CASE("a product of numbers and variables stands for its value, with a unit at most") {
  const TemporaryFolder folder;
  const StudyDocument document = document_of(folder, R"(
[part]
mass = "2*$mass"
half = " -0.5 * $mass "
point = ["$x", "-$x", "$side*3.15 in"]
axis = [0, "$side", "-$side"]
area = "$ratio m^2"
count = "$count"
table = [[1, "$ratio"], [2, "$side"]]
file = "a$b.h5"
price = "$5"
[variables]
mass = "13.713 lb"
x = "2*$y"
y = "-1.5 in"
side = -1
ratio = 0.25
count = 4
)");
  const StudyTable part = document.root().table("part");
  constexpr double kInch = 0.0254;
  CHECK(part.quantity("mass") == Approx(27.426 * 0.45359237).epsilon(1e-15));
  CHECK(part.quantity("half") == Approx(-6.8565 * 0.45359237).epsilon(1e-15));
  const std::vector<double> point = part.quantities("point");
  CHECK(point[0] == Approx(-3 * kInch));
  CHECK(point[1] == Approx(3 * kInch));
  CHECK(point[2] == Approx(-3.15 * kInch));
  CHECK(part.numbers("axis") == std::vector<double>{0, -1, 1});
  CHECK(part.quantity("area") == 0.25);
  CHECK(part.count("count") == 4);
  CHECK(part.text("file") == "a$b.h5");
  CHECK(part.text("price") == "$5");
  CHECK_FALSE(document.root().has("variables"));
}

TEST_CASE("a value made of variables has the weakest of their origins where it has none itself") {
  const TemporaryFolder folder;
  const StudyDocument document = document_of(folder, R"(
[part]
plain = "$told"
own = { value = "$told", origin = "calibrated", note = "fitted" }
noted = { value = "2*$told", note = "twice" }
both = ["$told", "-$guessed", "0 m"]
mixed = ["$told", "1 m"]
mirrored = "$side*$told"
literal = "$side*3 m"
made = "$made"
unlabelled = "$unlabelled"
[variables]
told = { value = "1 m", origin = "published", note = "a book" }
guessed = { value = "2 m", origin = "inferred", note = "by eye" }
made = "$side*$guessed"
unlabelled = "3 m"
side = -1
)");
  const StudyTable part = document.root().table("part");
  for (const std::string& key : part.keys())
    part.is_list(key) ? part.quantities(key).front() : part.quantity(key);
  CHECK(parameter(document, "part.plain") == "1 m, published, a book");
  CHECK(parameter(document, "part.own") == "1 m, calibrated, fitted");
  CHECK(parameter(document, "part.noted") == "2 m, published, twice");
  CHECK(parameter(document, "part.both") == "1 m, -2 m, 0 m, inferred, by eye");
  CHECK(parameter(document, "part.mixed") == "1 m, 1 m, synthetic, ");
  CHECK(parameter(document, "part.mirrored") == "-1 m, published, a book");
  CHECK(parameter(document, "part.literal") == "-3 m, synthetic, ");
  CHECK(parameter(document, "part.made") == "-2 m, inferred, by eye");
  CHECK(parameter(document, "part.unlabelled") == "3 m, synthetic, ");
  // The variables themselves are parameters, too.
  CHECK(parameter(document, "variables.told") == "1 m, published, a book");
  CHECK(parameter(document, "variables.made") == "-2 m, inferred, by eye");
  CHECK(parameter(document, "variables.side") == "-1, synthetic, ");
}

TEST_CASE(
    "variables are overridden by including files and by the command line, which may use them") {
  const TemporaryFolder folder;
  std::ofstream(folder / "base.toml")
      << "[part]\nwidth = \"$width\"\nheight = \"2*$width\"\n[variables]\nwidth = \"1 m\"\n";
  const std::string text = "include = [\"base.toml\"]\n[variables]\nwidth = \"3 m\"\n";
  const auto part = [&](const std::vector<std::string>& settings, const std::string& key) {
    return document_of(folder, text, settings).root().table("part").quantity(key);
  };
  CHECK(part({}, "height") == 6);
  CHECK(part({"variables.width=5 m"}, "height") == 10);
  CHECK(part({"part.height=-$width"}, "height") == -3);
  CHECK(part({"part.height=1 m"}, "height") == 1);
  const StudyDocument told = document_of(folder, text, {"variables.width=5 m"});
  CHECK(parameter(told, "variables.width") == "5 m, synthetic, ");
}

TEST_CASE("variables that are undefined, unused, cyclic or no numbers are refused in one line") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& why,
                           const std::vector<std::string>& settings = {}) {
    INFO(text);
    CHECK_THROWS_WITH(document_of(folder, text, settings),
                      Contains("study.toml:" + why) && !Contains("\n"));
  };
  const std::string used = "w = \"$x\"\n[variables]\n";
  refused("w = \"$y\"\n[variables]\nx = 1",
          "1:5: w: expected a variable of [variables], found '$y' (did you mean 'x'?)");
  refused("[[body]]\nname = \"a\"\nat = [\n1, \"2*$y\"]", "4:4: body.a.at: expected a variable");
  refused("w = 1\n[variables]\nx = 1",
          "3:5: variables.x: expected a value that uses \"$x\", found none; remove the variable");
  refused(used + "x = \"$z\"\ny = \"-$x\"\nz = \"2*$y\"",
          "3:5: variables.x: expected a value, found one that depends on itself: x -> z -> y -> x");
  refused(used + "x = \"$x\"",
          "3:5: variables.x: expected a value, found one that depends on itself: x -> x");
  refused(used + "x = true", "3:5: variables.x: expected a number, or a number with its unit");
  refused(used + "x = [1]", "3:5: variables.x: expected a number");
  refused(used + "x = inf", "3:5: variables.x: expected a finite number");
  refused(used + "x = \"wide\"", "3:5: variables.x: expected a product of numbers and variables");
  refused(used + "x = { value = 1, origin = \"guessed\" }",
          "3:27: variables.x: expected the origin");
  refused(used + "x = { of = 1 }", "3:5: variables.x: expected a value or { value");
  refused(used + "\"x y\" = 1", "3:9: variables.x y: expected a name of letters, digits and '_'");
  refused("w = \"$value\"\n[variables]\nvalue = 1",
          "3:9: variables.value: expected a name other than");
  refused("variables = 1", "1:13: variables: expected a table [variables]");
  for (const std::string text : {"2*$", "$x*m", "$x*$", "2 m*$x", "$x $x", "--$x", "1e999*$x"})
    refused("w = \"" + text + " $x\"\n[variables]\nx = 1",
            "1:5: w: expected a product of numbers and variables with at most one unit");
  refused("w = \"$x*$x\"\n[variables]\nx = \"1 m\"",
          "1:5: w: expected one unit at most, found 'm'");
  refused("w = \"$x*$x\"\n[variables]\nx = 1e200", "1:5: w: expected a finite product");
  std::string chain = "w = \"$a0\"\n[variables]\na60 = 1\n";
  for (int k = 0; k < 60; ++k)
    chain += "a" + std::to_string(k) + " = \"$a" + std::to_string(k + 1) + "\"\n";
  refused(chain, "36:7: variables.a32: expected at most 32 variables");
  CHECK_THROWS_WITH(document_of(folder, used + "x = 1", {"variables.x=\"$q\""}),
                    Contains("command line: variables.x: expected a variable"));
}

TEST_CASE("a value made of variables is refused at its own line and column") {
  const TemporaryFolder folder;
  const StudyDocument document = document_of(folder, R"([part]
mass =   "$length"
[variables]
length = { value = "2 m", origin = "published" }
)");
  CHECK_THROWS_WITH(document.root().table("part").quantity("mass"),
                    Contains("study.toml:2:10: part.mass: expected a unit such as 'kg'"));
}
