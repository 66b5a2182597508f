// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/overlays/heat_node.hpp"

#include <fmt/format.h>
#include <osg/Image>
#include <osg/Uniform>

#include <cstring>

namespace rodeira::nodes {
namespace {

constexpr unsigned kUnit = 4;  // of textures; noise, faces and the sun's maps have those before it
// In the panels' units.
constexpr float kLeft = 18.0F, kWidth = 380.0F, kBarHeight = 14.0F, kLegendText = 17.0F, kHeight = 72.0F, kGap = 10.0F;
constexpr float kFromTop = 120.0F;  // below the lines of help and notes

osg::Vec4 ToVec4(scene::Colour colour, float share) {
  return {static_cast<float>(colour.red) / 255.0F, static_cast<float>(colour.green) / 255.0F,
          static_cast<float>(colour.blue) / 255.0F, share};
}

osg::ref_ptr<osg::Texture2D> MakeSquares() {
  osg::ref_ptr<osg::Texture2D> squares = new osg::Texture2D;
  squares->setDataVariance(osg::Object::DYNAMIC);
  squares->setResizeNonPowerOfTwoHint(false);
  squares->setInternalFormat(GL_RGBA16);
  squares->setFilter(
      osg::Texture::MIN_FILTER,
      osg::Texture::NEAREST);  // a square may be of another surface than its neighbours: the shader decides
  squares->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  squares->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_BORDER);
  squares->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_BORDER);
  squares->setBorderColor({0.0, 0.0, 0.0, 0.0});
  return squares;
}

}  // namespace

HeatLegend LegendOf(const HeatPicture& heat) {
  const scene::HeatScale& scale = scene::ScaleOf(heat.kind);
  return {fmt::format("{}, {}, of {:.0f} s", scale.name, scale.unit, heat.watched_s), fmt::format("{:g}", scale.red),
          fmt::format("{:g}", 0.5 * (scale.red + scale.green)), fmt::format("{:g}", scale.green)};
}

HeatNode::HeatNode(osg::Group& overlay, osg::StateSet& state)
    : squares_(MakeSquares()), ground_(overlay, {0.04F, 0.05F, 0.07F, 0.55F}) {
  state.addUniform(new osg::Uniform("heat_map", static_cast<int>(kUnit)));
  for (std::size_t i = 0; i < kSteps; ++i) {
    bar_[i] =
        std::make_unique<Boxes>(overlay, ToVec4(scene::HeatColour((static_cast<double>(i) + 0.5) / kSteps), 1.0F), 1);
  }
  title_ = AddText(overlay, kLegendText, osgText::TextBase::LEFT_BASE_LINE);
  low_ = AddText(overlay, kLegendText, osgText::TextBase::LEFT_BASE_LINE);
  middle_ = AddText(overlay, kLegendText, osgText::TextBase::CENTER_BASE_LINE);
  high_ = AddText(overlay, kLegendText, osgText::TextBase::RIGHT_BASE_LINE);
}

void HeatNode::Show(osg::StateSet& state, const std::shared_ptr<const HeatPicture>& heat, const PanelSize& size) {
  const bool shown = heat != nullptr && heat->raster.columns > 0;
  if (shown && heat != laid_) Lay(state, heat->raster);
  laid_ = heat;
  if (shown) {
    state.setDefine("HEAT");
    state.setTextureAttribute(kUnit, squares_);
  } else {
    state.removeDefine("HEAT");
    state.removeTextureAttribute(kUnit, squares_.get());
  }
  ShowLegend(heat.get(), size.height - kFromTop);
}

void HeatNode::Lay(osg::StateSet& state, const scene::HeatRaster& raster) {
  const auto columns = static_cast<int>(raster.columns), rows = static_cast<int>(raster.rows);
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(columns, rows, 1, GL_RGBA, GL_UNSIGNED_SHORT);
  std::memcpy(image->data(), raster.texels.data(), raster.texels.size() * sizeof(raster.texels[0]));
  image->setInternalTextureFormat(GL_RGBA16);
  squares_->setImage(image);
  squares_->setTextureSize(columns, rows);
  squares_->dirtyTextureObject();
  const double square_m = scene::HeatMap::kSquare_m;
  world_to_squares_ = osg::Matrixd::translate(-raster.west_m, -raster.south_m, -raster.lowest_m) *
                      osg::Matrixd::scale(1.0 / square_m, 1.0 / square_m, 1.0);
  state.getOrCreateUniform("heat_size", osg::Uniform::FLOAT_VEC3)
      ->set(osg::Vec3f(static_cast<float>(columns), static_cast<float>(rows), static_cast<float>(raster.range_m)));
}

void HeatNode::SetEye(osg::StateSet& state, const osg::Matrixd& view) const {
  state.getOrCreateUniform("eye_to_heat", osg::Uniform::FLOAT_MAT4)
      ->set(osg::Matrixd::inverse(view) * world_to_squares_);
}

void HeatNode::ShowLegend(const HeatPicture* heat, float high) {
  for (osgText::Text* text : {title_.get(), low_.get(), middle_.get(), high_.get()})
    text->setNodeMask(heat != nullptr ? ~0U : 0U);
  if (heat == nullptr) {
    ground_.Set({});
    for (auto& step : bar_) step->Set({});
    return;
  }
  const HeatLegend legend = LegendOf(*heat);
  const float low = high - kHeight, left = kLeft + kGap, width = kWidth - 2.0F * kGap, bar = low + 28.0F;
  ground_.Set({{kLeft, low, kLeft + kWidth, high}});
  for (std::size_t i = 0; i < kSteps; ++i) {
    const float part = width / static_cast<float>(kSteps);
    bar_[i]->Set(
        {{left + part * static_cast<float>(i), bar, left + part * static_cast<float>(i + 1), bar + kBarHeight}});
  }
  title_->setText(legend.title);
  title_->setPosition({left, bar + kBarHeight + 9.0F, 0.0F});
  low_->setText(legend.low);
  low_->setPosition({left, low + 8.0F, 0.0F});
  middle_->setText(legend.middle);
  middle_->setPosition({left + 0.5F * width, low + 8.0F, 0.0F});
  high_->setText(legend.high);
  high_->setPosition({left + width, low + 8.0F, 0.0F});
}

}  // namespace rodeira::nodes
