#include "nodes/view/instruments.hpp"

#include <fmt/format.h>
#include <osg/BlendFunc>

#include <cmath>

namespace rodeira::view {
namespace {

constexpr float kPanelWidth_px = 236.0F;
constexpr float kPanelHeight_px = 92.0F;
constexpr float kMargin_px = 18.0F;

std::string GearName(std::int32_t gear) { return gear < 0 ? "R" : gear == 0 ? "N" : fmt::format("{}", gear); }

}  // namespace

Instruments::Instruments() : camera_(new osg::Camera), panel_(new osg::Vec3Array(4)), panel_geometry_(new osg::Geometry) {
  camera_->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  camera_->setRenderOrder(osg::Camera::POST_RENDER);
  camera_->setClearMask(GL_DEPTH_BUFFER_BIT);
  camera_->setAllowEventFocus(false);
  camera_->setViewMatrix(osg::Matrix::identity());
  camera_->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
  osg::StateSet* state = camera_->getOrCreateStateSet();
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  state->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
  state->setMode(GL_BLEND, osg::StateAttribute::ON);
  state->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));

  panel_geometry_->setUseDisplayList(false);
  panel_geometry_->setUseVertexBufferObjects(true);
  panel_geometry_->setDataVariance(osg::Object::DYNAMIC);
  panel_geometry_->setVertexArray(panel_);
  osg::ref_ptr<osg::Vec4Array> dark = new osg::Vec4Array;
  dark->push_back({0.04F, 0.05F, 0.07F, 0.55F});
  panel_geometry_->setColorArray(dark, osg::Array::BIND_OVERALL);
  panel_geometry_->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4));
  panel_geometry_->setCullingActive(false);
  panel_geometry_->getOrCreateStateSet()->setRenderBinDetails(0, "RenderBin");
  camera_->addChild(panel_geometry_);

  speed_ = AddText(54.0F, osgText::TextBase::RIGHT_BASE_LINE);
  unit_ = AddText(20.0F, osgText::TextBase::LEFT_BASE_LINE);
  gear_ = AddText(38.0F, osgText::TextBase::RIGHT_BASE_LINE);
  time_ = AddText(20.0F, osgText::TextBase::RIGHT_BASE_LINE);
  lines_ = AddText(20.0F, osgText::TextBase::LEFT_TOP);
  lines_->setBackdropType(osgText::Text::DROP_SHADOW_BOTTOM_RIGHT);  // it has no panel behind it
  lines_->setBackdropOffset(0.05F);
  lines_->setBackdropColor({0.0F, 0.0F, 0.0F, 0.8F});
}

osg::ref_ptr<osgText::Text> Instruments::AddText(float size_px, osgText::TextBase::AlignmentType alignment) {
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  text->setDataVariance(osg::Object::DYNAMIC);
  text->setCharacterSize(size_px);
  text->setAlignment(alignment);
  text->setColor({0.96F, 0.97F, 0.98F, 1.0F});
  text->setCullingActive(false);
  text->getOrCreateStateSet()->setRenderBinDetails(1, "RenderBin");
  camera_->addChild(text);
  return text;
}

void Instruments::Show(const Picture& picture, int width_px, int height_px) {
  camera_->setViewport(0, 0, width_px, height_px);
  camera_->setProjectionMatrix(osg::Matrix::ortho2D(0.0, width_px, 0.0, height_px));
  const bool show = picture.show_instruments && picture.followed < picture.moment.cars.size();
  const unsigned mask = show ? ~0U : 0U;
  for (osg::Node* node : {static_cast<osg::Node*>(panel_geometry_), static_cast<osg::Node*>(speed_), static_cast<osg::Node*>(unit_),
                          static_cast<osg::Node*>(gear_), static_cast<osg::Node*>(time_)}) {
    node->setNodeMask(mask);
  }
  lines_->setNodeMask(picture.text.empty() ? 0U : ~0U);
  lines_->setText(picture.text);
  lines_->setPosition({kMargin_px, static_cast<float>(height_px) - kMargin_px, 0.0F});
  if (!show) return;

  const float left = static_cast<float>(width_px) - kMargin_px - kPanelWidth_px, low = kMargin_px;
  const float right = left + kPanelWidth_px, high = low + kPanelHeight_px;
  (*panel_)[0].set(left, low, 0.0F);
  (*panel_)[1].set(right, low, 0.0F);
  (*panel_)[2].set(right, high, 0.0F);
  (*panel_)[3].set(left, high, 0.0F);
  panel_->dirty();
  const scene::CarPose& car = picture.moment.cars[picture.followed];
  speed_->setText(fmt::format("{:.0f}", std::fabs(car.speed_mps) * 3.6));
  speed_->setPosition({left + 112.0F, low + 40.0F, 0.0F});
  unit_->setText("km/h");
  unit_->setPosition({left + 120.0F, low + 40.0F, 0.0F});
  gear_->setText(GearName(car.gear));
  gear_->setPosition({right - 14.0F, low + 44.0F, 0.0F});
  time_->setText(fmt::format("{:.2f} s", static_cast<double>(picture.moment.time_ns) * 1e-9));
  time_->setPosition({right - 14.0F, low + 12.0F, 0.0F});
}

}  // namespace rodeira::view
