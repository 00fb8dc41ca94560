// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "pipeline/document/document_source.h"
#include "pipeline/document/key.h"

namespace flexneck::pipeline {

/// One table of a study. What a key means stands in the format's table of keys (key.h): a getter
/// checks type, unit and range, returns the fallback of a key that is not there, and remembers that
/// the key is known, so that finish() can refuse the keys that nobody asked for. A value is written
/// plainly or, with its origin, as { value = …, origin = "published", note = "…" }. All members
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
  /// @param fallback  of a key for which it depends on others
  std::string text_or(const std::string& key, const std::string& fallback) const;
  /// Position of a text among the choices of its key.
  std::size_t choice(const std::string& key) const;
  std::vector<std::string> texts(const std::string& key) const;
  bool flag(const std::string& key) const;
  /// A whole number.
  int count(const std::string& key) const;
  int count_or(const std::string& key, int fallback) const;

  /// A pure number, written without a unit.
  double number(const std::string& key) const;
  double number_or(const std::string& key, double fallback) const;
  /// A list of them; `size` 0 means that of the key's row.
  std::vector<double> numbers(const std::string& key, std::size_t size = 0) const;
  /// True if the value is a list.
  bool is_list(const std::string& key) const;

  /// A dimensional number such as "0.4 in", returned in SI units.
  /// @param unit  of those of the key; may be empty if it has one
  double quantity(const std::string& key, const std::string& unit = {}) const;
  std::vector<double> quantities(const std::string& key, std::size_t size = 0,
                                 const std::string& unit = {}) const;
  /// The path that a key names, from the folder of the file that holds the key.
  std::filesystem::path file(const std::string& key) const;

  /// A sub-table; an absent one is empty.
  StudyTable table(const std::string& key) const;
  /// An array of tables; an absent one is empty.
  std::vector<StudyTable> tables(const std::string& key) const;
  std::vector<std::string> keys() const;
  /// This table with what another has besides: its own keys win. Parameters keep the names of the
  /// table that they stand in.
  StudyTable over(const StudyTable& below) const;
  /// Folder of the file that holds the key, for paths given relative to it.
  std::filesystem::path folder_of(const std::string& key) const;

  /// Refuses keys that no getter has asked for, with the nearest known one.
  void finish() const;
  /// "<file>:<line>:<column>: <dotted key>: <problem>"
  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const;
  /// Refuses the first of these keys that is there, as one that does not go with the others.
  void refuse_given(const std::vector<std::string>& keys, const std::string& problem) const;
  /// What the keys of this table may be.
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
  /// Puts another value in the place of one, as a setting does, without reading the files again.
  /// What has been read so far is forgotten: parameters and defaults begin anew. Tables that were
  /// handed out end with this.
  /// @param setting  neither of variables nor made of them, which took their places for good
  void set(const std::string& setting);
  /// The files read, in the order of inclusion, with the hash of their contents.
  const std::vector<InputFile>& files() const;
  /// What the files say in words of an earlier version, a line each.
  const std::vector<std::string>& warnings() const;
  /// Every value read through the tables so far, in the order of reading.
  const std::vector<Parameter>& parameters() const;
  /// The values that the getters with a fallback have returned for keys that are not there.
  const std::vector<Parameter>& defaults() const;

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace flexneck::pipeline
