// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/editor/edit.hpp"

namespace rodeira::editor {

// A document and everything that was done to it, to be taken back and done again. Each state has a number: equal
// numbers are equal documents. One thread.
class History {
 public:
  explicit History(Document document) : document_(std::move(document)) {}

  const Document& document() const { return document_; }
  std::uint64_t state() const { return done_.empty() ? first_ : done_.back().state; }

  // `command(Document&)` gives a Result<Edit>: what it did, or why it did nothing. An edit without changes is not kept.
  template <class Command>
  base::Status Do(const Command& command) {
    base::Result<Edit> edit = command(document_);
    if (!edit) return edit.error();
    Keep(std::move(edit).value());
    return {};
  }
  // The last edit, which was a part of the same gesture (a handle that is dragged on), is replaced: its change is taken
  // back first. Where the command fails it is done again, and the command's error is returned. There must be a last
  // edit (CanUndo).
  template <class Command>
  base::Status Again(const Command& command) {
    done_.back().edit.Undo(document_);
    base::Result<Edit> edit = command(document_);
    if (!edit) {
      done_.back().edit.Redo(document_);
      return edit.error();
    }
    done_.pop_back();
    Keep(std::move(edit).value());
    return {};
  }

  // Whether there is an edit to take back, or to do again.
  bool CanUndo() const { return !done_.empty(); }
  bool CanRedo() const { return !undone_.empty(); }
  // What was taken back or done again; only where it can be.
  const std::string& Undo();
  const std::string& Redo();
  // Of what Undo would take back; empty where there is nothing.
  std::string Last() const { return done_.empty() ? "" : done_.back().edit.what(); }
  // Of what Redo would do again.
  std::string Next() const { return undone_.empty() ? "" : undone_.back().edit.what(); }

 private:
  struct Done {
    Edit edit;
    std::uint64_t state = 0;  // after it
  };
  void Keep(Edit edit);

  Document document_;
  std::vector<Done> done_, undone_;
  std::uint64_t first_ = 0, newest_ = 0;
};

}  // namespace rodeira::editor
