// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/document/study_document.h"

using Catch::Matchers::Contains;
using flexneck::Origin;
using flexneck::TemporaryFolder;
using namespace flexneck::pipeline;

namespace {

constexpr Key kPartKeys[] = {
    Key::quantity("width", "m", "0.25", "A length"),
    Key::quantity("height", "m", kRequired, "A length"),
    Key::quantities("position", "m", kRequired, "A point", {.size = 3}),
    Key::number("ratio", kRequired, "A number", {.range = {.low = 0, .high = 1}}),
    Key::number("w", kRequired, "A number"),
    Key::count("count", kRequired, "A whole number", {.range = at_least(1)}),
    Key::flag("hollow", "false", "A flag"),
    Key::text("colour", kNone, "A text"),
    Key::texts("holes", kNone, "Texts"),
    Key::quantity("stiffness", "N/m | N*m/rad", "0", "Of two kinds"),
    Key::quantity("plate_diameter", "m", kNone, "A length"),
};

constexpr Key kCaseKeys[] = {
    Key::text("name", kRequired, "A name"),
    Key::count("count", kRequired, "A whole number", {.range = at_least(0)}),
    Key::number("ratio", kRequired, "A number"),
    Key::texts("holes", kNone, "Texts"),
};

constexpr Key kFreshKeys[] = {Key::number("*", kRequired, "Any name")};

constexpr Key kKeys[] = {
    Key::table("part", "A table", kPartKeys),   Key::tables("case", "Tables", kCaseKeys),
    Key::table("fresh", "A table", kFreshKeys), Key::text("x", kRequired, "A text"),
    Key::number("w", kRequired, "A number"),
};

StudyDocument document_of(const TemporaryFolder& folder, const std::string& text,
                          const std::vector<std::string>& settings = {}) {
  std::ofstream(folder / "study.toml") << text;
  return {folder / "study.toml", settings, kKeys};
}

}  // namespace

TEST_CASE("values come with unit, origin and note, plainly or in a table") {
  const TemporaryFolder folder;
  const StudyDocument document = document_of(folder, R"(
[part]
width = "2 in"
height = { value = "3 in", origin = "published", note = "a source" }
position = { value = ["0 m", "1 mm", "-1 in"], origin = "inferred" }
ratio = 0.49
count = 7
)");
  const StudyTable part = document.root().table("part");
  CHECK(part.quantity("width") == Approx(0.0508));
  CHECK(part.quantity("height") == Approx(0.0762));
  const std::vector<double> position = part.quantities("position");
  CHECK(position[0] == 0);
  CHECK(position[1] == Approx(0.001));
  CHECK(position[2] == Approx(-0.0254));
  CHECK(part.number("ratio") == 0.49);
  CHECK(part.count("count") == 7);
  part.finish();
  const auto& parameters = document.parameters();
  REQUIRE(parameters.size() == 5);
  CHECK(parameters[0].origin == Origin::synthetic);
  CHECK(parameters[1].key == "part.height");
  CHECK(parameters[1].value == "3 in");
  CHECK(parameters[1].origin == Origin::published);
  CHECK(parameters[1].note == "a source");
}

TEST_CASE("what holds for keys that are not given is told beside the values") {
  const TemporaryFolder folder;
  const StudyDocument document = document_of(folder, "[part]\nratio = 0.49\n");
  const StudyTable part = document.root().table("part");
  CHECK(part.number("ratio") == 0.49);
  CHECK(part.quantity("width") == 0.25);
  CHECK_FALSE(part.flag("hollow"));
  CHECK(part.text("colour").empty());
  CHECK(part.texts("holes").empty());
  CHECK(part.quantity("stiffness", "N*m/rad") == 0);
  REQUIRE(document.parameters().size() == 1);
  std::string told;
  for (const auto& each : document.defaults()) told += each.key + " = " + each.value + "\n";
  CHECK(told ==
        "part.width = 0.25 m\npart.hollow = false\npart.colour = -\npart.holes = -\n"
        "part.stiffness = 0 N*m/rad\n");
}

TEST_CASE("a file changes tables with names of the files it includes, key by key") {
  const TemporaryFolder folder;
  std::ofstream(folder / "base.toml") << "[[case]]\nname = \"a\"\ncount = 1\nratio = 0.5\n"
                                         "[[case]]\nname = \"b\"\ncount = 2\nholes = [\"x\"]\n";
  const auto told = [&](const std::string& text) {
    const StudyDocument document = document_of(folder, "include = [\"base.toml\"]\n" + text);
    for (const StudyTable& table : document.root().tables("case")) {
      for (const std::string& key : table.keys())
        if (key == "count")
          table.count(key);
        else if (key == "ratio")
          table.number(key);
        else if (key == "holes")
          table.texts(key);
    }
    std::string all;
    for (const auto& each : document.parameters()) all += each.key + " = " + each.value + "\n";
    return all;
  };
  CHECK(told("[[case]]\nname = \"b\"\ncount = 3\n[[case]]\nname = \"c\"\ncount = 4\n") ==
        "case.a.count = 1\ncase.a.ratio = 0.5\ncase.b.count = 3\ncase.b.holes = x\n"
        "case.c.count = 4\n");
  CHECK(told("[[case]]\nname = \"b\"\nholes = []\n") ==
        "case.a.count = 1\ncase.a.ratio = 0.5\ncase.b.count = 2\n");
  CHECK(told("case = []\n").empty());
}

