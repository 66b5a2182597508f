// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace rodeira::road {

// For XML.
std::string EscapedText(std::string_view text);

// Words on a picture, none over another. The first has the better place; the same calls give the same places.
class PlotLabels {
 public:
  // Within a picture of this size, in SVG units.
  PlotLabels(double width, double height) : width_(width), height_(height) {}

  // Puts a word beside a point (y downward), `gap` away from it: to its right, or where that is taken to one of the
  // other sides. False, and nothing put, where there is no room. `text` is plain.
  bool Put(const Eigen::Vector2d& point, double gap, double size, const char* colour, std::string_view text);
  // Keeps a rectangle clear that begins at its upper left corner; false, and nothing kept, where it is taken.
  bool Keep(const Eigen::Vector2d& corner, const Eigen::Vector2d& size);

  // Words stand on a square about this point only where there is no other room for them; what is kept may.
  void Avoid(const Eigen::Vector2d& point, double half) {
    avoided_.push_back({point - Eigen::Vector2d::Constant(half), point + Eigen::Vector2d::Constant(half)});
  }

  const std::string& svg() const { return svg_; }

 private:
  struct Box {
    Eigen::Vector2d low, high;
  };
  static bool Touch(const Box& a, const Box& b);
  bool IsFree(const Box& box) const;

  double width_, height_;
  std::vector<Box> taken_, avoided_;
  std::string svg_;
};

}  // namespace rodeira::road
