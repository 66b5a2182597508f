// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/file_dialog.hpp"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <system_error>

namespace rodeira::nodes {
namespace {

namespace fs = std::filesystem;

std::string EndingOf(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return ending;
}

}  // namespace

void FileDialog::Open(std::string title, std::vector<std::string> endings, bool to_write, const fs::path& start,
                      Chosen chosen) {
  open_ = opens_ = true;
  to_write_ = to_write;
  title_ = std::move(title);
  endings_ = std::move(endings);
  chosen_ = std::move(chosen);
  why_not_.clear();
  asked_.clear();
  std::error_code problem;
  folder_ = start.has_parent_path() ? start.parent_path() : fs::current_path(problem);
  name_.fill('\0');
  const std::string name = start.filename().string();
  name.copy(name_.data(), name_.size() - 1);
  List();
}

void FileDialog::List() {
  folders_.clear(), files_.clear();
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder_, fs::directory_options::skip_permission_denied, problem)) {
    if (entry.path().filename().string().starts_with('.')) continue;
    if (entry.is_directory(problem))
      folders_.push_back(entry.path());
    else if (std::find(endings_.begin(), endings_.end(), EndingOf(entry.path())) != endings_.end())
      files_.push_back(entry.path());
  }
  std::sort(folders_.begin(), folders_.end());
  std::sort(files_.begin(), files_.end());
}

void FileDialog::Confirm() {
  std::error_code problem;
  const std::string text = name_.data();
  if (text.empty()) return;
  fs::path path = fs::path(text).is_absolute() ? fs::path(text) : folder_ / text;
  if (fs::is_directory(path, problem)) {
    folder_ = path;
    name_.fill('\0');
    return List();
  }
  if (to_write_ && path.extension().empty()) path += endings_.front();
  if (!to_write_ && !fs::exists(path, problem)) {
    why_not_ = "there is no such file";
    return;
  }
  if (to_write_ && fs::exists(path, problem) && asked_ != path) {
    asked_ = path;
    why_not_ = "the file is there already; once more to replace it";
    focuses_ = true;
    return;
  }
  open_ = false;
  chosen_(path);
}

void FileDialog::Draw() {
  if (!open_) return;
  constexpr const char* kName = "###files";
  const std::string name = title_ + kName;
  if (opens_) ImGui::OpenPopup(name.c_str());
  const ImVec2 middle(0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y);
  ImGui::SetNextWindowPos(middle, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(560.0f, 420.0f));
  if (!ImGui::BeginPopupModal(name.c_str(), &open_, ImGuiWindowFlags_NoResize)) {
    open_ = false;  // something else was asked meanwhile
    return;
  }
  ImGui::TextUnformatted(folder_.c_str());
  bool lists = false;
  ImGui::BeginChild("entries", ImVec2(0.0f, -62.0f), true);
  if (folder_.has_parent_path() && ImGui::Selectable("..")) folder_ = folder_.parent_path(), lists = true;
  for (const fs::path& folder : folders_) {
    if (!lists && ImGui::Selectable((folder.filename().string() + "/").c_str())) folder_ = folder, lists = true;
  }
  for (const fs::path& file : files_) {
    const std::string entry = file.filename().string();
    if (!ImGui::Selectable(entry.c_str(), entry == name_.data(), ImGuiSelectableFlags_AllowDoubleClick)) continue;
    name_.fill('\0');
    entry.copy(name_.data(), name_.size() - 1);
    if (ImGui::IsMouseDoubleClicked(0)) Confirm();
  }
  ImGui::EndChild();
  if (lists) List();
  if (opens_ || focuses_) ImGui::SetKeyboardFocusHere();
  opens_ = focuses_ = false;
  ImGui::SetNextItemWidth(-150.0f);
  const bool entered = ImGui::InputText("##name", name_.data(), name_.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  const bool pressed = ImGui::Button("OK", ImVec2(65.0f, 0.0f));
  if (entered || pressed) Confirm();
  ImGui::SameLine();
  if (ImGui::Button("Cancel", ImVec2(65.0f, 0.0f)) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
    open_ = false;
  ImGui::TextColored(ImVec4(1.0f, 0.45f, 0.4f, 1.0f), "%s", why_not_.c_str());
  if (!open_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace rodeira::nodes