TEST_CASE("values of tables of the same name, such as markers of two bodies, are all remembered") {
  const TemporaryFolder folder;
  const StudyDocument document = document_of(folder,
                                             "[[case]]\nname = \"a\"\ncount = 1\n"
                                             "[[case]]\nname = \"a\"\ncount = 2\n");
  int sum = 0;
  for (const StudyTable& table : document.root().tables("case")) sum += table.count("count");
  CHECK(sum == 3);
  std::string told;
  for (const auto& each : document.parameters()) told += each.key + " = " + each.value + "\n";
  CHECK(told == "case.a.count = 1\ncase.a#2.count = 2\n");
}

TEST_CASE("what a study gets wrong is told with file, line, column, key and remedy") {
  const TemporaryFolder folder;
  const auto table = [&](const std::string& line) {
    return document_of(folder, "[part]\n" + line + "\n").root().table("part");
  };
  CHECK_THROWS_WITH(table("width = 2").quantity("width"),
                    Contains("study.toml:2:9: part.width: expected a number with its unit"));
  CHECK_THROWS_WITH(table("width = \"2 s\"").quantity("width"), Contains("another dimension"));
  CHECK_THROWS_WITH(table("width = \"2 inn\"").quantity("width"), Contains("unknown unit"));
  CHECK_THROWS_WITH(table("ratio = \"0.4 in\"").number("ratio"), Contains("pure number"));
  CHECK_THROWS_WITH(table("ratio = 1.5").number("ratio"),
                    Contains("part.ratio: expected a value from 0 to 1, found 1.5"));
  CHECK_THROWS_WITH(table("ratio = nan").number("ratio"), Contains("finite"));
  CHECK_THROWS_WITH(table("count = 0").count("count"), Contains("at least 1, found 0"));
  CHECK_THROWS_WITH(table("count = 1.5").count("count"), Contains("whole number"));
  CHECK_THROWS_WITH(table("").number("ratio"),
                    Contains("part.ratio: expected this key, found none (A number)"));
  CHECK_THROWS_WITH(table("position = [\"1 m\"]").quantities("position"), Contains("list of 3"));
  CHECK_THROWS_WITH(table("w = { value = 1, origin = \"guessed\" }").number("w"),
                    Contains("part.w: expected the origin published, inferred"));
  CHECK_THROWS_WITH(table("w = { value = 1, orign = \"inferred\" }").number("w"),
                    Contains("unknown key 'orign' (did you mean 'origin'?)"));

  const StudyTable misspelt = table("plate_diametre = \"3 in\"");
  CHECK_FALSE(misspelt.has("plate_diameter"));
  CHECK_THROWS_WITH(misspelt.finish(),
                    Contains("part.plate_diametre: unknown key (did you mean 'plate_diameter'?)"));
  CHECK_THROWS_WITH(document_of(folder, "[part\nwidth = 1"), Contains("study.toml:1:"));
  CHECK_THROWS_WITH(StudyDocument(folder / "none.toml", {}, kKeys),
                    Contains("none.toml: no such file"));
}

TEST_CASE("a reader takes no key and no type but those of the table of keys") {
  const TemporaryFolder folder;
  const StudyTable part = document_of(folder, "[part]\nlength = \"1 m\"\n").root().table("part");
  CHECK_THROWS_AS(part.has("length"), std::logic_error);
  CHECK_THROWS_AS(part.quantity("length"), std::logic_error);
  CHECK_THROWS_AS(part.number("width"), std::logic_error);
  CHECK_THROWS_AS(part.quantity("stiffness"), std::logic_error);
  CHECK_THROWS_AS(part.quantity("stiffness", "N"), std::logic_error);
  CHECK_THROWS_AS(part.table("hollow"), std::logic_error);
}

TEST_CASE("an including file wins over what it includes, key by key") {
  const TemporaryFolder folder;
  std::ofstream(folder / "base.toml") << "[part]\nwidth = \"1 m\"\nheight = \"2 m\"\n";
  const StudyDocument document =
      document_of(folder, "include = [\"base.toml\"]\n[part]\nheight = \"3 m\"\n");
  const StudyTable part = document.root().table("part");
  CHECK(part.quantity("width") == 1);
  CHECK(part.quantity("height") == 3);
  REQUIRE(document.files().size() == 2);
  CHECK(document.files()[0].name == "base.toml");
  CHECK_THROWS_WITH(document_of(folder, "include = [\"study.toml\"]"), Contains("includes itself"));
}

