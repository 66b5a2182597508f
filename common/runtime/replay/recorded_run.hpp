// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/runtime/launch/files_of.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/snapshot.hpp"

namespace rodeira::replay {

// The header of a recorded payload that must be a sample of `source`; wrong input where it is none.
base::Result<lockstep::SampleHeader> HeaderOf(std::span<const std::byte> payload, lockstep::SourceIndex source);

// The samples of a recording in the order of (step, source), as the law's consumers see them.
class SampleStream {
 public:
  // Nothing at the end; wrong input where the file is damaged there.
  base::Result<std::optional<lockstep::Sample>> Next();

 private:
  friend class RecordedRun;
  SampleStream(record::MessageCursor cursor, const std::map<record::ChannelId, lockstep::SourceIndex>& sources,
               lockstep::Step last)
      : cursor_(std::move(cursor)), sources_(sources), last_(last) {}
  record::MessageCursor cursor_;
  const std::map<record::ChannelId, lockstep::SourceIndex>& sources_;
  lockstep::Step last_;
};

// A recording as a run: its launch file and configurations as they were, its roster, samples and snapshots.
class RecordedRun {
 public:
  // `extra` replaces values of the recorded launch file, behind the run's own --set. Wrong input where this is no
  // recording of Rodeira or is not whole. Its types are not compared with this program's: see CheckTypes.
  static base::Result<RecordedRun> Open(const std::filesystem::path& path, const launch::Overrides& extra = {});

  const std::filesystem::path& path() const { return path_; }
  const launch::Launch& launch() const { return *launch_; }
  const lockstep::Roster& roster() const { return launch_->roster(); }
  lockstep::Step last_step() const { return last_step_; }
  bool complete() const { return complete_; }  // false: the run was aborted
  // Which program recorded: its release and commit.
  const std::string& version() const { return version_; }
  const std::string& commit() const { return commit_; }
  // What is wrong with an embedded file, or with what follows from one: said with this recording's name and the file's
  // in it.
  base::Error Named(const base::Error& error) const;
  // Wrong input where a byte of the file is not as it was written. Reads all of it.
  base::Status CheckBytes() const;
  // Wrong input if the recorded type of one of these topics (today's names) is not this program's, also by the aliases
  // of names; it says which topic, what differs and which program recorded. A topic that is not recorded is passed
  // over.
  base::Status CheckTypes(const std::set<std::string_view>& topics) const;
  // The same of every topic of the run's samples: what computing the run again needs.
  base::Status CheckTypes() const;
  // By today's name of the topic.
  std::vector<record::ChannelId> ChannelsOf(std::string_view topic) const;
  // Wrong input where this process would compute other bits than the one that recorded (law L7).
  base::Status CheckMathematics() const;
  // Its samples are taken from the recording where the run is computed again: live input, and external nodes without a
  // shared object. `extra` of Open names shared objects (nodes.NAME.library); one that a recording names is never
  // loaded.
  bool is_substituted(lockstep::NodeIndex node) const;
  // Where this run left its parent; 0 where it has none. What lies before was computed by the parent's nodes.
  lockstep::Step branched_at() const { return branched_at_; }
  const std::string& parent() const { return parent_; }  // its file's name; empty where it has none
  // Of the world that the road server said; empty where there was none.
  const std::string& world_hash() const { return world_hash_; }

  // From the samples valid at or after `from` on. The run must outlive the stream.
  SampleStream Samples(lockstep::Step from = 0) const;
  const record::McapReader& reader() const { return reader_; }
  // Where a source's samples are recorded; nothing where they are not.
  std::optional<record::ChannelId> ChannelOf(lockstep::SourceIndex source) const;
  // The nodes, but live input and external nodes, with snapshots that say that they could not save their state: what
  // they did can be computed again only from the first step on.
  base::Result<std::vector<lockstep::NodeIndex>> WithoutState() const;
  // The newest step at or before `step` at which every node's snapshot was taken (of a branch: the first of its own, at
  // least); 0 where there is only the beginning, or a node without a state. Wrong input where a branch has none, or
  // such a node.
  base::Result<lockstep::Step> SnapshotAtOrBefore(lockstep::Step step) const;
  // Of every node of the roster, in its order, at such a step; sinks' and services' are without a state. Wrong input
  // where one is missing, or a sample that a node may ask for behind it.
  base::Result<std::vector<lockstep::Snapshot>> Snapshots(lockstep::Step at) const;

 private:
  explicit RecordedRun(record::McapReader reader, base::TemporaryFolder folder)
      : reader_(std::move(reader)), folder_(std::move(folder)) {}
  base::Status CheckChannels() const;
  base::Status CheckSamples(const lockstep::Snapshot& snapshot) const;
  base::Status Read(const launch::Overrides& extra);
  base::Result<std::vector<launch::NamedFile>> Files(const record::TextMap& about) const;

  std::filesystem::path path_;
  record::McapReader reader_;
  base::TemporaryFolder folder_;
  std::shared_ptr<launch::Launch> launch_;
  std::set<std::string> with_library_;  // names of nodes
  std::map<record::ChannelId, lockstep::SourceIndex> sources_;
  lockstep::Step last_step_ = 0;
  lockstep::Step branched_at_ = 0;
  std::string parent_;
  std::string world_hash_;
  std::string mathematics_;
  std::string version_;
  std::string commit_;
  bool complete_ = false;
};

}  // namespace rodeira::replay
