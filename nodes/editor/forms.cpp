// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <utility>

#include "nodes/editor/panels.hpp"

namespace rodeira::nodes {
namespace {

using editor::Document;

enum class Answer { kNone, kYes, kNo, kOtherwise };

// The buttons at a form's end; Enter and Escape say the same as the first and the last.
Answer Buttons(Work& work, const char* yes, const char* no = "Cancel", const char* default_value = nullptr) {
  const ImVec2 size(110.0f, 0.0f);
  const auto key = [](ImGuiKey which) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(which), false); };
  Answer answer = Answer::kNone;
  if (Button(work, yes, yes, size) || key(ImGuiKey_Enter) || key(ImGuiKey_KeyPadEnter)) answer = Answer::kYes;
  ImGui::SameLine();
  if (default_value != nullptr) {
    if (Button(work, default_value, default_value, size)) answer = Answer::kOtherwise;
    ImGui::SameLine();
  }
  if (Button(work, no, no, size) || key(ImGuiKey_Escape)) answer = Answer::kNo;
  return answer;
}

void CurveFields(Work& work, const char* name, int& curve, bool& inverted, int& type) {
  ImGui::PushID(name);
  ImGui::SetNextItemWidth(110.0f);
  ImGui::InputInt(name, &curve, 0);
  ImGui::SameLine(220.0f);
  Tick(work, std::string(name) + " inverted", "inverted", inverted);
  OneOf(work, std::string(name) + " border", "border", type, kBorderNames, 160.0f);
  ImGui::PopID();
}

Answer DrawLaneForm(Work& work) {
  LaneForm& form = work.lane_form;
  if (work.form_opens) ImGui::SetKeyboardFocusHere();
  CurveFields(work, "left curve", form.left, form.left_inverted, form.left_type);
  CurveFields(work, "right curve", form.right, form.right_inverted, form.right_type);
  for (int mode = 0; mode < 3; ++mode) {
    if (mode > 0) ImGui::SameLine();
    ImGui::RadioButton(kModeNames[mode], &form.mode, mode);
    Note(work, std::string("mode ") + kModeNames[mode]);
  }
  const Answer answer = Buttons(work, "Make the lane");
  if (answer != Answer::kYes) return answer;
  const traffic_map::LaneSide left{form.left, form.left_inverted, static_cast<traffic_map::BorderType>(form.left_type)},
      right{form.right, form.right_inverted, static_cast<traffic_map::BorderType>(form.right_type)};
  work.session.Do([&](Document& document) {
    return editor::NewLane(document, left, right, static_cast<traffic_map::LaneMode>(form.mode));
  });
  return answer;
}

Answer DrawConnectionForm(Work& work) {
  ConnectionForm& form = work.connection_form;
  ImGui::SetNextItemWidth(110.0f);
  if (work.form_opens) ImGui::SetKeyboardFocusHere();
  ImGui::InputInt("from lane", &form.from, 0);
  ImGui::SetNextItemWidth(110.0f);
  ImGui::InputInt("to lane", &form.to, 0);
  Tick(work, "STOP", "STOP", form.stop);
  const Answer answer = Buttons(work, "Connect");
  if (answer == Answer::kYes)
    work.session.Do([&](Document& document) { return editor::NewConnection(document, form.from, form.to, form.stop); });
  return answer;
}

Answer DrawMeasured(Work& work) {
  ImGui::Text("The line is %.2f m long. How long is it really?", (work.measured[0] - work.measured[1]).norm());
  if (work.form_opens) ImGui::SetKeyboardFocusHere();
  ImGui::InputDouble("m", &work.known_m, 0.0, 0.0, "%.3f");
  const Answer answer = Buttons(work, "Scale");
  if (answer == Answer::kYes)
    work.session.Do([&](Document& document) {
      return editor::ScaleByDistance(document, work.measured[0], work.measured[1], work.known_m);
    });
  return answer;
}

Answer DrawReset(Work& work) {
  ImGui::TextUnformatted("All curves, lanes and connections go; the background stays.");
  const Answer answer = Buttons(work, "Reset");
  if (answer == Answer::kYes)
    work.session.selection = {}, work.session.Do([](Document& document) { return editor::Reset(document); });
  return answer;
}

Answer DrawUnsaved(Work& work) {
  const std::string name = work.session.path().empty() ? "The new map" : work.session.path().filename().string();
  ImGui::Text("%s has changes that are not saved.", name.c_str());
  const Answer answer = Buttons(work, "Save", "Cancel", "Discard");
  if (answer == Answer::kNone) return answer;
  const Action after = std::exchange(work.after, {});
  if (answer == Answer::kYes) SaveOrAsk(work, after);
  if (answer == Answer::kOtherwise) after(work);
  return answer;
}

Answer DrawRecover(Work& work) {
  const editor::Keeper::Left left = work.left.front();
  ImGui::Text("Unsaved work was left behind: %s", left.of.empty() ? "a new map" : left.of.c_str());
  const Answer answer = Buttons(work, "Take it up", "Later", "Discard");
  if (answer == Answer::kNone) return answer;
  work.left.erase(work.left.begin());
  if (answer == Answer::kOtherwise) editor::Keeper::Discard(left);
  if (answer != Answer::kYes) return answer;
  auto restored = editor::Keeper::Restore(left);
  if (!restored) {
    work.session.Say(restored.error().Text(), false);
    return answer;
  }
  work.session.Take(std::move(restored).value(), left.of, false);
  work.session.Say("taken up again: what was not saved");
  ShowAll(work);
  work.taken_up = left;
  work.left.clear();  // others are offered the next time
  return answer;
}

Answer DrawKeys(Work& work) {
  ImGui::TextUnformatted(
      "W A S D, or drag the empty ground     go\n"
      "wheel                                 zoom about the pointer\n"
      "drag a handle                         joined ends move together; Alt: this one alone\n"
      "click, Ctrl click                     choose, choose more\n"
      "Shift and drag                        choose all within a rectangle\n"
      "All other keys stand in the menus.");
  return Buttons(work, "Good");
}

}  // namespace

void DrawForms(Work& work) {
  if (work.form == Form::kNone) return;
  constexpr const char* kTitles[] = {
      "",         "New lane",      "New connection", "Reset the map", "Scale of the background", "Unsaved work",
      "Recovery", "Keys and mouse"};
  const char* title = kTitles[static_cast<int>(work.form)];
  if (work.form_opens) ImGui::OpenPopup(title);
  ImGui::SetNextWindowPos(ImVec2(0.5f * ImGui::GetIO().DisplaySize.x, 0.4f * ImGui::GetIO().DisplaySize.y),
                          ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    work.form = Form::kNone;
    return;
  }
  Answer answer = Answer::kNone;
  const Form form = work.form;
  switch (form) {
    case Form::kLane:
      answer = DrawLaneForm(work);
      break;
    case Form::kConnection:
      answer = DrawConnectionForm(work);
      break;
    case Form::kMeasured:
      answer = DrawMeasured(work);
      break;
    case Form::kReset:
      answer = DrawReset(work);
      break;
    case Form::kUnsaved:
      answer = DrawUnsaved(work);
      break;
    case Form::kRecover:
      answer = DrawRecover(work);
      break;
    case Form::kKeys:
      answer = DrawKeys(work);
      break;
    case Form::kNone:
      break;
  }
  work.form_opens = work.form != form;  // what was answered may have opened another one
  if (answer != Answer::kNone) {
    if (!work.form_opens) work.form = Form::kNone;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace rodeira::nodes
