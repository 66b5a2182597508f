// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/editor/history.hpp"
#include "common/editor/selection.hpp"
#include "common/editor/store.hpp"

namespace rodeira::editor {

// A person's work on one map: the document with its history, what is chosen, the file, and what the last action came
// to.
class Session {
 public:
  Session();

  const Document& document() const { return history_.document(); }
  const History& history() const { return history_; }
  const std::filesystem::path& path() const { return path_; }  // empty: no file yet
  bool unsaved() const { return saved_state_ != history_.state(); }
  // Changes with the document: equal numbers are equal documents.
  std::uint64_t state() const { return history_.state() + opened_; }
  // Changes with the picture alone.
  std::uint64_t picture_state() const { return picture_state_; }

  // What the last action came to, for the status line: good in green, bad in red.
  struct Said {
    std::string text;
    bool good = true;
  };
  const Said& said() const { return said_; }
  // In place of what was said before.
  void Say(std::string text, bool good = true) { said_ = {std::move(text), good}; }

  // An action: its name, or why it was not done, is said. True where it was done.
  template <class Command>
  bool Do(const Command& command) {
    return Told(history_.Do(command));
  }
  // The same action goes on (a handle is dragged on).
  template <class Command>
  bool Again(const Command& command) {
    return Told(history_.Again(command));
  }
  // SetPicture and Undo and Redo of it change the picture; all others are asked for through Do.
  bool SetPicture(std::string bytes, float scale);
  // Undo and Redo tell what they did, or that there is nothing to do.
  void Undo();
  void Redo();

  Selection selection;

  // An empty map without a file; true.
  bool New();
  // What was open before is left only where this one can be opened.
  bool Open(const std::filesystem::path& file);
  // Makes what was opened elsewhere the session's document; `saved`: it is as `file` has it.
  void Take(Opened opened, const std::filesystem::path& file, bool saved);
  // The check first: errors are said, the first one's element is chosen, nothing is written. Where `despite_errors`
  // they are no hindrance.
  bool Save(const std::filesystem::path& file, bool despite_errors = false);

  // Everything that is wrong with the map as it is now; looked for again only after it changed.
  const std::vector<traffic_map::Finding>& Findings();

 private:
  bool Told(const base::Status& status);

  History history_;
  LoadedCompanion loaded_;
  std::filesystem::path path_;
  std::uint64_t saved_state_ = 0, opened_ = 0, picture_state_ = 0;
  Said said_;
  std::vector<traffic_map::Finding> findings_;
  std::optional<std::uint64_t> checked_state_;
};

}  // namespace rodeira::editor
