// SPDX-License-Identifier: Apache-2.0
#include "common/world/opendrive/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace rodeira::opendrive {
namespace {

constexpr int kMaxPasses = 12;
constexpr int kLastResort = 9;  // from this reading on roads that are still wrong are left out

bool IsUnrepaired(const Finding& finding) { return finding.repair.done.empty() && finding.repair.edits.empty(); }

void ByLine(std::vector<Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.line < b.line; });
}

// The findings of which an edit was made; the others come again with the next reading.
void KeepMade(std::vector<Finding> errors, const std::vector<Edit>& made, std::vector<Finding>& repaired,
              std::set<std::string>& told) {
  for (Finding& error : errors) {
    const auto is_in = [&](const Edit& edit) {
      const auto at = std::lower_bound(made.begin(), made.end(), edit.begin,
                                       [](const Edit& a, std::size_t begin) { return a.begin < begin; });
      return at != made.end() && *at == edit;
    };
    if (error.repair.edits.empty() || !std::any_of(error.repair.edits.begin(), error.repair.edits.end(), is_in))
      continue;
    error.repair.edits.clear();
    if (told.insert(error.Text()).second) repaired.push_back(std::move(error));
  }
}

// Repairs that came to no end: the roads are left out instead.
void LeaveOutRoads(const std::string& text, std::vector<Finding>& errors) {
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8)) return;
  for (Finding& error : errors) {
    if (error.repair.edits.empty() || error.road.empty()) continue;
    for (const pugi::xml_node road : document.document_element().children("road")) {
      if (error.road != road.attribute("id").value()) continue;
      const auto begin = static_cast<std::size_t>(road.offset_debug()) - 1;
      error.repair = {RepairKind::kRoadLeftOut, kLeftOut, {{begin, ElementEnd(text, begin), ""}}};
      break;
    }
  }
}

}  // namespace

base::Result<Import> ReadRepaired(FileText file, const std::filesystem::path& path, const Tolerance& tolerance) {
  std::string text = std::move(file.text);
  Edited edited = std::move(file.edited);
  const base::Digest hash = base::Hash(text);
  std::vector<Finding> repaired;
  std::set<std::string> told;
  std::optional<Reach> before;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    auto import = ReadOnce(text, path, tolerance, &edited);
    if (!import) return import.error();
    Import& read = import.value();
    read.content_hash = hash;
    if (!before) before = read.before;
    read.before = before;
    std::vector<Edit> edits;
    if (pass >= kLastResort) LeaveOutRoads(text, read.errors);
    for (const Finding& error : read.errors)
      edits.insert(edits.end(), error.repair.edits.begin(), error.repair.edits.end());
    edits = Compatible(std::move(edits));
    if (!edits.empty() && pass + 1 < kMaxPasses) {
      KeepMade(std::move(read.errors), edits, repaired, told);
      text = Apply(text, edits);
      edited.maps.emplace_back(edits);
      continue;
    }
    std::vector<Finding> refused;
    for (Finding& error : read.errors) {
      const bool is_refused = IsUnrepaired(error) || !error.repair.edits.empty();
      error.repair.edits.clear();
      if (is_refused)
        error.repair.done.clear();
      else if (told.contains(error.Text()))
        continue;
      (is_refused ? refused : repaired).push_back(std::move(error));
    }
    read.errors.clear();
    ByLine(repaired);
    if (!refused.empty()) {  // roads that were left out are told first
      std::erase_if(repaired, [](const Finding& finding) { return finding.repair.kind != RepairKind::kRoadLeftOut; });
      read.network = nullptr;
      for (Finding& finding : repaired) finding.repair.done.clear();
      read.errors = std::move(repaired);
      read.errors.insert(read.errors.end(), refused.begin(), refused.end());
      return import;
    }
    read.warnings.insert(read.warnings.end(), std::make_move_iterator(repaired.begin()),
                         std::make_move_iterator(repaired.end()));
    ByLine(read.warnings);
    if (!edited.maps.empty()) read.repaired_text = std::move(text);
    return import;
  }
  return base::WrongInput("opendrive.repair_failed", "the repair came to no end", path.string());
}

std::vector<Finding> OneEachKind(const std::vector<Finding>& findings) {
  std::vector<Finding> kinds;
  std::map<std::pair<std::string, std::string>, std::pair<std::size_t, int>> of;
  for (const Finding& finding : findings) {
    const std::string done = finding.repair.Name();
    // Of what is only told without a place the sentence is the kind: an element that is not read.
    const bool has_place = !finding.road.empty() || finding.s_m || finding.lane;
    const auto [at, is_new] =
        of.try_emplace({finding.rule, has_place || !done.empty() ? done : finding.message}, std::pair(kinds.size(), 0));
    if (is_new) kinds.push_back(finding);
    ++at->second.second;
  }
  for (const auto& [key, kind] : of) {
    if (kind.second > 1) kinds[kind.first].message += fmt::format(" ({} of this kind)", kind.second);
  }
  return kinds;
}

}  // namespace rodeira::opendrive
