// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/overlays/instruments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "nodes/view/overlays/gear_name.hpp"

namespace rodeira::nodes {
namespace {

// In the panels' units.
constexpr float kPanelWidth = 236.0F, kPanelHeight = 92.0F;
constexpr float kMargin = 18.0F, kWithin = 10.0F;
constexpr float kAbout = 20.0F, kAboutWidth = 448.0F, kRow = 1.12F;
const osg::Vec4 kBehind(0.04F, 0.05F, 0.07F, 0.55F);

}  // namespace

Instruments::Instruments(osg::Group& overlay)
    : panel_(overlay, kBehind), about_box_(overlay, kBehind), lines_box_(overlay, kBehind) {
  about_ = AddText(overlay, kAbout, osgText::TextBase::LEFT_TOP);
  speed_ = AddText(overlay, 54.0F, osgText::TextBase::RIGHT_BASE_LINE);
  unit_ = AddText(overlay, 20.0F, osgText::TextBase::LEFT_BASE_LINE);
  gear_ = AddText(overlay, 38.0F, osgText::TextBase::RIGHT_BASE_LINE);
  time_ = AddText(overlay, 20.0F, osgText::TextBase::RIGHT_BASE_LINE);
  lines_ = AddText(overlay, 20.0F, osgText::TextBase::LEFT_TOP);
}

void Instruments::ShowLines(const std::string& lines, float high) {
  lines_->setNodeMask(lines.empty() ? 0U : ~0U);
  lines_->setText(lines, osgText::String::ENCODING_UTF8);
  lines_->setPosition({kMargin + kWithin, high - kMargin - kWithin, 0.0F});
  if (lines.empty()) return lines_box_.Set({});
  const osg::BoundingBox text = lines_->getBoundingBox();
  lines_box_.Set({{kMargin, text.yMin() - kWithin, text.xMax() + kWithin, high - kMargin}});
}

void Instruments::ShowAbout(const std::string& about, float low) {
  about_->setNodeMask(about.empty() ? 0U : ~0U);
  about_->setText(about, osgText::String::ENCODING_UTF8);
  const auto rows = static_cast<float>(1 + std::count(about.begin(), about.end(), '\n'));
  const float high = low + 2.0F * kMargin + kRow * kAbout * rows;
  about_->setPosition({2.0F * kMargin, high - 0.6F * kMargin, 0.0F});
  if (about.empty())
    about_box_.Set({});
  else
    about_box_.Set({{kMargin, low + kMargin, kMargin + kAboutWidth, high}});
}

void Instruments::Show(const Picture& picture, const PanelSize& size, float low) {
  const scene::SceneSnapshot& moment = picture.moment;
  const std::size_t cars = moment.cars.size();
  const bool is_car = picture.followed < cars;
  const bool show = picture.show_instruments && picture.followed < cars + moment.agents.size();
  for (osgText::Text* text : {speed_.get(), unit_.get(), gear_.get(), time_.get()}) text->setNodeMask(show ? ~0U : 0U);
  ShowLines(picture.text, size.height);
  ShowAbout(picture.panel, low);
  if (!show) return panel_.Set({});

  const float left = size.width - kMargin - kPanelWidth, right = left + kPanelWidth;
  low += kMargin;
  panel_.Set({{left, low, right, low + kPanelHeight}});
  const scene::AgentPose* agent = is_car ? nullptr : &moment.agents[picture.followed - cars];
  speed_->setText(
      fmt::format("{:.0f}", std::fabs(is_car ? moment.cars[picture.followed].speed_mps : agent->speed_mps) * 3.6));
  speed_->setPosition({left + 112.0F, low + 40.0F, 0.0F});
  unit_->setText("km/h");
  unit_->setPosition({left + 120.0F, low + 40.0F, 0.0F});
  gear_->setText(is_car          ? GearName(moment.cars[picture.followed].gear)
                 : agent->detail ? GearName(agent->detail->gear)
                                 : "");  // of a pedestrian nothing is said
  gear_->setPosition({right - 14.0F, low + 44.0F, 0.0F});
  time_->setText(fmt::format("{:.2f} s", static_cast<double>(moment.time_ns) * 1e-9));
  time_->setPosition({right - 14.0F, low + 12.0F, 0.0F});
}

}  // namespace rodeira::nodes
