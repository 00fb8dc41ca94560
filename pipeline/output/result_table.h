// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"

namespace flexneck::pipeline {

/// A table of results as people read it: every cell is the text that is printed, so that the
/// console, the files and the report show the same figures.
struct ResultTable {
  struct Column {
    std::string name;
    std::string unit;  ///< such as "deg"; empty for texts and pure numbers
  };
  std::string name;   ///< by which programs find it, such as "peaks"
  std::string title;  ///< for people
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;  ///< a cell for each column
  std::vector<std::string> notes;              ///< origins, contradictions, warnings: sentences
};

/// Title, columns with their units, rows and notes. No line break at the end.
std::string printed(const ResultTable& table);

/// The tables of a file with what they were made from, less the parameters.
struct TableFile {
  std::vector<ResultTable> tables;
  Provenance provenance;
};

/// Whether a file says that it holds tables of ours.
bool holds_tables(const std::filesystem::path& path);

/// @throws InputError if the file is missing, is none of ours or has a row of another length.
TableFile read_tables(const std::filesystem::path& path);

/// Writes tables as JSON, under a temporary name that is renamed: "format" is "flexneck tables",
/// "tables" a list of objects with the members above.
/// @throws InputError if the file cannot be written; nothing is left then.
void write_tables(const std::filesystem::path& path, const std::vector<ResultTable>& tables,
                  const Provenance& provenance);

}  // namespace flexneck::pipeline
