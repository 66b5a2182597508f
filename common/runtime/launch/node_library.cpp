// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/node_library.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/core/base/shared_object.hpp"
#include "common/data/decode/type_text.hpp"
#include "common/runtime/launch/used_topics.hpp"
#include "idl/idl_source.hpp"

namespace rodeira::launch {
namespace {

// Grows if the meaning of what passes changes and no size does.
constexpr std::size_t kLayoutVersion = 1;

constexpr std::size_t Layout() {
  std::size_t layout = kLayoutVersion;
  for (const std::size_t size :
       {sizeof(NodeContext), sizeof(Launch), sizeof(LaunchNode), sizeof(NodeKind), sizeof(config::Map),
        sizeof(lockstep::Roster), sizeof(lockstep::RosterNode), sizeof(lockstep::StepInfo), sizeof(lockstep::Inbox),
        sizeof(lockstep::Outbox), sizeof(lockstep::Sample), sizeof(lockstep::Node), sizeof(base::StateWriter),
        sizeof(base::StateReader), sizeof(base::Error), sizeof(NodeResult), sizeof(idl::TopicTable)})
    layout = layout * 1'000'003 + size;
  return layout;
}

// A node that cannot save its state, by its manifest.
class NodeWithoutState final : public lockstep::Node {
 public:
  explicit NodeWithoutState(std::unique_ptr<lockstep::Node> node) : node_(std::move(node)) {}
  base::Status Initialise(lockstep::Outbox& outbox) override { return node_->Initialise(outbox); }
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override {
    return node_->Step(step, inbox, outbox);
  }
  base::Status Flush() override { return node_->Flush(); }
  bool runs_inline() const override { return node_->runs_inline(); }
  void Save(base::StateWriter& out) const override { node_->Save(out); }
  void Restore(base::StateReader& in) override { node_->Restore(in); }
  bool can_save() const override { return false; }
  base::Status InitialiseFrom(const std::vector<lockstep::Sample>& published) override {
    return node_->InitialiseFrom(published);
  }
  base::Status Finish(const lockstep::Inbox& rest, lockstep::Step last_step, bool complete) override {
    return node_->Finish(rest, last_step, complete);
  }

 private:
  std::unique_ptr<lockstep::Node> node_;
};

}  // namespace

std::string NodeBuild() { return base::BuildText(Layout()); }

base::Status CheckCompiledTypes(const NodeContext& context) {
  const idl::TopicTable& table = context.launch().topics();
  for (const std::string& topic : UsedTopics(context.launch(), context.index())) {
    const idl::AddedTopic* added = table.FindAdded(topic);
    const decode::TypePtr compiled = added == nullptr ? nullptr : idl::CompiledType(added->type);
    if (compiled == nullptr) continue;
    const auto difference = decode::FirstTypeDifference(*compiled, *added->parsed);
    if (!difference) continue;
    return base::WrongInput(
        "launch.other_types",
        fmt::format("its type of topic {} differs from the manifest's: {}; build it again, from the "
                    "IDL that its manifest names",
                    topic, *difference));
  }
  return {};
}

base::Result<NodeFactory> LoadNodeLibrary(const std::filesystem::path& path) {
  const auto entry = base::LoadSharedObject(path, {kBuildEntry, kMakeEntry, "RODEIRA_NODE"}, NodeBuild());
  if (!entry) return entry.error();
  const auto make = reinterpret_cast<void (*)(NodeContext&, NodeResult&)>(entry.value());
  return NodeFactory([make](NodeContext& context) -> base::Result<std::unique_ptr<lockstep::Node>> {
    NodeResult made;
    make(context, made);
    RODEIRA_ASSERT(made.has_value());
    return std::move(*made);
  });
}

base::Result<std::unique_ptr<lockstep::Node>> AsManifestSays(const NodeKind& kind,
                                                             std::unique_ptr<lockstep::Node> node) {
  if (!kind.can_save) return std::unique_ptr<lockstep::Node>(std::make_unique<NodeWithoutState>(std::move(node)));
  if (kind.name != kExternalKind || node->can_save()) return node;
  return base::WrongInput(
      "launch.node_without_state",
      "its manifest lets it save its state, but the program cannot; can_save: false was expected in the manifest");
}

}  // namespace rodeira::launch
