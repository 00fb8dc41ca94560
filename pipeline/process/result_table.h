// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"

namespace flexneck::pipeline {

/// A table of results as text: every cell is the text that is printed, so that the console, the
/// files and the report show the same figures.
struct ResultTable {
  struct Column {
    std::string name;
    std::string unit;  ///< such as "deg"; empty for texts and pure numbers
  };
  std::string name;   ///< name for programs, such as "peaks"
  std::string title;  ///< title for readers
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  ///< one cell per column
  std::vector<std::string> notes;              ///< origins, contradictions, warnings: sentences
};

/// Text with title, columns with their units, rows and notes. No line break at the end.
std::string printed(const ResultTable& table);

/// The tables of a file with their provenance, without the parameters.
struct TableFile {
  std::vector<ResultTable> tables;
  Provenance provenance;
};

/// Returns whether a file claims to hold tables of flexneck.
bool holds_tables(const std::filesystem::path& path);

/// Reads tables. @throws InputError if the file is missing, is not one of flexneck or has a row of
/// the wrong length.
TableFile read_tables(const std::filesystem::path& path);

/// Writes tables as JSON, under a temporary name that is renamed: "format" is "flexneck tables",
/// "tables" a list of objects with the members above.
/// @throws InputError if the file cannot be written; nothing is left then.
void write_tables(const std::filesystem::path& path, const std::vector<ResultTable>& tables,
                  const Provenance& provenance);

}  // namespace flexneck::pipeline
