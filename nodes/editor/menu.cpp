// SPDX-License-Identifier: Apache-2.0
#include <SDL.h>
#include <imgui.h>

#include <string>

#include "nodes/editor/panels.hpp"

namespace rodeira::nodes {
namespace {

// A key with what is held beside it, the same in the menu and in the hands.
struct Shortcut {
  const char* menu;
  const char* name;
  const char* keys;
  int scancode;
  bool ctrl, shift;
  void (*act)(Work&);
};

void Turn(bool& what) { what = !what; }
void Choose(Work& work, Tool tool, const char* hint) {
  work.tool = work.tool == tool ? Tool::kChoose : tool;
  work.session.Say(work.tool == tool ? hint : "choose and move");
}
void ChooseTemplate(Work& work, editor::Template what) {
  work.placing = what;
  work.tool = Tool::kTemplate;
  work.session.Say("press where its middle should be; draw to turn it");
}
void LaneBesideChosen(Work& work, bool on_left, bool same_way) {
  if (work.session.selection.lanes.size() != 1) return work.session.Say("one lane must be chosen", false);
  const std::int32_t lane = *work.session.selection.lanes.begin();
  work.session.Do([&](editor::Document& document) { return editor::LaneBeside(document, lane, on_left, same_way); });
}

constexpr Shortcut kShortcuts[] = {
    {"File", "New map", "Ctrl+N", SDL_SCANCODE_N, true, false, [](Work& w) { UnlessUnsaved(w, NewMap); }},
    {"File", "Open…", "Ctrl+O", SDL_SCANCODE_O, true, false, [](Work& w) { UnlessUnsaved(w, AskToOpen); }},
    {"File", "Save", "Ctrl+S", SDL_SCANCODE_S, true, false, [](Work& w) { SaveOrAsk(w); }},
    {"File", "Save as…", "Ctrl+Shift+S", SDL_SCANCODE_S, true, true, [](Work& w) { AskToSave(w, false); }},
    {"File", "Save a draft despite errors…", "Ctrl+Shift+D", SDL_SCANCODE_D, true, true,
     [](Work& w) { AskToSave(w, true); }},
    {"File", "Export as a world (OpenDRIVE)…", "Ctrl+E", SDL_SCANCODE_E, true, false, AskToExport},
    {"File", "Quit", "Ctrl+Q", SDL_SCANCODE_Q, true, false, AskToClose},
    {"Edit", "Undo", "Ctrl+Z", SDL_SCANCODE_Z, true, false, [](Work& w) { w.session.Undo(); }},
    {"Edit", "Redo", "Ctrl+Y", SDL_SCANCODE_Y, true, false, [](Work& w) { w.session.Redo(); }},
    {"Edit", "Delete what is chosen", "Del", SDL_SCANCODE_DELETE, false, false, DeleteChosen},
    {"Edit", "Choose all", "Ctrl+A", SDL_SCANCODE_A, true, false, ChooseAll},
    {"Edit", "Reset map…", "Ctrl+R", SDL_SCANCODE_R, true, false, [](Work& w) { w.Open(Form::kReset); }},
    {"Draw", "New curve", "C", SDL_SCANCODE_C, false, false, NewCurve},
    {"Draw", "New lane…", "N", SDL_SCANCODE_N, false, false, [](Work& w) { w.lane_form = {}, w.Open(Form::kLane); }},
    {"Draw", "New connection…", "K", SDL_SCANCODE_K, false, false,
     [](Work& w) { w.connection_form = {}, w.Open(Form::kConnection); }},
    {"Draw", "Lane along a line", "L", SDL_SCANCODE_L, false, false,
     [](Work& w) { Choose(w, Tool::kLane, "draw a lane along its middle; ends of lanes catch it"); }},
    {"Draw", "Lane beside, on the left", "Z", SDL_SCANCODE_Z, false, false,
     [](Work& w) { LaneBesideChosen(w, true, true); }},
    {"Draw", "Lane beside, on the right", "X", SDL_SCANCODE_X, false, false,
     [](Work& w) { LaneBesideChosen(w, false, true); }},
    {"Draw", "Lane against it, on the left", "Shift+Z", SDL_SCANCODE_Z, false, true,
     [](Work& w) { LaneBesideChosen(w, true, false); }},
    {"Draw", "Connect where ends meet", "P", SDL_SCANCODE_P, false, false, ProposeConnections},
    {"Draw", "Crossing", "1", SDL_SCANCODE_1, false, false,
     [](Work& w) { ChooseTemplate(w, editor::Template::kCrossing); }},
    {"Draw", "Roundabout", "2", SDL_SCANCODE_2, false, false,
     [](Work& w) { ChooseTemplate(w, editor::Template::kRoundabout); }},
    {"Draw", "Merge", "3", SDL_SCANCODE_3, false, false, [](Work& w) { ChooseTemplate(w, editor::Template::kMerge); }},
    {"Background", "Import…", "B", SDL_SCANCODE_B, false, false, AskToImport},
    {"Background", "Scale by a known distance", "M", SDL_SCANCODE_M, false, false,
     [](Work& w) { Choose(w, Tool::kMeasure, "draw along a distance that is known"); }},
    {"Background", "Take away", "Shift+B", SDL_SCANCODE_B, false, true,
     [](Work& w) { w.session.SetPicture("", w.session.document().map.scale.value.value); }},
    {"View", "Handles", "H", SDL_SCANCODE_H, false, false, [](Work& w) { Turn(w.handles); }},
    {"View", "Numbers", "I", SDL_SCANCODE_I, false, false, [](Work& w) { Turn(w.numbers); }},
    {"View", "Centre mark", "O", SDL_SCANCODE_O, false, false, [](Work& w) { Turn(w.centre); }},
    {"View", "Snap", "G", SDL_SCANCODE_G, false, false, [](Work& w) { Turn(w.snap); }},
    {"View", "Show everything", "F", SDL_SCANCODE_F, false, false, ShowAll},
    {"View", "Picture of the window", "F12", SDL_SCANCODE_F12, false, false, [](Work& w) { w.take_picture = true; }},
    {"Traffic", "Run, pause", "Space", SDL_SCANCODE_SPACE, false, false, RunOrPause},
    {"Traffic", "Stop", "Shift+Space", SDL_SCANCODE_SPACE, false, true, StopTraffic},
    {"Traffic", "Heat map", "T", SDL_SCANCODE_T, false, false, [](Work& w) { Turn(w.heat); }},
    {"Help", "Keys and mouse", "F1", SDL_SCANCODE_F1, false, false, [](Work& w) { w.Open(Form::kKeys); }},
};

bool IsOn(const Work& work, const Shortcut& entry) {
  switch (entry.scancode) {
    case SDL_SCANCODE_H:
      return work.handles;
    case SDL_SCANCODE_I:
      return work.numbers;
    case SDL_SCANCODE_G:
      return work.snap;
    case SDL_SCANCODE_T:
      return work.heat;
    case SDL_SCANCODE_O:
      return !entry.ctrl && work.centre;
    default:
      return false;
  }
}

}  // namespace

void DrawMenu(Work& work) {
  if (!ImGui::BeginMainMenuBar()) return;
  const char* before = "";
  bool open = false;
  for (const Shortcut& entry : kShortcuts) {
    if (entry.menu != before) {
      if (open) ImGui::EndMenu();
      before = entry.menu;
      open = ImGui::BeginMenu(entry.menu);
      if (!open) Note(work, std::string("menu ") + entry.menu);
    }
    if (!open) continue;
    const bool chosen = ImGui::MenuItem(entry.name, entry.keys, IsOn(work, entry));
    Note(work, entry.name);
    if (chosen) entry.act(work);
  }
  if (open) ImGui::EndMenu();
  ImGui::EndMainMenuBar();
}

void TakeShortcuts(Work& work) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || work.form != Form::kNone || work.files.open()) return;
  if (ImGui::IsKeyPressed(SDL_SCANCODE_ESCAPE, false)) work.tool = Tool::kChoose;
  for (const Shortcut& entry : kShortcuts) {
    if (io.KeyCtrl == entry.ctrl && io.KeyShift == entry.shift && !io.KeyAlt &&
        ImGui::IsKeyPressed(entry.scancode, false))
      return entry.act(work);
  }
}

}  // namespace rodeira::nodes
