// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "common/core/base/files.hpp"

namespace rodeira::fmi {
namespace {

VariableType TypeOf(const pugi::xml_node& variable) {
  if (variable.child("Real")) return VariableType::kReal;
  if (variable.child("Integer") || variable.child("Enumeration")) return VariableType::kInteger;
  return variable.child("Boolean") ? VariableType::kBoolean : VariableType::kOther;
}

// From 1: the lines of the text before a node.
class Lines {
 public:
  explicit Lines(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(i));
    }
  }
  int Of(const pugi::xml_node& node) const {
    return static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), node.offset_debug()) - ends_.begin()) + 1;
  }

 private:
  std::vector<std::ptrdiff_t> ends_;
};

std::map<std::string, UnitDefinition, std::less<>> ReadUnits(const pugi::xml_node& root) {
  constexpr std::array kBases = {"kg", "m", "s", "A", "K", "mol", "cd", "rad"};
  std::map<std::string, UnitDefinition, std::less<>> units;
  for (const pugi::xml_node& node : root.child("UnitDefinitions").children("Unit")) {
    const pugi::xml_node base = node.child("BaseUnit");
    if (!base) continue;
    UnitDefinition unit;
    for (std::size_t i = 0; i < kBases.size(); ++i) unit.exponents[i] = base.attribute(kBases[i]).as_int();
    unit.factor = base.attribute("factor").as_double(1.0);
    unit.offset = base.attribute("offset").as_double(0.0);
    units[node.attribute("name").as_string()] = unit;
  }
  return units;
}

// Units of the types that variables name by `declaredType`.
std::map<std::string, std::string, std::less<>> ReadTypeUnits(const pugi::xml_node& root) {
  std::map<std::string, std::string, std::less<>> units;
  for (const pugi::xml_node& type : root.child("TypeDefinitions").children("SimpleType"))
    units[type.attribute("name").as_string()] = type.child("Real").attribute("unit").as_string();
  return units;
}

}  // namespace

std::string PlaceOf(const std::string& file, int line) {
  return fmt::format("{}: modelDescription.xml:{}", file, line);
}

const Variable* Description::Find(std::string_view name) const {
  for (const Variable& variable : variables) {
    if (variable.name == name) return &variable;
  }
  return nullptr;
}

base::Result<Description> ReadDescription(const std::filesystem::path& file, const std::string& context) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(file, problem))
    return base::WrongInput("fmu.not_an_fmu", "this is no FMU: it holds no modelDescription.xml", context);
  const auto text = base::ReadText(file);
  if (!text) return text.error().WithContext(context);
  const Lines lines(text.value());
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.value().data(), text.value().size());
  if (!parsed)
    return base::WrongInput("fmu.wrong_description",
                            fmt::format("its modelDescription.xml is no XML: {}", parsed.description()), context);
  const pugi::xml_node root = document.child("fmiModelDescription");
  if (!root)
    return base::WrongInput("fmu.wrong_description", "its modelDescription.xml holds no 'fmiModelDescription'",
                            context);
  const auto place = [&](const pugi::xml_node& node) { return PlaceOf(context, lines.Of(node)); };
  const std::string version = root.attribute("fmiVersion").as_string();
  if (version != "2.0")
    return base::WrongInput("fmu.other_version",
                            fmt::format("this FMU is of FMI version '{}'; 2.0 was expected", version), place(root));
  const pugi::xml_node simulation = root.child("CoSimulation");
  if (!simulation)
    return base::WrongInput(
        "fmu.not_co_simulation",
        "this FMU offers no co-simulation (only model exchange); an FMU for co-simulation was expected", place(root));
  if (simulation.attribute("needsExecutionTool").as_bool()) {
    return base::WrongInput(
        "fmu.not_co_simulation",
        "this FMU needs its maker's program to run ('needsExecutionTool'); one that runs by itself was expected",
        place(simulation));
  }
  Description description;
  description.model_name = root.attribute("modelName").as_string();
  description.guid = root.attribute("guid").as_string();
  description.identifier = simulation.attribute("modelIdentifier").as_string();
  description.can_get_state = simulation.attribute("canGetAndSetFMUstate").as_bool();
  description.can_serialize_state = simulation.attribute("canSerializeFMUstate").as_bool();
  if (description.identifier.empty() || description.identifier.find('/') != std::string::npos) {
    return base::WrongInput(
        "fmu.wrong_description",
        fmt::format("its 'modelIdentifier' is '{}'; the name of its binary was expected", description.identifier),
        context);
  }
  description.only_once = simulation.attribute("canBeInstantiatedOnlyOncePerProcess").as_bool();
  description.units = ReadUnits(root);
  const auto type_units = ReadTypeUnits(root);
  for (const pugi::xml_node& node : root.child("ModelVariables").children("ScalarVariable")) {
    const pugi::xml_node real = node.child("Real");
    std::string unit = real.attribute("unit").as_string();
    const auto type = type_units.find(std::string_view(real.attribute("declaredType").as_string()));
    if (unit.empty() && type != type_units.end()) unit = type->second;
    description.variables.push_back({node.attribute("name").as_string(), node.attribute("valueReference").as_uint(),
                                     node.attribute("causality").as_string("local"), TypeOf(node), std::move(unit),
                                     lines.Of(node)});
  }
  return description;
}

}  // namespace rodeira::fmi
