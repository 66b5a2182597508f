// SPDX-License-Identifier: Apache-2.0
#include "common/editor/session.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/editor/commands.hpp"
#include "common/world/traffic_map/check.hpp"

namespace rodeira::editor {
namespace {

constexpr std::uint64_t kNextFile = std::uint64_t{1} << 40;  // states of one file are fewer

}  // namespace

Session::Session() : history_(EmptyDocument()) {}

bool Session::Told(const base::Status& status) {
  if (status)
    Say(history_.Last());
  else
    Say(status.error().Text(), false);
  return status.ok();
}

bool Session::SetPicture(std::string bytes, float scale) {
  const bool done = Do([&](Document& document) { return editor::SetPicture(document, std::move(bytes), scale); });
  if (done) ++picture_state_;
  return done;
}

void Session::Undo() {
  if (!history_.CanUndo()) return Say("there is nothing to undo", false);
  const std::size_t picture = history_.document().map.picture.size();
  const auto* bytes = history_.document().map.picture.data();
  Say("undone: " + history_.Undo());
  if (history_.document().map.picture.data() != bytes || history_.document().map.picture.size() != picture)
    ++picture_state_;
}

void Session::Redo() {
  if (!history_.CanRedo()) return Say("there is nothing to do again", false);
  const std::size_t picture = history_.document().map.picture.size();
  const auto* bytes = history_.document().map.picture.data();
  Say("done again: " + history_.Redo());
  if (history_.document().map.picture.data() != bytes || history_.document().map.picture.size() != picture)
    ++picture_state_;
}

bool Session::New() {
  Take({EmptyDocument(), {}}, {}, true);
  Say("new map");
  return true;
}

bool Session::Open(const std::filesystem::path& file) {
  auto opened = editor::Open(file);
  if (!opened) {
    Say(opened.error().Text(), false);
    return false;
  }
  Take(std::move(opened).value(), file, true);
  const auto& findings = Findings();
  const auto errors = std::count_if(findings.begin(), findings.end(), [](const traffic_map::Finding& f) {
    return f.severity == traffic_map::Severity::kError;
  });
  Say(errors == 0 ? "opened " + file.filename().string()
                  : fmt::format("opened {}; the check finds {} errors", file.filename().string(), errors),
      errors == 0);
  return true;
}

void Session::Take(Opened opened, const std::filesystem::path& file, bool saved) {
  history_ = History(std::move(opened.document));
  loaded_ = std::move(opened.companion);
  path_ = file;
  selection = {};
  opened_ += kNextFile;
  saved_state_ = saved ? history_.state() : ~std::uint64_t{0};
  checked_state_.reset();
  ++picture_state_;
}

bool Session::Save(const std::filesystem::path& file, bool despite_errors) {
  const auto& findings = Findings();
  const auto wrong = std::find_if(findings.begin(), findings.end(), [](const traffic_map::Finding& f) {
    return f.severity == traffic_map::Severity::kError;
  });
  if (wrong != findings.end() && !despite_errors) {
    selection = Chosen(*wrong);
    Say("not saved: " + wrong->Text(), false);
    return false;
  }
  auto written = editor::Save(document(), loaded_, file);
  if (!written) {
    Say("not saved: " + written.error().Text(), false);
    return false;
  }
  loaded_ = std::move(written).value();
  path_ = file;
  saved_state_ = history_.state();
  Say("saved " + file.filename().string());
  return true;
}

const std::vector<traffic_map::Finding>& Session::Findings() {
  if (checked_state_ != history_.state()) {
    findings_ = traffic_map::CheckMap(document().map, document().companion);
    checked_state_ = history_.state();
  }
  return findings_;
}

}  // namespace rodeira::editor
