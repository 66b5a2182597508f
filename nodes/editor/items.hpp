// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "nodes/editor/work.hpp"

// What panels and forms are made of. Each writes down where it stands (Work::places) by a name, so that scripted hands
// find it.
namespace rodeira::nodes {

// Where the item that was drawn last stands; nowhere where it cannot be seen.
void Note(Work& work, const std::string& name);

// True where it was clicked in this picture.
bool Button(Work& work, const std::string& name, const char* label, const ImVec2& size = ImVec2(0.0f, 0.0f));
bool SmallButton(Work& work, const std::string& name, const char* label);
// True: `value` has changed.
bool Tick(Work& work, const std::string& name, const char* label, bool& value);
// A line of a list; true where it was clicked.
bool Listed(Work& work, const std::string& name, const std::string& text, bool chosen);
// A heading that opens what is below it.
bool Heading(Work& work, const char* label, bool open_at_first);
// One of `names`; those of the opened list are noted as "NAME: ONE".
bool OneOf(Work& work, const std::string& name, const char* label, int& value, std::span<const char* const> names,
           float width_px);
// A number that counts when its field is left, by Enter, Tab or a click elsewhere; Escape leaves it as it was. True: it
// has changed.
bool Number(Work& work, const std::string& name, const char* label, double& value, const char* format, float width_px);

}  // namespace rodeira::nodes
