// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/laboratory/verdict/certification_test.h"
#include "pipeline/language/document/key.h"

namespace flexneck::pipeline {

/// Table of keys of a file with the tests of a regulation.
std::span<const Key> regulation_keys();

/// Reads the tests of a file; their names begin with the regulation's.
/// @throws InputError with file, line, column and key for any error.
std::vector<CertificationTest> read_regulation(const std::filesystem::path& path);

/// A test and the file that contains it.
struct ShippedTest {
  CertificationTest test;
  std::filesystem::path file;
};

/// The test with a given name among the shipped regulations.
/// @throws InputError with the known names.
ShippedTest shipped_test(const std::string& name);

}  // namespace flexneck::pipeline
