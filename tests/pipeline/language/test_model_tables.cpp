// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/language/model/csv_table.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/model_reading.h"
#include "tests/support/model_text.h"

using Catch::Matchers::Contains;
using namespace flexneck;
using namespace flexneck::pipeline;
using testing::write_test_file;

TEST_CASE("a CSV file that is not sound is told with its line") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& text) {
    try {
      read_csv_columns(write_test_file(folder / "t.csv", text), "s", "N", "");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  CHECK(told("time [s], load [N]\n0, 0\n1, 2\n") == "nothing was refused");
  CHECK_THAT(told("time [s], load [N]\n0, 0\n1, 2\n1, 3\n"),
             Contains("t.csv:4: the column 'time' must increase strictly"));
  CHECK_THAT(told("time [s], load [m]\n0, 0\n"),
             Contains("t.csv:1: column \"load [m]\"") && Contains("has another dimension"));
  CHECK_THAT(told("time [s], load\n0, 0\n"), Contains("a column's name and unit"));
  CHECK_THAT(told("time [s], load [N]\n0, x\n"), Contains("t.csv:2: expected a finite number"));
  CHECK_THAT(told("time [s], load [N]\n0, nan\n"), Contains("finite number, found \"nan\""));
  CHECK_THAT(told("time [s], load [N]\n0\n"),
             Contains("t.csv:2: expected 2 cells") && Contains("found 1"));
  CHECK_THAT(told("time [s], a [N], b [N]\n0, 1, 2\n"),
             Contains("choose one of 'a', 'b' with the key 'column'"));
  CHECK_THAT(told("time [s], load [N]\n"), Contains("expected rows"));
  CHECK_THROWS_WITH(read_csv_columns(folder / "none.csv", "s", "N", ""), Contains("none.csv"));
}

TEST_CASE("surplus cells, decimal commas and other separators of a CSV file are refused") {
  const TemporaryFolder folder;
  const auto columns = [&](const std::string& text, const std::string& column = "") {
    return read_csv_columns(write_test_file(folder / "t.csv", text), "s", "N", column);
  };
  const std::string names = "time [s], load [N]\n";
  const auto refused = [&](const std::string& text, const std::string& why) {
    INFO(text);
    CHECK_THROWS_WITH(columns(text), Contains(why));
  };
  refused(names + "0, 1\n10, 24,15\n",
          "t.csv:3: expected 2 cells as in the header line, found 3; cells are separated by "
          "commas, and decimals have a point");
  refused(names + "0, 1,\n", "t.csv:2: expected 2 cells");
  refused(names + "0 1\n", "decimals have a point");
  refused("time [s]; load [N]\n0; 1\n", "cells are separated by commas");
  refused("time [s]\tload [N]\n0\t1\n", "cells are separated by commas");
  refused(names + "0, 1;5\n", "decimals have a point");
  refused(names + "0, 1\r1, 2\r", "lines that end in LF or CRLF");
  refused(names + "0, 0x10\n", "expected a finite number");
  refused(names + "0, 1e999\n", "expected a finite number");
  refused("time [s], load [Mt km/s^2]\n0, 1e302\n", "expected a finite number");
  refused(names + std::string("0, 1\0\n", 6), "found \\x00");
  refused("time [2 s], load [N]\n0, 1\n", "a unit contains no number");
  CHECK_THROWS_WITH(columns("time [s], a [N], a [N]\n0, 1, 2\n", "a"),
                    Contains("several columns 'a'"));
  const TableColumns same =
      columns("\xEF\xBB\xBF" + ("# mine\r\n\r\n" + names) + "0, 1\r\n \n1,\t2");
  CHECK(same.x == std::vector<double>{0, 1});
  CHECK(same.y == std::vector<double>{1, 2});
}