TEST_CASE("a value set on the command line replaces one, and loses its origin") {
  const TemporaryFolder folder;
  const std::string text = R"(
[part]
width = { value = "1 m", origin = "published" }
[[case]]
name = "first"
count = 1
[[case]]
name = "second"
count = 2
)";
  const StudyDocument document =
      document_of(folder, text, {"part.width=4 in", "case.second.count=5", "fresh.key=1.5"});
  const StudyTable root = document.root();
  CHECK(root.table("part").quantity("width") == Approx(0.1016));
  CHECK(document.parameters().back().origin == Origin::synthetic);
  CHECK(root.tables("case").at(0).count("count") == 1);
  CHECK(root.tables("case").at(1).count("count") == 5);
  CHECK(root.table("fresh").number("key") == 1.5);
  CHECK_THROWS_WITH(document_of(folder, text, {"part.width"}), Contains("expected key=value"));
  CHECK_THROWS_WITH(document_of(folder, text, {"case.third.count=1"}),
                    Contains("there is no case named 'third'"));
  CHECK_THROWS_WITH(
      document_of(folder, text, {"part.width=4"}).root().table("part").quantity("width"),
      Contains("command line: part.width: expected a number with its unit"));
}

TEST_CASE("what nests or includes without end is refused before it takes the stack or the hours") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& why) {
    INFO(text.substr(0, 40));
    CHECK_THROWS_WITH(document_of(folder, text), Contains(why));
  };
  const auto repeated = [](const std::string& part, int times) {
    std::string text;
    for (int k = 0; k < times; ++k) text += part;
    return text;
  };
  constexpr int kMany = 50'000;
  const std::string too_deep = "study.toml:2: expected at most 32 nested brackets";
  refused("\n" + repeated("a.", kMany) + "a = 1", too_deep);
  refused("\n" + repeated("\"a b\" . ", kMany) + "a = 1", too_deep);
  refused("\n[" + repeated("a.", kMany) + "a]", too_deep);
  refused("\nx = " + repeated("{ a = ", kMany), too_deep);
  refused("\nx = " + repeated("[", kMany), too_deep);
  // The fourth quote belongs to the text; the rest is not quoted.
  for (const std::string text : {R"("""x"""")", R"(""""""")", "'''x''''"})
    refused("\nx = { b = " + text + ", " + repeated("a.", kMany) + "a = 1 }", too_deep);
  CHECK_THROWS_WITH(document_of(folder, "", {repeated("a.", kMany) + "a=1"}),
                    Contains("a key with at most 32 parts"));
  CHECK_THROWS_WITH(document_of(folder, "", {"a=" + repeated("[", kMany)}), Contains("at most 32"));
  // Dots and brackets in texts and comments do not count as nesting.
  CHECK(document_of(folder, "x = \"" + repeated("a.[", 100) + "\"\n# " + repeated("b.[", 100))
            .root()
            .text("x")
            .size() == 300);

  // Each file includes the next twice.
  for (int k = 0; k < 30; ++k) {
    const std::string next = "\"" + std::to_string(k + 1) + ".toml\"";
    std::ofstream(folder / (std::to_string(k) + ".toml"))
        << "include = [" + next + "," + next + "]\n";
  }
  refused("include = [\"0.toml\"]", "expected at most 100 included files, nested at most 16 deep");
  refused("include = [\"14.toml\", \"20.toml\"]", "expected at most 100 included files");
}

TEST_CASE(
    "pipes, folders and files that are no text are refused in one line, wherever they are named") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  const auto refused = [&](const std::string& text, const std::string& why) {
    INFO(text);
    CHECK_THROWS_WITH(document_of(folder, text), Contains(why) && !Contains("\n"));
  };
  CHECK_THROWS_WITH(StudyDocument(folder / "pipe", {}, kKeys),
                    Contains("pipe: expected a file, found a pipe"));
  refused("include = [\"pipe\"]", "pipe: expected a file, found a pipe");
  refused("include = [\"/dev/zero\"]", "zero: expected a file, found a device");
  refused("include = [\".\"]", "expected a file, found a folder");
  refused("include = [\"" + std::string(5000, 'x') + "\"]", "File name too long");
  refused(std::string("x = \"a\0b\"", 9), "study.toml:1:");
  refused("x = \"\xff\"", "study.toml:1:");
  // Escapes produce control characters from valid text.
  refused("\n[part]\nwhat = \"x\\nsystem('touch y')\"",
          "study.toml:3:8: what: expected a text without control characters, found \"x\\n");
  refused("names = [\"a\", \"\\u001b[2J\"]", "found \"\\x1b[2J\"");
  refused("w = { value = 1, note = \"\\u202e\" }", "\\u202e");
  refused("\"a\\tb\" = 1", "found \"a\\tb\"");
  CHECK_THROWS_WITH(document_of(folder, "", {"part.name=\"a\\u0007\""}), Contains("\\x07"));
  CHECK_THROWS_WITH(document_of(folder, "", {"part.name=a\nb"}),
                    Contains("without control characters"));
  CHECK_THROWS_WITH(document_of(folder, "w = { value = 1, note = 2 }").root().number("w"),
                    Contains("w: expected a note as a text"));
}
