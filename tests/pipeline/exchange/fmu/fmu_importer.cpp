// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/pipeline/exchange/fmu/fmu_importer.h"

#include <fstream>
#include <iterator>
#include <regex>

namespace flexneck::testing {
namespace {

std::string attribute(const std::string& element, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(element, found, std::regex(" " + name + "=\"([^\"]*)\""))) return {};
  return found[1];
}

}  // namespace

LoadedFmu::LoadedFmu(const std::filesystem::path& folder) : folder_(folder) {
  std::ifstream file(folder / "modelDescription.xml");
  const std::string xml{std::istreambuf_iterator<char>(file), {}};
  token_ = attribute(xml, "instantiationToken");
  const std::regex variable("<Float64[^>]*>");
  for (auto each = std::sregex_iterator(xml.begin(), xml.end(), variable);
       each != std::sregex_iterator(); ++each)
    references_[attribute(each->str(), "name")] =
        static_cast<fmi3ValueReference>(std::stoul(attribute(each->str(), "valueReference")));
  file_ = folder / "binaries/x86_64-linux" / (attribute(xml, "modelIdentifier") + ".so");
  object_ = dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object_ == nullptr) throw std::runtime_error(dlerror());
}

bool LoadedFmu::close() {
  if (object_ == nullptr) return true;
  dlclose(object_);
  object_ = nullptr;
  void* const still = dlopen(file_.c_str(), RTLD_NOW | RTLD_NOLOAD);
  if (still != nullptr) dlclose(still);
  return still == nullptr;
}

FmuRun::FmuRun(const LoadedFmu& fmu) : fmu_(fmu) {
  const auto log = [](fmi3InstanceEnvironment run, fmi3Status, fmi3String, fmi3String message) {
    static_cast<FmuRun*>(run)->logged += std::string(message) + "\n";
  };
  const auto update = [](fmi3InstanceEnvironment environment, fmi3Float64 time_s, fmi3Boolean,
                         fmi3Boolean, fmi3Boolean, fmi3Boolean may_return, fmi3Boolean* returns,
                         fmi3Float64*) {
    const FmuRun& run = *static_cast<FmuRun*>(environment);
    *returns = may_return && run.goes_on && !run.goes_on(time_s);
  };
  instance_ = fmu.function<fmi3InstantiateCoSimulationTYPE>("fmi3InstantiateCoSimulation")(
      "run", fmu.token().c_str(), fmu.resources().c_str(), false, true, false, true, nullptr, 0,
      this, log, update);
  if (instance_ == nullptr) throw std::runtime_error("no instance: " + logged);
}

void FmuRun::require(fmi3Status status, const std::string& what) const {
  if (status != fmi3OK)
    throw std::runtime_error(what + " gives " + std::to_string(status) + ": " + logged);
}

void FmuRun::initialize(double tolerance) {
  require(fmu_.function<fmi3EnterInitializationModeTYPE>("fmi3EnterInitializationMode")(
              instance_, tolerance > 0, tolerance, 0, false, 0),
          "fmi3EnterInitializationMode");
  require(call("fmi3ExitInitializationMode"), "fmi3ExitInitializationMode");
}

fmi3Status FmuRun::call(const char* function) {
  return fmu_.function<fmi3ModeTYPE>(function)(instance_);
}

void FmuRun::set(const std::string& name, double value) {
  const fmi3ValueReference reference = fmu_.reference(name);
  require(fmu_.function<fmi3SetFloat64TYPE>("fmi3SetFloat64")(instance_, &reference, 1, &value, 1),
          "fmi3SetFloat64");
}

double FmuRun::get(const std::string& name) const {
  return get(std::vector<std::string>{name}).front();
}

std::vector<double> FmuRun::get(const std::vector<std::string>& names) const {
  std::vector<fmi3ValueReference> references;
  references.reserve(names.size());
  for (const std::string& name : names) references.push_back(fmu_.reference(name));
  std::vector<double> values(names.size());
  require(fmu_.function<fmi3GetFloat64TYPE>("fmi3GetFloat64")(
              instance_, references.data(), references.size(), values.data(), values.size()),
          "fmi3GetFloat64");
  return values;
}

fmi3Status FmuRun::step(double time_s, double length_s) {
  fmi3Boolean event = true, terminate = true, early = true;
  const fmi3Status status = fmu_.function<fmi3DoStepTYPE>("fmi3DoStep")(
      instance_, time_s, length_s, true, &event, &terminate, &early, &reached_s);
  if (event || terminate || (early && !goes_on))
    throw std::runtime_error("a flag is set without reason");
  if (status == fmi3OK && (reached_s != time_s + length_s) != early)
    throw std::runtime_error("another time");
  return status;
}

fmi3FMUState FmuRun::save() {
  fmi3FMUState state = nullptr;
  require(fmu_.function<fmi3GetFMUStateTYPE>("fmi3GetFMUState")(instance_, &state),
          "fmi3GetFMUState");
  return state;
}

void FmuRun::restore(fmi3FMUState state) {
  require(fmu_.function<fmi3SetFMUStateTYPE>("fmi3SetFMUState")(instance_, state),
          "fmi3SetFMUState");
}

void FmuRun::free(fmi3FMUState& state) {
  require(fmu_.function<fmi3FreeFMUStateTYPE>("fmi3FreeFMUState")(instance_, &state),
          "fmi3FreeFMUState");
}

std::vector<fmi3Byte> FmuRun::bytes_of(fmi3FMUState state) {
  std::size_t size = 0;
  require(fmu_.function<fmi3SerializedFMUStateSizeTYPE>("fmi3SerializedFMUStateSize")(instance_,
                                                                                      state, &size),
          "fmi3SerializedFMUStateSize");
  std::vector<fmi3Byte> bytes(size);
  require(fmu_.function<fmi3SerializeFMUStateTYPE>("fmi3SerializeFMUState")(instance_, state,
                                                                            bytes.data(), size),
          "fmi3SerializeFMUState");
  return bytes;
}

fmi3FMUState FmuRun::state_of(const std::vector<fmi3Byte>& bytes) {
  fmi3FMUState state = nullptr;
  require(fmu_.function<fmi3DeserializeFMUStateTYPE>("fmi3DeserializeFMUState")(
              instance_, bytes.data(), bytes.size(), &state),
          "fmi3DeserializeFMUState");
  return state;
}

}  // namespace flexneck::testing
