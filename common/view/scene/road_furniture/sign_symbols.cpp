// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/sign_symbols.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "common/core/base/constants.hpp"
#include "common/view/scene/raster/lettering.hpp"

namespace rodeira::scene {
namespace {

using P = Eigen::Vector2d;

const Colour kWhite = Colour::Of(0xf4f4f1), kRed = Colour::Of(0xc2151d), kBlue = Colour::Of(0x17509b),
             kYellow = Colour::Of(0xf6b915), kBlack = Colour::Of(0x131313), kGrey = Colour::Of(0x8f9294),
             kGreen = Colour::Of(0x006b54), kBrown = Colour::Of(0x693f23), kOrange = Colour::Of(0xf07c14),
             kLime = Colour::Of(0xc5e72e);

// The shape made smaller about a point by a factor.
Polyline Smaller(const Polyline& line, const P& about, double factor) {
  Polyline smaller;
  for (const P& p : line) smaller.push_back(about + factor * (p - about));
  return smaller;
}

Polyline Arc(const P& middle, double radius, double from_deg, double to_deg) {
  Polyline line;
  for (int k = 0; k <= 16; ++k) {
    const double angle = (from_deg + (to_deg - from_deg) * k / 16.0) * base::kPi / 180.0;
    line.push_back(middle + radius * P(std::cos(angle), std::sin(angle)));
  }
  return line;
}

// A line that ends in a head.
void Arrow(Canvas& canvas, const Polyline& line, double width, Colour colour) {
  const P &end = line.back(), way = (end - line[line.size() - 2]).normalized(), aside(-way.y(), way.x());
  for (std::size_t i = 1; i < line.size(); ++i) canvas.Bar(line[i - 1], line[i], width, colour);
  for (std::size_t i = 1; i + 1 < line.size(); ++i) canvas.Disc(line[i], 0.5 * width, colour);
  canvas.Fill(Polyline{end + 2.0 * width * way, end + 1.5 * width * aside - 0.2 * width * way,
                       end - 1.5 * width * aside - 0.2 * width * way},
              colour);
}

// A car from behind.
void Car(Canvas& canvas, const P& at, double size, Colour colour) {
  const auto box = [&](double x0, double y0, double x1, double y1, double slant) {
    canvas.Fill(Polyline{at + size * P(x0, y0), at + size * P(x1, y0), at + size * P(x1 - slant, y1),
                         at + size * P(x0 + slant, y1)},
                colour);
  };
  box(-1.0, -0.45, 1.0, 0.2, 0.05);
  box(-0.85, 0.2, 0.85, 0.85, 0.25);
  canvas.Fill(Polyline{at + size * P(-0.62, 0.27), at + size * P(0.62, 0.27), at + size * P(0.5, 0.68),
                       at + size * P(-0.5, 0.68)},
              kWhite);
  box(-0.9, -0.85, -0.5, -0.4, 0.0);
  box(0.5, -0.85, 0.9, -0.4, 0.0);
}

void Stripes(Canvas& canvas) {  // the end of what is forbidden
  const P way(std::sqrt(0.5), std::sqrt(0.5)), aside(-way.y(), way.x());
  for (const double off : {-0.2, -0.1, 0.0, 0.1, 0.2})
    canvas.Bar(off * aside - 0.9 * way, off * aside + 0.9 * way, 0.045, kBlack);
}

void Bend(Canvas& canvas, bool left, bool twice) {
  const double side = left ? -1.0 : 1.0;
  if (twice) {
    Arrow(canvas,
          {P(side * -0.12, -0.72), P(side * -0.12, -0.5), P(side * 0.16, -0.25), P(side * -0.12, -0.02),
           P(side * -0.12, 0.06)},
          0.13, kBlack);
    return;
  }
  Arrow(canvas, {P(side * -0.14, -0.72), P(side * -0.14, -0.3), P(side * -0.06, -0.16), P(side * 0.1, -0.06)}, 0.14,
        kBlack);
}

// The road falls from left to right, or rises.
void Slope(Canvas& canvas, bool down, const std::string& text) {
  const double side = down ? 1.0 : -1.0;
  canvas.Fill(Polyline{P(side * -0.38, -0.68), P(side * 0.5, -0.68), P(side * -0.38, -0.34)}, kBlack);
  if (!text.empty()) Letter(canvas, text + "%", {side * 0.04, -0.14}, 0.26, 0.5, kBlack);
}

void Motorway(Canvas& canvas) {
  for (const double side : {-1.0, 1.0})
    canvas.Fill(Polyline{P(side * 0.08, -0.7), P(side * 0.55, -0.7), P(side * 0.2, 0.55), P(side * 0.06, 0.55)},
                kWhite);
  canvas.Bar({-0.7, 0.16}, {0.7, 0.16}, 0.3, kBlue);
  canvas.Bar({-0.7, 0.16}, {0.7, 0.16}, 0.14, kWhite);
}

void Walker(Canvas& canvas) {
  canvas.Fill(Polyline{P(-0.78, -0.72), P(0.78, -0.72), P(0.0, 0.76)}, kWhite);
  canvas.Disc({0.05, 0.3}, 0.085, kBlack);
  canvas.Stroke(Polyline{P(0.03, 0.14), P(-0.02, -0.14)}, 0.13, kBlack);
  canvas.Stroke(Polyline{P(-0.02, -0.14), P(0.13, -0.32), P(0.16, -0.54)}, 0.08, kBlack);
  canvas.Stroke(Polyline{P(-0.02, -0.14), P(-0.1, -0.36), P(-0.22, -0.52)}, 0.08, kBlack);
  canvas.Stroke(Polyline{P(0.03, 0.12), P(0.18, -0.04)}, 0.06, kBlack);
  canvas.Stroke(Polyline{P(0.03, 0.12), P(-0.15, -0.02)}, 0.06, kBlack);
  for (const double x : {-0.42, -0.14, 0.14, 0.42}) canvas.Bar({x - 0.07, -0.64}, {x + 0.07, -0.64}, 0.08, kBlack);
}

// Signs of the United States that are round elsewhere.
void American(Canvas& canvas, const std::string& kind) {
  const double w = canvas.half_width();
  const auto box = [&](double border, Colour colour) {
    canvas.Fill(Polyline{P(border - w, border - 1.0), P(w - border, border - 1.0), P(w - border, 1.0 - border),
                         P(border - w, 1.0 - border)},
                colour);
  };
  const P middle(0.0, 0.0);
  box(0.0, kBlack);
  if (kind == "one_way_us") return Arrow(canvas, {P(-1.1, 0.0), P(0.5, 0.0)}, 0.36, kWhite);
  box(0.05, kWhite);
  if (kind == "no_entry_us") {
    canvas.Disc(middle, 0.86, kRed);
    return canvas.Bar({-0.62, 0.0}, {0.62, 0.0}, 0.26, kWhite);
  }
  if (kind == "prohibition_us") {
    canvas.Disc(middle, 0.82, kRed);
    canvas.Disc(middle, 0.64, kWhite);
    return canvas.Bar({-0.46, 0.46}, {0.46, -0.46}, 0.15, kRed);
  }
  const double side = kind == "keep_left_us" ? -1.0 : 1.0;  // around an island
  canvas.Fill(Polyline{P(side * -0.55, -0.75), P(side * -0.1, -0.75), P(side * -0.1, -0.1), P(side * -0.32, 0.25),
                       P(side * -0.55, -0.1)},
              kBlack);
  Arrow(canvas, {P(side * -0.35, 0.75), P(side * -0.35, 0.5), P(side * 0.3, -0.05), P(side * 0.3, -0.45)}, 0.15,
        kBlack);
}

}  // namespace

void DrawRound(Canvas& canvas, const std::string& kind, const std::string& text) {
  const P middle(0.0, 0.0);
  if (kind == "roundabout") {
    canvas.Disc(middle, 1.1, kWhite);
    canvas.Disc(middle, 0.95, kBlue);
    for (const double turn : {0.0, 120.0, 240.0}) Arrow(canvas, Arc(middle, 0.5, turn, turn + 70.0), 0.16, kWhite);
    return;
  }
  if (kind == "keep_right" || kind == "keep_left" || kind == "mandatory") {
    canvas.Disc(middle, 1.1, kWhite);
    canvas.Disc(middle, 0.95, kBlue);
    const double side = kind == "keep_left" ? -1.0 : 1.0;
    if (kind != "mandatory") Arrow(canvas, {P(side * -0.42, 0.42), P(side * 0.3, -0.3)}, 0.2, kWhite);
    return;
  }
  if (kind == "prohibition" || kind == "restriction") {
    canvas.Disc(middle, 1.1, kRed);
    canvas.Disc(middle, 0.76, kWhite);
    if (kind == "restriction") return Car(canvas, middle, 0.42, kBlack);
    return canvas.Bar({-0.52, 0.52}, {0.52, -0.52}, 0.16, kRed);
  }
  if (kind == "no_stopping" || kind == "no_waiting") {
    canvas.Disc(middle, 1.1, kRed);
    canvas.Disc(middle, 0.8, kBlue);
    canvas.Bar({-0.58, 0.58}, {0.58, -0.58}, 0.16, kRed);
    if (kind == "no_stopping") canvas.Bar({-0.58, -0.58}, {0.58, 0.58}, 0.16, kRed);
    return;
  }
  if (kind == "railroad") {
    canvas.Disc(middle, 1.1, kBlack);
    canvas.Disc(middle, 0.93, kYellow);
    for (const double side : {-1.0, 1.0}) {
      canvas.Bar({-0.62, side * -0.62}, {0.62, side * 0.62}, 0.14, kBlack);
      Letter(canvas, "R", {side * 0.56, 0.0}, 0.42, 0.6, kBlack);
    }
    return;
  }
  if (kind == "no_entry") {
    canvas.Disc(middle, 1.1, kWhite);
    canvas.Disc(middle, 0.95, kRed);
    return canvas.Bar({-0.68, 0.0}, {0.68, 0.0}, 0.3, kWhite);
  }
  const bool ends = kind.starts_with("end_of_");
  canvas.Disc(middle, 1.1, ends ? kWhite : kRed);
  if (ends) canvas.Disc(middle, 0.98, kBlack);
  canvas.Disc(middle, ends ? 0.94 : 0.76, kWhite);
  if (kind == "speed_limit" || kind == "end_of_speed_limit")
    Letter(canvas, text, middle, text.size() > 2 ? 0.66 : 0.8, 1.2, ends ? kGrey : kBlack);
  if (kind == "no_overtaking" || kind == "end_of_no_overtaking") {
    Car(canvas, {-0.35, 0.0}, 0.29, ends ? kGrey : kRed);
    Car(canvas, {0.35, 0.0}, 0.29, ends ? kGrey : kBlack);
  }
  if (ends) Stripes(canvas);
}

void DrawTriangle(Canvas& canvas, const std::string& kind, const std::string& text) {
  // The box is filled: the plate's own outline cuts it.
  const Polyline outer = {P(-1.0, -1.0), P(1.0, -1.0), P(0.0, 1.0)};
  const bool yellow = kind == "warning_yellow";
  canvas.Fill(Polyline{P(-1.0, -1.0), P(1.0, -1.0), P(1.0, 1.0), P(-1.0, 1.0)}, yellow ? kBlack : kRed);
  canvas.Fill(Smaller(outer, {0.0, -0.33}, yellow ? 0.82 : 0.68), yellow ? kYellow : kWhite);
  if (kind == "priority_to_the_right") {
    canvas.Bar({-0.34, -0.7}, {0.26, -0.02}, 0.13, kBlack);
    canvas.Bar({0.34, -0.7}, {-0.26, -0.02}, 0.13, kBlack);
  } else if (kind == "bend_left" || kind == "bend_right") {
    Bend(canvas, kind == "bend_left", false);
  } else if (kind == "bends_left_first" || kind == "bends_right_first") {
    Bend(canvas, kind == "bends_left_first", true);
  } else if (kind == "downhill" || kind == "uphill") {
    Slope(canvas, kind == "downhill", text);
  } else if (kind == "uneven_road") {
    canvas.Bar({-0.5, -0.62}, {0.5, -0.62}, 0.1, kBlack);
    for (const double x : {-0.22, 0.22}) {
      Polyline bump = Arc({x, -0.62}, 0.2, 0.0, 180.0);
      canvas.Fill(bump, kBlack);
    }
  } else if (kind == "slippery_road") {
    Car(canvas, {0.0, -0.16}, 0.22, kBlack);
    for (const double x : {-0.16, 0.16})
      canvas.Stroke(Polyline{P(x, -0.4), P(x - 0.1, -0.47), P(x + 0.1, -0.58), P(x, -0.66)}, 0.06, kBlack);
  } else if (kind == "priority") {
    canvas.Bar({-0.3, -0.42}, {0.3, -0.42}, 0.1, kBlack);
    Arrow(canvas, {P(0.0, -0.76), P(0.0, -0.12)}, 0.16, kBlack);
  } else {
    canvas.Fill(Polyline{P(-0.06, -0.45), P(0.06, -0.45), P(0.1, 0.14), P(-0.1, 0.14)}, kBlack);
    canvas.Disc({0.0, -0.63}, 0.09, kBlack);
  }
}

void DrawRectangle(Canvas& canvas, const std::string& kind, const std::string& text) {
  const double w = canvas.half_width();
  const auto ground = [&](Colour edge, Colour inside, double border) {
    canvas.Fill(Polyline{P(-w, -1.0), P(w, -1.0), P(w, 1.0), P(-w, 1.0)}, edge);
    canvas.Fill(Polyline{P(border - w, border - 1.0), P(w - border, border - 1.0), P(w - border, 1.0 - border),
                         P(border - w, 1.0 - border)},
                inside);
  };
  if (kind == "town" || kind == "end_of_town") {
    ground(kBlack, kYellow, 0.06);
    Letter(canvas, text, {0.0, 0.0}, 0.62, 2.0 * w - 0.36, kBlack);
    if (kind == "end_of_town") canvas.Bar({-w, -1.0}, {w, 1.0}, 0.16, kRed);
    return;
  }
  if (kind.starts_with("chevron")) {
    const bool yellow = kind.starts_with("chevron_yellow");
    const Colour under = yellow                              ? kYellow
                         : kind.starts_with("chevron_black") ? kBlack
                         : kind.starts_with("chevron_blue")  ? kBlue
                                                             : kRed;
    ground(under, under, 0.0);
    const double side = kind.ends_with("_left") ? -1.0 : 1.0;
    for (const double x : {-0.75, 0.1}) {
      canvas.Fill(Polyline{P(side * x, -1.0), P(side * (x + 0.4), -1.0), P(side * (x + 0.85), 0.0),
                           P(side * (x + 0.4), 1.0), P(side * x, 1.0), P(side * (x + 0.45), 0.0)},
                  yellow ? kBlack : kWhite);
    }
    return;
  }
  if (kind == "speed_limit_us") {
    ground(kBlack, kWhite, 0.05);
    Letter(canvas, "SPEED", {0.0, 0.68}, 0.3, 1.6, kBlack);
    Letter(canvas, "LIMIT", {0.0, 0.28}, 0.3, 1.6, kBlack);
    return Letter(canvas, text, {0.0, -0.42}, 0.8, 1.6, kBlack);
  }
  if (kind.ends_with("_us")) return American(canvas, kind);
  if (kind == "one_way") {
    ground(kWhite, kBlue, 0.07);
    return Arrow(canvas, {P(-1.1, 0.0), P(0.6, 0.0)}, 0.3, kWhite);
  }
  if (kind == "guide_yellow") return ground(kBlack, kYellow, 0.06);
  if (kind == "guide_green") return ground(kWhite, kGreen, 0.07);
  if (kind == "guide_brown") return ground(kWhite, kBrown, 0.07);
  if (kind == "board_yellow") return ground(kBlack, kYellow, 0.03);
  if (kind == "board_orange") return ground(kBlack, kOrange, 0.05);
  if (kind == "board_school") return ground(kBlack, kLime, 0.05);
  if (kind == "board_red") return ground(kWhite, kRed, 0.05);
  if (kind == "beacon") {  // stripes that fall towards the road
    ground(kWhite, kWhite, 0.07);
    for (const double y : {-0.6, 0.0, 0.6}) canvas.Bar({-0.7, y - 0.2}, {0.7, y + 0.2}, 0.28, kRed);
    return;
  }
  if (kind.starts_with("exit_beacon")) {  // a stripe each 100 m to the exit
    ground(kWhite, kBlue, 0.07);
    const int stripes = kind == "exit_beacon" ? 3 : kind == "exit_beacon_two" ? 2 : 1;
    for (int k = 0; k < stripes; ++k) {
      const double y = 0.6 * k - 0.3 * (stripes - 1);
      canvas.Bar({-0.7, y - 0.2}, {0.7, y + 0.2}, 0.16, kWhite);
    }
    return;
  }
  if (kind == "board") return ground(kBlack, kWhite, 0.03);
  if (kind == "display") return ground(Colour::Of(0x3a3d40), Colour::Of(0x101112), 0.05);  // switched off
  if (kind == "plate") return ground(Colour::Of(0x85898b), Colour::Of(0xa4a7a8), 0.06);
  ground(kWhite, kBlue, 0.07);
  if (kind == "crossing") Walker(canvas);
  if (kind == "parking") Letter(canvas, "P", {0.0, 0.0}, 1.2, 1.6, kWhite);
  if (kind == "motorway" || kind == "end_of_motorway") Motorway(canvas);
  if (kind == "end_of_motorway") canvas.Bar({-0.95, -0.95}, {0.95, 0.95}, 0.16, kRed);
}

void DrawPointed(Canvas& canvas, const std::string& kind) {
  canvas.Fill(Polyline{P(-1.0, -1.0), P(1.0, -1.0), P(1.0, 1.0), P(-1.0, 1.0)}, kBlack);
  if (kind == "pennant")
    return canvas.Fill(Smaller({P(-1.0, -1.0), P(1.0, 0.0), P(-1.0, 1.0)}, {-0.38, 0.0}, 0.9), kYellow);
  canvas.Fill(Polyline{P(-0.94, -0.94), P(0.94, -0.94), P(0.94, -0.03), P(0.0, 0.91), P(-0.94, -0.03)}, kLime);
  for (const double x : {-0.3, 0.3}) {  // two walkers
    canvas.Disc({x, 0.22}, 0.11, kBlack);
    canvas.Stroke(Polyline{P(x, 0.02), P(x, -0.32)}, 0.18, kBlack);
    canvas.Stroke(Polyline{P(x, -0.32), P(x - 0.14, -0.72)}, 0.1, kBlack);
    canvas.Stroke(Polyline{P(x, -0.32), P(x + 0.14, -0.72)}, 0.1, kBlack);
  }
}

void DrawPriority(Canvas& canvas, const std::string& kind) {
  const P middle(0.0, 0.0);
  canvas.Fill(Polyline{P(-1.0, -1.0), P(1.0, -1.0), P(1.0, 1.0), P(-1.0, 1.0)}, kWhite);
  if (kind == "stop") {
    Polyline ring;
    for (int k = 0; k < 8; ++k) {
      const double angle = base::kPi * (k + 0.5) / 4.0;
      ring.push_back(0.93 / std::cos(base::kPi / 8.0) * P(std::cos(angle), std::sin(angle)));
    }
    canvas.Fill(ring, kRed);
    return Letter(canvas, "STOP", middle, 0.62, 1.5, kWhite);
  }
  if (kind == "give_way") {
    canvas.Fill(Polyline{P(-1.0, -1.0), P(1.0, -1.0), P(1.0, 1.0), P(-1.0, 1.0)}, kRed);
    return canvas.Fill(Smaller({P(-1.0, 1.0), P(0.0, -1.0), P(1.0, 1.0)}, {0.0, 0.33}, 0.68), kWhite);
  }
  canvas.Fill(Polyline{P(-0.95, 0.0), P(0.0, -0.95), P(0.95, 0.0), P(0.0, 0.95)}, kBlack);
  if (kind.starts_with("warning_")) {
    const Colour inside = kind == "warning_orange" ? kOrange : kind == "warning_school" ? kLime : kYellow;
    return canvas.Fill(Polyline{P(-0.89, 0.0), P(0.0, -0.89), P(0.89, 0.0), P(0.0, 0.89)}, inside);
  }
  canvas.Fill(Polyline{P(-0.91, 0.0), P(0.0, -0.91), P(0.91, 0.0), P(0.0, 0.91)}, kWhite);
  canvas.Fill(Polyline{P(-0.62, 0.0), P(0.0, -0.62), P(0.62, 0.0), P(0.0, 0.62)}, kYellow);
  if (kind == "end_of_priority_road") {
    const P way(std::sqrt(0.5), std::sqrt(0.5)), aside(-way.y(), way.x());
    for (const double off : {-0.12, -0.04, 0.04, 0.12})
      canvas.Bar(off * aside - 0.63 * way, off * aside + 0.63 * way, 0.035, kBlack);
  }
}

}  // namespace rodeira::scene
