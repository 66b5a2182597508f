// SPDX-License-Identifier: Apache-2.0
#include "common/editor/history.hpp"

#include "common/core/base/assert.hpp"

namespace rodeira::editor {

void History::Keep(Edit edit) {
  if (edit.empty()) return;
  undone_.clear();
  done_.push_back({std::move(edit), ++newest_});
}

const std::string& History::Undo() {
  RODEIRA_ASSERT(CanUndo());
  done_.back().edit.Undo(document_);
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  return undone_.back().edit.what();
}

const std::string& History::Redo() {
  RODEIRA_ASSERT(CanRedo());
  undone_.back().edit.Redo(document_);
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  return done_.back().edit.what();
}

}  // namespace rodeira::editor
