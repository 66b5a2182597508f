#include "nodes/view/heat_node.hpp"

#include <fmt/format.h>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/PolygonOffset>

namespace rodeira::view {
namespace {

constexpr int kBin = 3;          // behind the sky, with the shadows
constexpr float kLeft_px = 18.0F, kWidth_px = 380.0F, kBarHeight_px = 14.0F, kText_px = 17.0F, kHeight_px = 72.0F, kGap_px = 10.0F;
constexpr float kFromTop_px = 120.0F;  // below the lines of help and notes

osg::Vec4 Of(scene::Colour colour, float share) {
  return {static_cast<float>(colour.red) / 255.0F, static_cast<float>(colour.green) / 255.0F, static_cast<float>(colour.blue) / 255.0F, share};
}

}  // namespace

HeatNode::HeatNode(osg::Group& overlay) : place_(new osg::MatrixTransform), squares_(new osg::Geometry), ground_(overlay, {0.04F, 0.05F, 0.07F, 0.55F}) {
  squares_->setUseDisplayList(false);
  squares_->setUseVertexBufferObjects(true);
  squares_->setDataVariance(osg::Object::DYNAMIC);
  osg::StateSet* state = squares_->getOrCreateStateSet();
  state->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
  state->setAttributeAndModes(new osg::PolygonOffset(-3.0F, -16.0F));
  state->setMode(GL_POLYGON_OFFSET_FILL, osg::StateAttribute::ON);
  state->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
  state->setRenderBinDetails(kBin, "RenderBin");
  place_->addChild(squares_);
  for (std::size_t i = 0; i < kSteps; ++i) {
    bar_[i] = std::make_unique<Boxes>(overlay, Of(scene::HeatColour((static_cast<double>(i) + 0.5) / kSteps), 1.0F), 1);
  }
  title_ = AddText(overlay, kText_px, osgText::TextBase::LEFT_BASE_LINE);
  low_ = AddText(overlay, kText_px, osgText::TextBase::LEFT_BASE_LINE);
  middle_ = AddText(overlay, kText_px, osgText::TextBase::CENTER_BASE_LINE);
  high_ = AddText(overlay, kText_px, osgText::TextBase::RIGHT_BASE_LINE);
}

void HeatNode::Show(const std::shared_ptr<const HeatPicture>& heat, int height_px) {
  place_->setNodeMask(heat != nullptr && !heat->squares.empty() ? ~0U : 0U);
  if (heat != nullptr && heat != laid_) Lay(*heat);
  laid_ = heat;
  ShowLegend(heat.get(), static_cast<float>(height_px) - kFromTop_px);
}

void HeatNode::Lay(const HeatPicture& heat) {
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array;
  const Eigen::Vector3d origin = heat.squares.empty() ? Eigen::Vector3d::Zero().eval() : heat.squares.front().corners_W[0];
  for (const scene::HeatSquare& square : heat.squares) {
    for (const Eigen::Vector3d& corner : square.corners_W) {
      const Eigen::Vector3f near = (corner - origin).cast<float>();
      corners->push_back({near.x(), near.y(), near.z()});
      colours->push_back(Of(square.colour, static_cast<float>(scene::kHeatShare)));
    }
  }
  place_->setMatrix(osg::Matrixd::translate(origin.x(), origin.y(), origin.z()));
  squares_->setVertexArray(corners);
  squares_->setColorArray(colours, osg::Array::BIND_PER_VERTEX);
  squares_->removePrimitiveSet(0, squares_->getNumPrimitiveSets());
  squares_->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, static_cast<GLsizei>(corners->size())));
  squares_->dirtyBound();
}

void HeatNode::ShowLegend(const HeatPicture* heat, float high_px) {
  for (osgText::Text* text : {title_.get(), low_.get(), middle_.get(), high_.get()}) text->setNodeMask(heat != nullptr ? ~0U : 0U);
  if (heat == nullptr) {
    ground_.Set({});
    for (auto& step : bar_) step->Set({});
    return;
  }
  const scene::HeatScale& scale = scene::ScaleOf(heat->kind);
  const float low = high_px - kHeight_px, left = kLeft_px + kGap_px, width = kWidth_px - 2.0F * kGap_px, bar = low + 28.0F;
  ground_.Set({{kLeft_px, low, kLeft_px + kWidth_px, high_px}});
  for (std::size_t i = 0; i < kSteps; ++i) {
    const float part = width / static_cast<float>(kSteps);
    bar_[i]->Set({{left + part * static_cast<float>(i), bar, left + part * static_cast<float>(i + 1), bar + kBarHeight_px}});
  }
  title_->setText(fmt::format("{}, {}, of {:.0f} s", scale.name, scale.unit, heat->watched_s));
  title_->setPosition({left, bar + kBarHeight_px + 9.0F, 0.0F});
  low_->setText(fmt::format("{:g}", scale.red));
  low_->setPosition({left, low + 8.0F, 0.0F});
  middle_->setText(fmt::format("{:g}", 0.5 * (scale.red + scale.green)));
  middle_->setPosition({left + 0.5F * width, low + 8.0F, 0.0F});
  high_->setText(fmt::format("{:g}", scale.green));
  high_->setPosition({left + width, low + 8.0F, 0.0F});
}

}  // namespace rodeira::view
