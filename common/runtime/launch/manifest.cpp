// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/base/suggest.hpp"
#include "common/core/config/declared.hpp"
#include "common/runtime/launch/manifest_schema.hpp"
#include "idl/idl_source.hpp"
#include "idl/topics.hpp"

namespace rodeira::launch {
namespace {

constexpr std::string_view kOwnPrefix = "rodeira/";
constexpr std::string_view kHeaderType = "rodeira::msg::SampleHeader";

// Topics with samples for nodes.
bool IsPort(const idl::TopicInfo& info) { return info.lockstep && info.topic != lockstep::kSnapshotTopic; }

std::vector<std::string> PortTopics(const idl::TopicTable& topics) {
  std::vector<std::string> names;
  for (const idl::AddedTopic& added : topics.added()) names.push_back(added.topic);
  for (const idl::TopicInfo& info : idl::Topics()) {
    if (IsPort(info)) names.emplace_back(info.topic);
  }
  return names;
}

// "lab/gaze": words of small letters, digits and _ between slashes, at least two.
bool IsTopicName(std::string_view name) {
  const auto is_part = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  bool in_word = false, has_slash = false;
  for (const char c : name) {
    if (c == '/' && !in_word) return false;
    if (c != '/' && !is_part(c)) return false;
    in_word = c != '/';
    has_slash = has_slash || c == '/';
  }
  return in_word && has_slash && name.size() <= 200;
}

class Reader {
 public:
  explicit Reader(const config::File& file) : file_(file) {}

  base::Result<Manifest> Read() {
    const config::DeclaredMap root(file_.root(), ManifestSchema().keys);
    (void)root.Word("rodeira");
    manifest_.kind.name = kExternalKind;
    manifest_.kind.default_period_s = root.Number("period_s");
    if (const auto delay_s = root.OptionalNumber("delay_s")) manifest_.kind.default_delay_s = *delay_s;
    manifest_.kind.can_save = root.Flag("can_save");
    const config::DeclaredList outputs = root.Items("outputs");
    for (std::size_t i = 0; i < outputs.size(); ++i) ReadOutput(outputs.At(i));
    const config::DeclaredList inputs = root.Items("inputs");
    for (std::size_t i = 0; i < inputs.size(); ++i) ReadInput(inputs.At(i));
    if (auto status = file_.Finish(); !status) return status.error();
    if (problem_) return *problem_;
    return std::move(manifest_);
  }

 private:
  void ReadOutput(const config::DeclaredMap& declared) {
    const config::Map& map = declared.map();
    const std::string topic = declared.Text("topic");
    auto& outputs = manifest_.kind.outputs;
    if (std::ranges::find(outputs, topic) != outputs.end())
      return map.Problem("topic", "config.duplicate_name", fmt::format("output '{}' is there twice", topic));
    outputs.push_back(topic);
    const idl::TopicInfo* own = idl::FindTopic(topic);
    if (own != nullptr && IsPort(*own)) {
      for (const char* key : {"type", "idl"}) {
        if (map.Has(key)) map.Problem(key, fmt::format("'{}' is a topic of Rodeira, which has its type", topic));
      }
      return;
    }
    if (topic.starts_with(kOwnPrefix)) {
      return map.Problem("topic", fmt::format("'{}' is not a topic that a node can publish; names that begin with "
                                              "'{}' belong to Rodeira{}",
                                              topic, kOwnPrefix, base::DidYouMean(topic, PortTopics({}))));
    }
    if (!topic.empty() && !IsTopicName(topic)) {
      return map.Problem(
          "topic",
          fmt::format("'{}' is not the name of a topic; words of a-z, 0-9 and _ between slashes were expected, "
                      "as in lab/gaze",
                      topic));
    }
    const std::string type = declared.MapWith("type").Text("type");
    if (!map.Has("idl"))
      return map.Problem("topic", "config.missing_key", fmt::format("key 'idl' of output '{}' is missing", topic));
    const std::filesystem::path path = declared.MapWith("idl").Path("idl");
    if (!type.empty() && !topic.empty()) AddTopic(map, topic, type, path);
  }
  void AddTopic(const config::Map& map, const std::string& topic, const std::string& type,
                const std::filesystem::path& path) {
    if (path.extension() != ".idl")
      return map.Problem("idl", fmt::format("'{}' was found; a file NAME.idl was expected", path.string()));
    const auto source = idl::IdlSource::Read(path);
    if (!source) return Keep(map, "idl", path, source.error());
    const auto parsed = source.value().Find(type);
    if (!parsed) return Keep(map, "type", path, parsed.error());
    const decode::Type& found = *parsed.value();
    if (found.kind != decode::Kind::kStruct || found.members.front().type->name != kHeaderType) {
      return map.Problem("type", fmt::format("the first member of '{}' is not the sample header; 'rodeira::msg::"
                                             "SampleHeader header' was expected, from sample_header.idl",
                                             type));
    }
    manifest_.topics.push_back({topic, type, source.value().text(), parsed.value()});
    manifest_.topic_places.push_back(map.Place("topic"));
  }
  void ReadInput(const config::DeclaredMap& declared) {
    const config::Map& map = declared.map();
    KindPort port;
    port.topic = declared.Text("topic");
    const std::string kind = declared.Word("port");
    port.kind = kind == "event" ? lockstep::PortKind::kEvent : lockstep::PortKind::kState;
    port.many = declared.Flag("many");
    port.required = declared.Flag("required");
    for (const KindPort& other : manifest_.kind.inputs) {
      if (other.topic == port.topic)
        map.Problem("topic", "config.duplicate_name", fmt::format("input '{}' is there twice", port.topic));
    }
    manifest_.kind.inputs.push_back(std::move(port));
    manifest_.input_places.push_back(map.Place("topic"));
  }
  // What is wrong inside an IDL file is said with its place, all else with the manifest's.
  void Keep(const config::Map& map, std::string_view key, const std::filesystem::path& path, const base::Error& error) {
    if (error.context == path.string())
      return map.Problem(key, error.id, path.filename().string() + ": " + error.message);
    if (!problem_) problem_ = error;
  }

  const config::File& file_;
  Manifest manifest_;
  std::optional<base::Error> problem_;
};

}  // namespace

base::Result<Manifest> ReadManifest(const std::filesystem::path& path) {
  const auto file = config::File::Load(path);
  if (!file) return file.error();
  return Reader(file.value()).Read();
}

base::Status CheckInputs(const Manifest& manifest, const idl::TopicTable& topics) {
  for (std::size_t i = 0; i < manifest.kind.inputs.size(); ++i) {
    const std::string& topic = manifest.kind.inputs[i].topic;
    const std::vector<std::string> known = PortTopics(topics);
    if (std::ranges::find(known, topic) != known.end()) continue;
    return base::WrongInput("launch.unknown_topic",
                            fmt::format("no node can publish the topic '{}'{}", topic, base::DidYouMean(topic, known)),
                            manifest.input_places[i]);
  }
  return {};
}

}  // namespace rodeira::launch
