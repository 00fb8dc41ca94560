// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <random>
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/temporary_folder.h"
#include "geometry/foundation/text_file.h"

using namespace flexneck;
using Catch::Matchers::Contains;
using namespace std::string_literals;

TEST_CASE("what a terminal would obey or an eye not see is spelt out, all else left as it is") {
  CHECK(printable("Ψ° φ′ 漢 𝜔 \\n") == "Ψ° φ′ 漢 𝜔 \\n");
  CHECK(printable("a\nb\t\r\x1b[31m\x7f"s) == "a\\nb\\t\\r\\x1b[31m\\x7f");
  CHECK(printable("a\0b"s) == "a\\x00b");
  CHECK(printable("line\nline", "\n") == "line\nline");
  // C1's CSI, a separator of lines, an override of the direction.
  CHECK(printable("\u009b1m") == "\\u009b1m");
  CHECK(printable("\u2028 \u202e") == "\\u2028 \\u202e");
  // Not UTF-8: Latin-1, overlong, a surrogate, beyond Unicode, cut short.
  CHECK(printable("\xe9t\xe9") == "\\xe9t\\xe9");
  CHECK(printable("\xc0\xaf") == "\\xc0\\xaf");
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");
  CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");
  CHECK(printable("\xe2\x82") == "\\xe2\\x82");
  CHECK(find_unprintable("ab\n") == 2);
  CHECK(find_unprintable("Ψ") == std::string::npos);
  CHECK_THROWS_WITH(check_names({"a\x1b"}, "part"), Contains("part 'a\\x1b'"));
}

TEST_CASE("only regular files are read, and nothing else is waited for") {
  const TemporaryFolder folder;
  const std::string text = "first\nsecond\n";
  std::ofstream(folder / "text") << text;
  std::filesystem::create_symlink("text", folder / "link");
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(read_text(folder / "text", 100) == text);
  CHECK(read_text(folder / "link", text.size()) == text);
  const auto told = [](const std::filesystem::path& path) {
    try {
      read_text(path, 12);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  CHECK_THAT(told(folder / "pipe"), Contains("pipe: expected a file, found a pipe"));
  CHECK_THAT(told("/dev/zero"), Contains("expected a file, found a device"));
  CHECK_THAT(told(folder.path()), Contains("expected a file, found a folder"));
  CHECK_THAT(told(folder / "none"), Contains("none: no such file"));
  CHECK_THAT(told(std::string(5000, 'x')), Contains("File name too long"));
  CHECK_THAT(told(folder / "text"), Contains("at most 0 KiB of text, found more"));
}

TEST_CASE("a text that is not one is refused with its line") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& bytes) {
    std::ofstream(folder / "text", std::ios::binary) << bytes;
    return read_text(folder / "text", 1000);
  };
  CHECK(read("\xEF\xBB\xBFname\r\n\tφ\n") == "name\r\n\tφ\n");
  CHECK_THROWS_WITH(read("a\nb\0c"s),
                    Contains("text:2: expected UTF-8") && Contains("found \\x00"));
  CHECK_THROWS_WITH(read("a\nb\n\xff"), Contains("text:3:") && Contains("found \\xff"));
  CHECK_THROWS_WITH(read("\x1b[2J"), Contains("text:1:") && Contains("found \\x1b"));
}

TEST_CASE("a text that is not UTF-8 is Windows-1252, of which ISO-8859-1 is a part") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& bytes) {
    std::ofstream(folder / "text", std::ios::binary) << bytes;
    return read_encoded_text(folder / "text", 100);
  };
  CHECK(read("plain\r\n") == "plain\r\n");
  CHECK(read("\xef\xbb\xbf\u00e9 \u20ac") == "\u00e9 \u20ac");
  CHECK(read("\xe9t\xe9 \xb0\xff") == "\u00e9t\u00e9 \u00b0\u00ff");
  CHECK(read("\x80 \x93\x94 \x9f") == "\u20ac \u201c\u201d \u0178");
  CHECK_THROWS_WITH(read("a\n\x81"), Contains("text:2: ") && Contains("\\x81"));
  CHECK_THROWS_WITH(read("\xe9\x1b[31m"), Contains("\\x1b"));
  CHECK_THROWS_WITH(read(std::string(101, 'a')), Contains("found more"));
}

TEST_CASE("rounded texts of numbers are those that C prints in its own locale") {
  const auto printed = [](const char* format, int digits, double number) {
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), format, digits, number);
    return std::string(text.data());
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-320, 307), digits(1, 17);
  std::vector<double> numbers = {0, -0.0, 1, 9.9999995, 1e5, 999999.5, 1e-5, 0.5, 1.5, 2.5};
  numbers.push_back(std::numeric_limits<double>::max());
  numbers.push_back(std::numeric_limits<double>::infinity());
  for (int k = 0; k < 2000; ++k)
    numbers.push_back(mantissa(random) * std::pow(10.0, k % 2 == 0 ? k % 9 - 4 : exponent(random)));
  for (const double number : numbers) {
    const int count = digits(random);
    CHECK(rounded_text(number, count) == printed("%.*g", count, number));
    CHECK(fixed_text(number, count) == printed("%.*f", count, number));
  }
}
