// SPDX-License-Identifier: Apache-2.0
#include "tests/property/mutate_structure.hpp"

#include <yaml-cpp/yaml.h>

#include <vector>

namespace rodeira::property {
namespace {

// A value of the file, and where it hangs.
struct Part {
  YAML::Node parent;      // a mapping or a sequence
  YAML::Node key;         // of a mapping
  std::size_t index = 0;  // of a sequence
  YAML::Node value;
};

void List(const YAML::Node& node, std::vector<Part>& parts) {
  if (node.IsMap()) {
    for (const auto& item : node) {
      parts.push_back({node, item.first, 0, item.second});
      List(item.second, parts);
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      parts.push_back({node, YAML::Node(), i, node[i]});
      List(node[i], parts);
    }
  }
}

void Put(Part& part, const YAML::Node& value) {
  if (part.parent.IsMap())
    part.parent[part.key.Scalar()] = value;
  else
    part.parent[part.index] = value;
}

// A value of another kind: what a person may have meant by it, or not.
YAML::Node Wrapped(const Part& part, Draw& draw) {
  YAML::Node made;
  switch (draw.Below(6)) {
    case 0:
      made.push_back(YAML::Clone(part.value));
      break;
    case 1:
      made["s_m"] = YAML::Clone(part.value);
      break;
    case 2:
      made = YAML::Node(YAML::NodeType::Map);
      break;
    case 3:
      made = YAML::Node(YAML::NodeType::Sequence);
      break;
    case 4:
      made = std::string(EdgeNumber(draw));
      break;
    default:
      break;  // nothing
  }
  return made;
}

// What is taken by yaml-cpp and comes out of it again; throws where the text is none, or the two places lie in one
// another.
std::string Changed(const std::string& yaml, Draw& draw) {
  const YAML::Node root = YAML::Load(yaml);
  std::vector<Part> parts;
  List(root, parts);
  if (parts.empty()) return yaml;
  // Mostly values: they are what readers have to think about.
  const auto any = [&]() -> Part& {
    Part& part = parts[draw.Below(parts.size())];
    return part.value.IsScalar() || draw.Below(3) == 0 ? part : parts[draw.Below(parts.size())];
  };
  Part& a = any();
  Part& b = any();
  const YAML::Node value_a = YAML::Clone(a.value), value_b = YAML::Clone(b.value);
  switch (draw.Below(9)) {
    case 0:
      if (a.parent.IsMap())
        a.parent.remove(a.key.Scalar());
      else
        a.parent.remove(a.index);
      break;
    case 1:
      Put(a, value_b);
      break;
    case 2:
      Put(b, value_a);
      Put(a, value_b);
      break;
    case 3:
      if (a.parent.IsSequence())
        a.parent.push_back(value_a);
      else if (b.parent.IsMap())
        a.parent[b.key.Scalar()] = value_b;
      break;
    case 4:
      if (!a.parent.IsMap() || !b.parent.IsMap()) break;
      a.parent.remove(a.key.Scalar());
      a.parent[b.key.Scalar()] = value_a;
      break;
    case 5:
      if (a.value.IsScalar() && b.value.IsScalar()) Put(a, value_b);
      break;
    case 6:
      Put(a, Wrapped(a, draw));
      break;
    default:
      if (a.value.IsScalar()) Put(a, YAML::Node(std::string(EdgeNumber(draw))));
  }
  YAML::Emitter out;
  out << root;
  return out.good() ? out.c_str() : yaml;
}

}  // namespace

void MutateStructure(std::string& yaml, Draw& draw) {
  try {
    yaml = Changed(yaml, draw);
  } catch (const YAML::Exception&) {
  }
}

}  // namespace rodeira::property
