// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "nodes/editor/map_painter.hpp"
#include "nodes/editor/picture_painter.hpp"
#include "nodes/editor/work.hpp"

namespace rodeira::nodes {

// Where the map is drawn, and what mouse and keys do there.
class Canvas {
 public:
  // Pixels of the window, from its upper left corner.
  struct Area {
    float left = 0.0f, top = 0.0f, width = 1.0f, height = 1.0f;
  };

  // Below the panels, before they are drawn.
  void Draw(Work& work, const Area& area, int window_height_px);
  bool incomplete() const { return pictures_.incomplete(); }
  const std::vector<std::pair<std::int32_t, std::int32_t>>& proposals() const { return map_.proposals(); }

 private:
  static constexpr double kSnap_px = 12.0;

  // What the left button, held down, does.
  enum class Hold { kNone, kHandles, kPan, kRectangle, kTool };

  void TakeMouse(Work& work);
  void Press(Work& work, const Eigen::Vector2d& px);
  void DragHandles(Work& work, const Eigen::Vector2d& px);
  void Release(Work& work, const Eigen::Vector2d& px);
  void ChooseAt(Work& work, const Eigen::Vector2d& px, bool add);
  void FinishTool(Work& work, const Eigen::Vector2d& from_W, const Eigen::Vector2d& to_W);
  void TakeKeys(Work& work);
  void DrawOver(Work& work) const;
  void DrawNumbers(const Work& work) const;
  void DrawGesture(const Work& work) const;
  Eigen::Vector2d Screen(const Work& work, const Eigen::Vector2d& p_W) const;

  Area area_;
  MapPainter map_;
  PicturePainter pictures_;
  Hold hold_ = Hold::kNone;
  Eigen::Vector2d pressed_px_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d pressed_W_ = Eigen::Vector2d::Zero();
  bool moved_ = false;                                // more than a click's tremble
  std::vector<editor::Handle> dragged_;               // with the one that was taken first
  Eigen::Vector2d grip_W_ = Eigen::Vector2d::Zero();  // where that one was
  bool edited_ = false;                               // the gesture has its edit
};

}  // namespace rodeira::nodes
