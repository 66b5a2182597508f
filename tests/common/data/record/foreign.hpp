// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/common/data/record/mutated.hpp"
#include "tests/common/data/record/sample.hpp"

// Recordings as other programs write them, from MCAP's specification alone (https://mcap.dev/spec): nothing here uses
// the encoder of the module that is tested.
namespace rodeira::record {

// What a file has of what the specification leaves to the writer.
struct Form {
  int messages_a_chunk = 4;          // 0: all messages outside of chunks
  int every_nth_outside = 0;         // of messages, while a chunk is open; 0: none
  std::string compression;           // "", "zstd", "lz4"
  bool definitions_outside = false;  // schemas and channels before the first chunk, not in it
  bool repeats_definitions = false;  // identical ones again in each chunk
  bool checksums = true;
  bool data_end = true;
  bool message_indexes = true;
  bool empty_message_indexes = false;  // of channels without a message in the chunk, too
  bool schemas = true;                 // these seven in the summary
  bool channels = true;
  bool statistics = true;
  bool channel_counts = true;
  bool chunk_indexes = true;
  bool attachment_indexes = true;
  bool metadata_indexes = true;
  bool summary_offsets = true;
  bool channels_first = false;   // before the schemas in the summary
  bool silent_channel = false;   // a channel without a message
  bool unknown_fields = false;   // behind the known ones
  bool unknown_records = false;  // opcodes of applications and of later revisions
  std::string library = "another writer";

  bool has_summary() const {
    return schemas || channels || statistics || chunk_indexes || attachment_indexes || metadata_indexes;
  }
};

Form DrawForm(Draw& draw);
std::string Text(const Form& form);

// The messages of the plan, a metadata record and an attachment, in that form. The topics are kTopics; the ids have
// gaps. With `silent_channel` there is a topic "silent".
base::Bytes ForeignRecord(const std::vector<Call>& calls, const Form& form);

// A plan of up to 40 calls; the times go back and forth.
std::vector<Call> DrawPlan(Draw& draw);

}  // namespace rodeira::record
