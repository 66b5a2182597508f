// SPDX-License-Identifier: Apache-2.0
#include "tests/system/recording.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "common/runtime/lockstep/sample.hpp"
#include "idl/topics.hpp"

namespace rodeira::system_test {

std::vector<Recorded> SamplesOf(const std::string& recording) {
  std::vector<Recorded> samples;
  const auto unreadable = [&](const std::string& why) {
    ADD_FAILURE() << recording << ": " << why;
    return std::vector<Recorded>();
  };
  const auto reader = record::McapReader::Open(recording);
  if (!reader) return unreadable(reader.error().Text());
  if (!reader.value().condition().whole) return unreadable("it is not whole");
  record::Query query;
  query.order = record::Query::Order::kFile;
  auto cursor = reader.value().Messages(query);
  for (;;) {
    const auto message = cursor.Next();
    if (!message) return unreadable(message.error().Text());
    if (!message.value()) return samples;
    const std::string& name = reader.value().channels().at(message.value()->channel).topic;
    const idl::TopicInfo* topic = idl::FindTopic(name);
    if (topic != nullptr && !topic->lockstep) continue;  // topics of external nodes are in lockstep
    const auto& bytes = message.value()->data;
    if (!lockstep::SampleHeader::HasHeader(bytes)) return unreadable(name + ": a sample without a header");
    const auto header = lockstep::SampleHeader::Read(bytes);
    samples.push_back({name, header.source, header.step, base::Hash(bytes), header.state_digest});
  }
}

std::string FirstDifference(const std::vector<Recorded>& a, const std::vector<Recorded>& b) {
  const auto text = [](const std::vector<Recorded>& samples, std::size_t at) -> std::string {
    if (at >= samples.size()) return "nothing";
    const Recorded& s = samples[at];
    return fmt::format("{} of source {} at step {} (payload {}, state {})", s.topic, s.source, s.step,
                       base::Hex(s.payload), base::Hex(s.state));
  };
  for (std::size_t i = 0; i < a.size() || i < b.size(); ++i) {
    if (i < a.size() && i < b.size() && a[i] == b[i]) continue;
    return fmt::format("sample {}: {} here, {} there", i, text(a, i), text(b, i));
  }
  return "";
}

void WaitForGrowth(const std::string& recording) {
  std::error_code problem;
  const auto before = std::filesystem::file_size(recording, problem);
  for (int i = 0; i < 2000 && (std::filesystem::file_size(recording, problem) == before || problem); ++i)
    ::usleep(5000);
}

}  // namespace rodeira::system_test
