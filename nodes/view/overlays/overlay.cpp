// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/overlays/overlay.hpp"

#include <osg/BlendFunc>
#include <osg/observer_ptr>
#include <osgText/Font>

#include <algorithm>
#include <string>

#include "common/core/base/font_file.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kTextLayer = 10;
constexpr float kPanels = 720.0F, kNarrowest = 4.0F / 3.0F, kMinScale = 0.5F;

// One for all texts that there are. It goes with the last of them, as its letters belong to an OpenGL context.
osg::ref_ptr<osgText::Font> Typeface() {
  static osg::observer_ptr<osgText::Font> shared;
  osg::ref_ptr<osgText::Font> font;
  if (shared.lock(font)) return font;
  const std::filesystem::path file = base::FontFile();
  if (!file.empty()) font = osgText::readRefFontFile(file.string());
  shared = font;
  return font;
}

// Letters get their places in the font's picture as they are needed; where a letter lies there shows in the last bit of
// its pixels. So all get theirs beforehand, in one order, whatever is written first.
void GiveLettersTheirPlaces(osgText::Text& text) {
  std::string all;
  for (char c = ' '; c <= '~'; ++c) all.push_back(c);
  text.setText(all + "×·°µ−", osgText::String::ENCODING_UTF8);
  text.setText("");
}

}  // namespace

osg::ref_ptr<osg::Camera> MakeOverlay() {
  osg::ref_ptr<osg::Camera> overlay = new osg::Camera;
  overlay->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  overlay->setRenderOrder(osg::Camera::POST_RENDER);
  overlay->setClearMask(GL_DEPTH_BUFFER_BIT);
  overlay->setAllowEventFocus(false);
  overlay->setViewMatrix(osg::Matrix::identity());
  overlay->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
  osg::StateSet* state = overlay->getOrCreateStateSet();
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  state->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
  state->setMode(GL_BLEND, osg::StateAttribute::ON);
  state->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
  return overlay;
}

void FitOverlay(osg::Camera& overlay, int width_px, int height_px) {
  overlay.setViewport(0, 0, width_px, height_px);
  overlay.setProjectionMatrix(osg::Matrix::ortho2D(0.0, width_px, 0.0, height_px));
}

PanelSize PanelsOf(int width_px, int height_px) {
  const auto width = static_cast<float>(width_px), height = static_cast<float>(height_px);
  const float scale = std::max(kMinScale, std::min(height, width / kNarrowest) / kPanels);
  return {scale, width / scale, height / scale};
}

osg::ref_ptr<osgText::Text> AddText(osg::Group& overlay, float size_px, osgText::TextBase::AlignmentType alignment) {
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  text->setDataVariance(osg::Object::DYNAMIC);
  if (const osg::ref_ptr<osgText::Font> font = Typeface()) text->setFont(font);
  text->setCharacterSize(size_px);
  GiveLettersTheirPlaces(*text);
  text->setAlignment(alignment);
  text->setColor({0.96F, 0.97F, 0.98F, 1.0F});
  text->setCullingActive(false);
  text->getOrCreateStateSet()->setRenderBinDetails(kTextLayer, "RenderBin");
  overlay.addChild(text);
  return text;
}

Boxes::Boxes(osg::Group& overlay, const osg::Vec4& colour, int layer)
    : corners_(new osg::Vec3Array), triangles_(new osg::DrawArrays(GL_TRIANGLES, 0, 0)), geometry_(new osg::Geometry) {
  geometry_->setUseDisplayList(false);
  geometry_->setUseVertexBufferObjects(true);
  geometry_->setDataVariance(osg::Object::DYNAMIC);
  geometry_->setVertexArray(corners_);
  osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array;
  colours->push_back(colour);
  geometry_->setColorArray(colours, osg::Array::BIND_OVERALL);
  geometry_->addPrimitiveSet(triangles_);
  geometry_->setCullingActive(false);
  geometry_->getOrCreateStateSet()->setRenderBinDetails(layer, "RenderBin");
  geometry_->setNodeMask(0U);
  overlay.addChild(geometry_);
}

void Boxes::Set(const std::vector<Box>& boxes) {
  geometry_->setNodeMask(boxes.empty() ? 0U : ~0U);
  if (boxes.empty()) return;
  corners_->clear();
  for (const Box& box : boxes) {
    const osg::Vec3 corners[] = {
        {box.left, box.low, 0.0F}, {box.right, box.low, 0.0F}, {box.right, box.high, 0.0F}, {box.left, box.high, 0.0F}};
    for (const int corner : {0, 1, 2, 0, 2, 3}) corners_->push_back(corners[corner]);
  }
  corners_->dirty();
  triangles_->setCount(static_cast<GLsizei>(corners_->size()));
  triangles_->dirty();
}

}  // namespace rodeira::nodes
