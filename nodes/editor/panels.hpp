// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "nodes/editor/items.hpp"
#include "nodes/editor/work.hpp"

// What stands around the canvas. Each draws itself with Dear ImGui and does what is asked there.
namespace rodeira::nodes {

void DrawMenu(Work& work);
// Keys that stand in the menu.
void TakeShortcuts(Work& work);
// Left: new elements, lists, what is chosen, traffic. `proposals`: connections that could be made.
void DrawSide(Work& work, const std::vector<std::pair<std::int32_t, std::int32_t>>& proposals, float top, float width,
              float height);
// Parts of DrawSide.
void DrawLists(Work& work);
void DrawChosenPanel(Work& work);
void DrawBesidePanel(Work& work);  // heights, signs, flows of what is chosen
void DrawLightsPanel(Work& work);
void DrawTrafficPanel(Work& work);
void DrawBackgroundPanel(Work& work);
// Below: the last action in green or red, the visible width, what is loading.
void DrawStatus(Work& work, float top, float width, float height);
// The form that is open, over all else.
void DrawForms(Work& work);

extern const char* const kBorderNames[traffic_map::kBorderTypes];
extern const char* const kModeNames[3];

}  // namespace rodeira::nodes
