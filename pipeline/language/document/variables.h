// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/provenance.h"
#include "pipeline/language/document/product_text.h"

namespace flexneck::pipeline {

/// Origin and note of a value.
struct Label {
  Origin origin = Origin::synthetic;
  std::string note;
};

/// Value of a variable or of a product of variables.
struct VariableValue {
  double number = 0;
  bool is_whole = false;
  std::string unit;            ///< empty for a pure number
  std::optional<Label> label;  ///< none for a plain 1 or -1, which is a sign and not a datum
};

/// Label of a combination of two values, either of which may have none.
std::optional<Label> weaker(std::optional<Label> a, std::optional<Label> b);

/// The table [variables] of a file with its includes. All members throw InputError with file, line,
/// column and dotted key.
class Variables {
 public:
  /// @param table  name = number, quantity or product, plainly or as { value, origin, note }
  /// @param path   path of the table in messages and parameters, such as "variables"
  Variables(toml::table&& table, std::string path);

  /// Replaces all products of variables (product_text.h) in a tree by their values. A value without
  /// an origin of its own gets the weakest origin of its factors. Lines and columns remain those of
  /// the product.
  void substitute(toml::table& tree);
  /// Refuses an unused variable.
  void finish() const;
  /// The variables as parameters of the document.
  std::vector<Parameter> parameters() const;

 private:
  struct Variable {
    std::optional<VariableValue> value;  ///< none until it is requested
    bool is_used = false;
  };
  /// Replacement of a text in a tree, if it is a product.
  struct Replacement {
    bool is_replaced = false;
    std::optional<Label> label;
  };

  const VariableValue& value_of(const std::string& name);
  VariableValue definition(const std::string& name);
  VariableValue product_value(const ProductText& product, const toml::node& at,
                              const std::string& key);
  const VariableValue& named(const std::string& name, const toml::node& at, const std::string& key);

  void substitute_in(toml::table& table, const std::string& path);
  void substitute_key(toml::table& table, const std::string& key, const std::string& path);
  void substitute_tables(toml::array& list, const std::string& path);
  Replacement replace(toml::table& table, const std::string& key, const std::string& path);
  Replacement replace_elements(toml::array& list, const std::string& path);

  toml::table table_;
  std::string path_;
  std::map<std::string, Variable> variables_;
  std::vector<std::string> open_;  ///< the variable being evaluated and those that name it
};

}  // namespace flexneck::pipeline
