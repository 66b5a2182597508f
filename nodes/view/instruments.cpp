#include "nodes/view/instruments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rodeira::view {
namespace {

constexpr float kPanelWidth_px = 236.0F;
constexpr float kPanelHeight_px = 92.0F;
constexpr float kMargin_px = 18.0F;
constexpr float kAbout_px = 20.0F, kAboutWidth_px = 448.0F;
const osg::Vec4 kBehind(0.04F, 0.05F, 0.07F, 0.55F);

std::string GearName(std::int32_t gear) { return gear < 0 ? "R" : gear == 0 ? "N" : fmt::format("{}", gear); }

}  // namespace

Instruments::Instruments(osg::Group& overlay) : panel_(overlay, kBehind), about_box_(overlay, kBehind) {
  about_ = AddText(overlay, kAbout_px, osgText::TextBase::LEFT_TOP);
  speed_ = AddText(overlay, 54.0F, osgText::TextBase::RIGHT_BASE_LINE);
  unit_ = AddText(overlay, 20.0F, osgText::TextBase::LEFT_BASE_LINE);
  gear_ = AddText(overlay, 38.0F, osgText::TextBase::RIGHT_BASE_LINE);
  time_ = AddText(overlay, 20.0F, osgText::TextBase::RIGHT_BASE_LINE);
  lines_ = AddText(overlay, 20.0F, osgText::TextBase::LEFT_TOP);
  lines_->setBackdropType(osgText::Text::DROP_SHADOW_BOTTOM_RIGHT);  // it has no box behind it
  lines_->setBackdropOffset(0.05F);
  lines_->setBackdropColor({0.0F, 0.0F, 0.0F, 0.8F});
}

void Instruments::Show(const Picture& picture, int width_px, int height_px, float low_px) {
  const std::size_t cars = picture.moment.cars.size();
  const bool is_car = picture.followed < cars;
  const bool show = picture.show_instruments && picture.followed < cars + picture.moment.agents.size();
  for (osgText::Text* text : {speed_.get(), unit_.get(), gear_.get(), time_.get()}) text->setNodeMask(show ? ~0U : 0U);
  lines_->setNodeMask(picture.text.empty() ? 0U : ~0U);
  lines_->setText(picture.text);
  lines_->setPosition({kMargin_px, static_cast<float>(height_px) - kMargin_px, 0.0F});
  about_->setNodeMask(picture.panel.empty() ? 0U : ~0U);
  about_->setText(picture.panel, osgText::String::ENCODING_UTF8);
  const auto rows = static_cast<float>(1 + std::count(picture.panel.begin(), picture.panel.end(), '\n'));
  const float about_high = low_px + 2.0F * kMargin_px + 1.12F * kAbout_px * rows;
  about_->setPosition({2.0F * kMargin_px, about_high - 0.6F * kMargin_px, 0.0F});
  if (picture.panel.empty()) about_box_.Set({});
  else about_box_.Set({{kMargin_px, low_px + kMargin_px, kMargin_px + kAboutWidth_px, about_high}});
  if (!show) return panel_.Set({});

  const float left = static_cast<float>(width_px) - kMargin_px - kPanelWidth_px, low = low_px + kMargin_px;
  const float right = left + kPanelWidth_px, high = low + kPanelHeight_px;
  panel_.Set({{left, low, right, high}});
  const double speed_mps = is_car ? picture.moment.cars[picture.followed].speed_mps : picture.moment.agents[picture.followed - cars].speed_mps;
  speed_->setText(fmt::format("{:.0f}", std::fabs(speed_mps) * 3.6));
  speed_->setPosition({left + 112.0F, low + 40.0F, 0.0F});
  unit_->setText("km/h");
  unit_->setPosition({left + 120.0F, low + 40.0F, 0.0F});
  gear_->setText(is_car ? GearName(picture.moment.cars[picture.followed].gear) : "");  // the traffic's is not published
  gear_->setPosition({right - 14.0F, low + 44.0F, 0.0F});
  time_->setText(fmt::format("{:.2f} s", static_cast<double>(picture.moment.time_ns) * 1e-9));
  time_->setPosition({right - 14.0F, low + 12.0F, 0.0F});
}

}  // namespace rodeira::view
