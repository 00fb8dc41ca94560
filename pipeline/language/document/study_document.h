// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "pipeline/language/document/document_source.h"
#include "pipeline/language/document/key.h"

namespace flexneck::pipeline {

/// One table of a study. The format's table of keys (key.h) defines what a key means: a getter
/// checks type, unit and range, returns the fallback of an absent key, and records that the key is
/// known, so that finish() can refuse the keys that no getter asked for. A value is written
/// throw InputError with file, line, column, dotted key, what was expected and what was found; and
/// std::logic_error where a reader asks for a key that is not in the table of keys, or for another
/// type.
class StudyTable {
 public:
  struct Node;
  explicit StudyTable(std::shared_ptr<Node> node);

  bool has(const std::string& key) const;
  /// True if the value is a text in quotes.
  bool is_text(const std::string& key) const;
  std::string text(const std::string& key) const;
  /// @param fallback  for a key whose fallback depends on others
  std::string text_or(const std::string& key, const std::string& fallback) const;
  /// Index of a text among the choices of its key.
  std::size_t choice(const std::string& key) const;
  std::vector<std::string> texts(const std::string& key) const;
  bool flag(const std::string& key) const;
  /// Integer value.
  int count(const std::string& key) const;
  int count_or(const std::string& key, int fallback) const;

  /// A pure number, written without a unit.
  double number(const std::string& key) const;
  double number_or(const std::string& key, double fallback) const;
  /// List of pure numbers; `size` 0 means the size in the key's row.
  std::vector<double> numbers(const std::string& key, std::size_t size = 0) const;
  /// True if the value is a list.
  bool is_list(const std::string& key) const;

  /// A dimensional number such as "0.4 in", returned in SI units.
  /// @param unit  one of the key's units; may be empty if there is only one
  double quantity(const std::string& key, const std::string& unit = {}) const;
  std::vector<double> quantities(const std::string& key, std::size_t size = 0,
                                 const std::string& unit = {}) const;
  /// Path that a key names, relative to the folder of the file that holds the key.
  std::filesystem::path file(const std::string& key) const;

  /// Sub-table; empty if absent.
  StudyTable table(const std::string& key) const;
  /// Array of tables; empty if absent.
  std::vector<StudyTable> tables(const std::string& key) const;
  std::vector<std::string> keys() const;
  /// This table with the keys of another added: its own keys win. Parameters keep the names of the
  /// table that they are in.
  StudyTable over(const StudyTable& below) const;
  /// Folder of the file that holds the key, to resolve relative paths.
  std::filesystem::path folder_of(const std::string& key) const;

  /// Refuses keys that no getter has asked for, and suggests the nearest known key.
  void finish() const;
  /// Throws "<file>:<line>:<column>: <dotted key>: <problem>".
  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const;
  /// Refuses the first of these keys that is present, as one that conflicts with the others.
  void refuse_given(const std::vector<std::string>& keys, const std::string& problem) const;
  /// Rows of the keys that this table may have.
  std::span<const Key> key_rows() const;

 private:
  std::shared_ptr<Node> node_;
};

/// A study file with everything it includes (`include = ["other.toml"]`, relative to the file; the
/// keys of the including file win) and the values set on the command line.
class StudyDocument {
 public:
  /// `settings` are "dotted.key=value"; an element of an array of tables is addressed by its name,
  /// as in "case.flexion-60.duration=0.5 s".
  /// @param keys  of the format; they outlive the document and its tables
  /// @throws InputError for a file that is missing or does not parse (line and column).
  StudyDocument(const DocumentSource& source, const std::vector<std::string>& settings,
                std::span<const Key> keys);

  StudyTable root() const;
  /// Replaces a value, as a setting does, without reading the files again. Records of reading are
  /// reset: parameters and defaults start anew. Tables handed out before become invalid.
  /// @param setting  neither a variable nor a value made of variables, which were substituted for
  /// good
  void set(const std::string& setting);
  /// The files read, in the order of inclusion, with the hash of their contents.
  const std::vector<InputFile>& files() const;
  /// Every value read through the tables so far, in the order of reading.
  const std::vector<Parameter>& parameters() const;
  /// Fallback values that the getters have returned for absent keys.
  const std::vector<Parameter>& defaults() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace flexneck::pipeline
