// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/renderer/sun_shadow.hpp"

#include <osg/CullFace>
#include <osg/PolygonOffset>

#include "nodes/view/materials/material_library.hpp"
#include "nodes/view/materials/to_osg.hpp"
#include "nodes/view/shaders/shaders.hpp"

namespace rodeira::nodes {
namespace {

constexpr unsigned kNearUnit = 2, kWideUnit = 3;  // of textures; noise and faces have those before them
constexpr float kNearOffset = 1.5F,
                kWideOffset = 2.0F;  // in the maps' depths, by how steeply the sun falls on what throws
constexpr double kWideBefore_m =
    0.5;  // towards the sun, of what asks the wide map: the ground there is not seen so exactly
constexpr float kMinLight = 0.03F;   // of the sun, below which its shadows are not seen
constexpr float kMinHeight = 0.04F;  // of the sun's direction: 2 degrees

osg::ref_ptr<osg::Texture2D> MakeMap(int side_px) {
  osg::ref_ptr<osg::Texture2D> map = new osg::Texture2D;
  map->setTextureSize(side_px, side_px);
  map->setInternalFormat(GL_DEPTH_COMPONENT24);
  map->setSourceFormat(GL_DEPTH_COMPONENT);
  map->setSourceType(GL_UNSIGNED_INT);
  map->setShadowComparison(true);
  map->setShadowTextureMode(osg::Texture::LUMINANCE);
  map->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  map->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  map->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_BORDER);
  map->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_BORDER);
  map->setBorderColor({1.0, 1.0, 1.0, 1.0});  // beyond it nothing is in shadow
  return map;
}

osg::ref_ptr<osg::Camera> MakeCamera(osg::Texture2D& map, int side_px, unsigned thrown, float offset) {
  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT);  // levels of detail as in the picture
  camera->setRenderOrder(osg::Camera::PRE_RENDER, -1);                       // before mirrors, which show shadows too
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->setImplicitBufferAttachmentMask(0, 0);
  camera->attach(osg::Camera::DEPTH_BUFFER, &map);
  camera->setClearMask(GL_DEPTH_BUFFER_BIT);
  camera->setViewport(0, 0, side_px, side_px);
  camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
  camera->setCullMask(thrown);
  const auto mine = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
  osg::StateSet* state = camera->getOrCreateStateSet();
  state->setAttributeAndModes(ProgramOf(DepthVertexShader(), DepthFragmentShader()), mine);
  state->setAttributeAndModes(new osg::PolygonOffset(offset, 4.0F), mine);
  state->setMode(GL_POLYGON_OFFSET_FILL, mine);
  state->setMode(GL_CULL_FACE, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
  return camera;
}

void Aim(osg::Camera& camera, const scene::SunView& sun) {
  const double half_m = 0.5 * sun.side_m;
  camera.setViewMatrixAsLookAt(ToOsg(sun.middle_W), ToOsg(sun.middle_W + sun.forward_W), ToOsg(sun.up_W));
  camera.setProjectionMatrixAsOrtho(-half_m, half_m, -half_m, half_m, -sun.depth_m, sun.depth_m);
}

}  // namespace

SunShadow::SunShadow(osg::Group& root, osg::Group& scene, const QualityTraits& traits) : traits_(traits) {
  if (traits.shadow_px == 0) return;
  osg::StateSet& state = *root.getOrCreateStateSet();
  const auto add = [&](const char* name, unsigned unit, int side_px, unsigned thrown, float offset) {
    const osg::ref_ptr<osg::Texture2D> map = MakeMap(side_px);
    const osg::ref_ptr<osg::Camera> camera = MakeCamera(*map, side_px, thrown, offset);
    camera->addChild(&scene);
    root.addChild(camera);
    state.setTextureAttribute(unit, map);
    state.addUniform(new osg::Uniform(name, static_cast<int>(unit)));
    return camera;
  };
  near_ = add("sun_map", kNearUnit, traits.shadow_px, kThrowsShadow | kGroundThrowsShadow, kNearOffset);
  wide_ = add("wide_sun_map", kWideUnit, traits.ground_shadow_px, kGroundThrowsShadow, kWideOffset);
  state.addUniform(new osg::Uniform("sun_map_texel", traits.soft_px / static_cast<float>(traits.shadow_px)));
  if (traits.soft_px > 0.0F) state.setDefine("SOFT_SHADOW");
}

void SunShadow::Show(osg::StateSet& state, const scene::Air& air, const Eigen::Vector3d& about_W) {
  if (!near_) return;
  const bool shines = air.sun_light.maxCoeff() > kMinLight && air.sun_W.z() > kMinHeight;
  for (osg::Camera* camera : {near_.get(), wide_.get()}) camera->setNodeMask(shines ? ~0U : 0U);
  if (!shines) return state.removeDefine("SUN_SHADOW");
  state.setDefine("SUN_SHADOW");
  const Eigen::Vector3d to_sun = air.sun_W.cast<double>();
  const scene::SunView sharp = scene::MakeSunView(to_sun, about_W, traits_.shadow_m, traits_.shadow_px);
  const scene::SunView wide = scene::MakeSunView(to_sun, about_W, traits_.ground_shadow_m, traits_.ground_shadow_px);
  Aim(*near_, sharp);
  Aim(*wide_, wide);
  const osg::Matrixd to_shares = osg::Matrixd::translate(1.0, 1.0, 1.0) * osg::Matrixd::scale(0.5, 0.5, 0.5);
  world_to_map_ = near_->getViewMatrix() * near_->getProjectionMatrix() * to_shares;
  // Both have the same axes: from the sharp map's places to the wide one's it is a scale and a way.
  const Eigen::Vector3d middle = wide.ToMap(sharp.middle_W);
  const double scale = sharp.side_m / wide.side_m, before = 0.5 * kWideBefore_m / wide.depth_m;
  state.getOrCreateUniform("to_wide", osg::Uniform::FLOAT_VEC4)
      ->set(osg::Vec4f(static_cast<float>(middle.x() - 0.5 * scale), static_cast<float>(middle.y() - 0.5 * scale),
                       static_cast<float>(middle.z() - 0.5 - before), static_cast<float>(scale)));
}

void SunShadow::SetEye(osg::StateSet& state, const osg::Matrixd& view) const {
  if (near_)
    state.getOrCreateUniform("eye_to_sun", osg::Uniform::FLOAT_MAT4)->set(osg::Matrixd::inverse(view) * world_to_map_);
}

}  // namespace rodeira::nodes
