// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/editor/lane_tools.hpp"
#include "common/editor/preview.hpp"
#include "common/editor/session.hpp"
#include "common/editor/templates.hpp"
#include "common/editor/viewport.hpp"
#include "nodes/editor/file_dialog.hpp"
#include "nodes/editor/picture_loader.hpp"

namespace rodeira::nodes {

// What the left button does on the canvas.
enum class Tool { kChoose, kLane, kMeasure, kTemplate };

// What stands open over the canvas, at most one at a time.
enum class Form { kNone, kLane, kConnection, kReset, kMeasured, kUnsaved, kRecover, kKeys };

// A form's fields, until they are confirmed.
struct LaneForm {
  int left = 0, right = 0;
  bool left_inverted = false, right_inverted = false;
  int left_type = 1, right_type = 1, mode = 0;
  std::int32_t of = 0;  // the lane that is changed; 0: a new one
};
// Numbers of lanes.
struct ConnectionForm {
  int from = 0, to = 0;
  bool stop = false;
};

// Traffic on the map as it was when it was started.
struct Traffic {
  std::optional<editor::Preview> preview;
  std::uint64_t of_state = 0;  // of the document
  bool runs = false;
  int vehicles = 30;
  float pace = 1.0f;  // times real time
  std::vector<editor::HeatPatch> heat;
  double heat_of_s = -1.0;
};

// What stands in a field of a number that has not been left yet.
struct Written {
  double value = 0.0;
  int picture = 0;  // the last one in which it had the keys
};

struct Work;
using Action = std::function<void(Work&)>;

// Everything that a person at the editor sees; the panels and the canvas draw and change it.
struct Work {
  editor::Session session;
  editor::Viewport view;
  Tool tool = Tool::kChoose;
  editor::Template placing = editor::Template::kCrossing;
  editor::TemplatePlace place;
  editor::LaneLook look;
  bool handles = true, numbers = true, centre = true, heat = true, snap = true;
  Form form = Form::kNone;
  bool form_opens = false;  // in this frame
  Action after;             // what waits for the question about unsaved work
  LaneForm lane_form;
  ConnectionForm connection_form;
  std::array<Eigen::Vector2d, 2> measured{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  double known_m = 100.0;
  FileDialog files;
  Traffic traffic;
  PictureLoader picture;
  std::vector<editor::Keeper::Left> left;        // unsaved work of editors that live no more
  std::optional<editor::Keeper::Left> taken_up;  // of it, which stays there until our own keeper has it
  bool take_picture = false;                     // of the window, when it is drawn next
  bool closing = false;                          // the window should close, and nothing hinders that
  std::map<std::string, Written> written;        // by the field's name
  std::map<std::string, Eigen::Vector2d>
      places;  // of buttons and fields in the last picture, pixels of the window: for scripted hands

  // In place of a form that is open.
  void Open(Form what) { form = what, form_opens = true; }
};

// Actions that a menu, a key and a panel share.
void NewCurve(Work& work);
// What is chosen is removed; nothing else is left of it but undo.
void DeleteChosen(Work& work);
void ChooseAll(Work& work);
// The view becomes so wide that the map and its picture are in it.
void ShowAll(Work& work);
// All connections that MissingConnections finds are made.
void ProposeConnections(Work& work);
// `then`, if any, is done as soon as the map is saved.
void SaveOrAsk(Work& work, const Action& then = {});
// Asks for the file first. despite_errors: a draft, which the check does not hinder.
void AskToSave(Work& work, bool despite_errors, const Action& then = {});
// At once, or, where something is unsaved, after asking whether to save it, to give it up, or to stay.
void UnlessUnsaved(Work& work, Action act);
// NewMap and AskToOpen give up what is there: call them by UnlessUnsaved. AskToClose asks by itself.
void NewMap(Work& work);
void AskToOpen(Work& work);
void AskToImport(Work& work);
void AskToExport(Work& work);
void AskToClose(Work& work);
// Traffic on the map as it is now; a changed map begins anew.
void RunOrPause(Work& work);
void StopTraffic(Work& work);

}  // namespace rodeira::nodes
