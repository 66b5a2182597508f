#include "launch/node_factories.hpp"

#include "nodes/empty/empty_node.hpp"

namespace rodeira::front {

launch::NodeFactory FactoryOf(std::string_view kind) {
  if (kind == "empty") return nodes::MakeEmptyNode;
  return nullptr;
}

}  // namespace rodeira::front
