// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/exchange/fmu/model_description.h"

#include <algorithm>
#include <array>
#include <set>

#include "geometry/foundation/ascii.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/xml_text.h"

namespace flexneck::pipeline {
namespace {

struct Unit {
  std::string_view name;
  std::string_view exponents;  ///< attributes of BaseUnit
};
/// Units of the variables; a root of kg cannot be expressed.
constexpr std::array<Unit, 15> kUnits = {{
    {"s", R"(s="1")"},
    {"m", R"(m="1")"},
    {"m/s", R"(m="1" s="-1")"},
    {"m/s^2", R"(m="1" s="-2")"},
    {"rad", R"(rad="1")"},
    {"rad/s", R"(rad="1" s="-1")"},
    {"rad/s^2", R"(rad="1" s="-2")"},
    {"kg", R"(kg="1")"},
    {"N", R"(kg="1" m="1" s="-2")"},
    {"N m", R"(kg="1" m="2" s="-2")"},
    {"J", R"(kg="1" m="2" s="-2")"},
    {"N s/m", R"(kg="1" s="-1")"},
    {"N m s/rad", R"(kg="1" m="2" s="-1" rad="-1")"},
    {"1", ""},
    {"kg^(1/2) m", ""},
}};

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml_text(value) + "\"";
}

std::string unit_definitions(const std::vector<FmuVariable>& variables) {
  std::set<std::string> used;
  for (const FmuVariable& variable : variables) used.insert(variable.unit);
  std::string text = "  <UnitDefinitions>\n";
  for (const std::string& unit : used) {
    const auto known = std::find_if(kUnits.begin(), kUnits.end(),
                                    [&](const Unit& each) { return each.name == unit; });
    const bool has_base = known != kUnits.end() && (!known->exponents.empty() || unit == "1");
    text += "    <Unit" + attribute("name", unit) +
            (has_base ? "><BaseUnit " + std::string(known->exponents) + "/></Unit>\n" : "/>\n");
  }
  return text + "  </UnitDefinitions>\n";
}

std::string variable_text(const FmuVariable& variable, std::size_t reference) {
  std::string text = "    <Float64" + attribute("name", variable.name) +
                     attribute("valueReference", std::to_string(reference));
  if (!variable.what.empty()) text += attribute("description", variable.what);
  switch (variable.causality) {
    case Causality::independent:
      text += R"( causality="independent" variability="continuous")";
      break;
    case Causality::parameter:
      text += R"( causality="parameter" variability="fixed" initial="exact")";
      break;
    case Causality::input:
      text += R"( causality="input" variability="continuous")";
      break;
    case Causality::output:
      text += R"( causality="output" variability="continuous" initial="calculated")";
      break;
  }
  text += attribute("unit", variable.unit);
  if (variable.causality == Causality::parameter || variable.causality == Causality::input)
    text += attribute("start", exact_text(variable.start));
  return text + "/>\n";
}

std::string structure(const std::vector<FmuVariable>& variables) {
  std::string text = "  <ModelStructure>\n";
  for (const char* const element : {"Output", "InitialUnknown"})
    for (std::size_t k = 0; k < variables.size(); ++k)
      if (variables[k].causality == Causality::output)
        text += std::string("    <") + element + attribute("valueReference", std::to_string(k)) +
                "/>\n";
  return text + "  </ModelStructure>\n";
}

}  // namespace

std::string c_identifier(const std::string& name) {
  std::string identifier;
  for (const char c : name) identifier += is_letter_or_digit(c) ? c : '_';
  if (identifier.empty() || is_digit(identifier.front())) identifier = "_" + identifier;
  return identifier;
}

std::string model_description(const FmuDescription& description, FmuModel& fmu) {
  const std::vector<FmuVariable> variables = variables_of(fmu);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription" +
      attribute("fmiVersion", "3.0") + attribute("modelName", description.name) +
      (description.about.empty() ? "" : attribute("description", description.about)) +
      attribute("instantiationToken", description.token) +
      attribute("generationTool", description.tool) +
      attribute("variableNamingConvention", "flat") + ">\n";
  text += "  <CoSimulation" + attribute("modelIdentifier", description.identifier) +
          R"( canGetAndSetFMUState="true" canSerializeFMUState="true")"
          R"( canHandleVariableCommunicationStepSize="true" providesIntermediateUpdate="true")"
          R"( canReturnEarlyAfterIntermediateUpdate="true"/>)"
          "\n";
  text += unit_definitions(variables);
  text += "  <LogCategories>\n    <Category name=\"error\"/>\n  </LogCategories>\n";
  text += "  <DefaultExperiment" + attribute("startTime", exact_text(fmu.model.start.time_s)) +
          attribute("stopTime", exact_text(fmu.end_time_s)) +
          attribute("tolerance", exact_text(fmu.solver.relative_tolerance)) +
          attribute("stepSize", exact_text(fmu.interval_s)) + "/>\n";
  text += "  <ModelVariables>\n";
  for (std::size_t k = 0; k < variables.size(); ++k) text += variable_text(variables[k], k);
  text += "  </ModelVariables>\n" + structure(variables);
  return text + "</fmiModelDescription>\n";
}

}  // namespace flexneck::pipeline
