// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/description.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>

namespace rodeira::fmi {
namespace {

VariableType TypeOf(const pugi::xml_node& variable) {
  if (variable.child("Real")) return VariableType::kReal;
  if (variable.child("Integer") || variable.child("Enumeration")) return VariableType::kInteger;
  return variable.child("Boolean") ? VariableType::kBoolean : VariableType::kOther;
}

}  // namespace

const Variable* Description::Find(std::string_view name) const {
  for (const Variable& variable : variables) {
    if (variable.name == name) return &variable;
  }
  return nullptr;
}

base::Result<Description> ReadDescription(const std::filesystem::path& file, const std::string& context) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(file, problem))
    return base::WrongInput("this is no FMU: it holds no modelDescription.xml", context);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_file(file.c_str());
  if (!parsed)
    return base::WrongInput(fmt::format("its modelDescription.xml is no XML: {}", parsed.description()), context);
  const pugi::xml_node root = document.child("fmiModelDescription");
  if (!root) return base::WrongInput("its modelDescription.xml holds no 'fmiModelDescription'", context);
  const std::string version = root.attribute("fmiVersion").as_string();
  if (version != "2.0")
    return base::WrongInput(fmt::format("this FMU is of FMI version '{}'; 2.0 was expected", version), context);
  const pugi::xml_node simulation = root.child("CoSimulation");
  if (!simulation)
    return base::WrongInput(
        "this FMU offers no co-simulation (only model exchange); an FMU for co-simulation was expected", context);
  if (simulation.attribute("needsExecutionTool").as_bool()) {
    return base::WrongInput(
        "this FMU needs its maker's program to run ('needsExecutionTool'); one that runs by itself was expected",
        context);
  }
  Description description;
  description.model_name = root.attribute("modelName").as_string();
  description.guid = root.attribute("guid").as_string();
  description.identifier = simulation.attribute("modelIdentifier").as_string();
  description.can_get_state = simulation.attribute("canGetAndSetFMUstate").as_bool();
  description.can_serialize_state = simulation.attribute("canSerializeFMUstate").as_bool();
  if (description.identifier.empty() || description.identifier.find('/') != std::string::npos) {
    return base::WrongInput(
        fmt::format("its 'modelIdentifier' is '{}'; the name of its binary was expected", description.identifier),
        context);
  }
  for (const pugi::xml_node& node : root.child("ModelVariables").children("ScalarVariable")) {
    description.variables.push_back({node.attribute("name").as_string(), node.attribute("valueReference").as_uint(),
                                     node.attribute("causality").as_string("local"), TypeOf(node),
                                     node.child("Real").attribute("unit").as_string()});
  }
  return description;
}

}  // namespace rodeira::fmi
