// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/renderer/mirrors.hpp"

#include <osg/StateSet>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>

#include "nodes/view/renderer/aim_camera.hpp"
#include "nodes/view/shaders/air_uniforms.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kMirrorFar_m = 1'500.0;
constexpr float kCoarser = 2.5F;                // levels of detail in a small picture
constexpr std::int64_t kNext_ns = 200'000'000;  // from a picture to the next one, at most
constexpr double kNext_m = 10.0;
constexpr float kFrame_px = 3.0F;
constexpr int kFrameLayer = 1, kGlassLayer = 2;

Boxes::Box PixelsOf(scene::Mirror mirror, const std::optional<scene::ScreenPlane>& screen, const scene::Body& body,
                    int width_px, int height_px) {
  const double aspect = static_cast<double>(width_px) / height_px;
  const scene::MirrorPlace place =
      screen ? scene::PlaceOn(*screen, body, mirror, aspect) : scene::PlaceOf(mirror, aspect);
  const auto px = [](double share, int size_px) { return static_cast<float>(std::round(share * size_px)); };
  return {px(place.left, width_px), px(place.low, height_px), px(place.right, width_px), px(place.high, height_px)};
}

}  // namespace

Mirrors::Mirrors(osg::Group& root, osg::Group& scene, osg::Group& overlay)
    : frames_(overlay, {0.02F, 0.02F, 0.025F, 1.0F}, kFrameLayer) {
  for (Glass& glass : glasses_) glass = MakeGlass(root, scene, overlay);
}

Mirrors::Glass Mirrors::MakeGlass(osg::Group& root, osg::Group& scene, osg::Group& overlay) {
  Glass glass;
  glass.texture = new osg::Texture2D;
  glass.texture->setInternalFormat(GL_RGB);
  glass.texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  glass.texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  glass.texture->setResizeNonPowerOfTwoHint(false);
  glass.camera = new osg::Camera;
  glass.camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  glass.camera->setRenderOrder(osg::Camera::PRE_RENDER);
  glass.camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  glass.camera->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glass.camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
  glass.camera->setLODScale(kCoarser);
  glass.camera->setNodeMask(0U);
  glass.camera->addChild(&scene);
  root.addChild(glass.camera);

  glass.pane = new osg::Geometry;
  glass.pane->setUseDisplayList(false);
  glass.pane->setUseVertexBufferObjects(true);
  glass.pane->setDataVariance(osg::Object::DYNAMIC);
  glass.pane->setVertexArray(new osg::Vec3Array(4));
  osg::ref_ptr<osg::Vec2Array> reversed = new osg::Vec2Array;
  for (const auto& [u, v] :
       {std::pair(1.0F, 0.0F), std::pair(0.0F, 0.0F), std::pair(0.0F, 1.0F), std::pair(1.0F, 1.0F)})
    reversed->push_back({u, v});
  glass.pane->setTexCoordArray(0, reversed);
  osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array;
  white->push_back({1.0F, 1.0F, 1.0F, 1.0F});
  glass.pane->setColorArray(white, osg::Array::BIND_OVERALL);
  glass.pane->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4));
  glass.pane->setCullingActive(false);
  glass.pane->setNodeMask(0U);
  osg::StateSet* state = glass.pane->getOrCreateStateSet();
  state->setTextureAttributeAndModes(0, glass.texture);
  state->setRenderBinDetails(kGlassLayer, "RenderBin");
  overlay.addChild(glass.pane);
  return glass;
}

// The picture in the glass has as many pixels as it is shown with.
void Mirrors::Fit(Glass& glass, const Boxes::Box& box) {
  glass.box = box;
  const int wide = static_cast<int>(box.right - box.left), high = static_cast<int>(box.high - box.low);
  glass.texture->setTextureSize(wide, high);
  glass.texture->dirtyTextureObject();
  glass.camera->detach(osg::Camera::COLOR_BUFFER);
  glass.camera->attach(osg::Camera::COLOR_BUFFER, glass.texture);
  glass.camera->setViewport(0, 0, wide, high);
  glass.camera->setRenderingCache(nullptr);
  auto& corners = static_cast<osg::Vec3Array&>(*glass.pane->getVertexArray());
  corners[0] = {box.left, box.low, 0.0F};
  corners[1] = {box.right, box.low, 0.0F};
  corners[2] = {box.right, box.high, 0.0F};
  corners[3] = {box.left, box.high, 0.0F};
  corners.dirty();
}

// Whether this is the next picture of what moves on evenly: no leap, no other car, the same mirrors.
bool Mirrors::GoesOn(const Picture& picture, const Eigen::Vector3d& eye_W) {
  const Shown now{picture.moment.time_ns, picture.followed, picture.mirrors, eye_W};
  const std::optional<Shown> before = std::exchange(before_, now);
  if (!before || before->followed != now.followed || before->mirrors != now.mirrors) return false;
  const std::int64_t passed_ns = std::abs(now.time_ns - before->time_ns);
  return passed_ns > 0 && passed_ns <= kNext_ns && (now.eye_W - before->eye_W).norm() < kNext_m;
}

void Mirrors::Show(const Picture& picture, const std::optional<scene::Body>& body, const scene::Air& air,
                   const SunShadow& shadow, const HeatNode& heat, int width_px, int height_px, bool in_turn) {
  const bool wanted =
      body && picture.camera == scene::CameraKind::kDriver && std::ranges::any_of(picture.mirrors, std::identity());
  if (!wanted) {  // what they showed stays theirs: between two pictures of a window a headset's eyes have some without
                  // mirrors, of another size
    for (Glass& glass : glasses_) glass.camera->setNodeMask(0U), glass.pane->setNodeMask(0U);
    return frames_.Set({});
  }
  for (const scene::Mirror mirror : scene::kAllMirrors) {
    Glass& glass = glasses_[static_cast<std::size_t>(mirror)];
    const Boxes::Box box = PixelsOf(mirror, picture.screen, *body, width_px, height_px);
    if (glass.box == box) continue;
    Fit(glass, box);
    before_.reset();
  }
  const bool one = GoesOn(picture, body->p_WB_W) && in_turn;
  if (one) {
    do turn_ = (turn_ + 1) % scene::kMirrors;
    while (!picture.mirrors[turn_]);
  }
  const scene::CarPose* lit =
      picture.followed < picture.moment.cars.size() ? &picture.moment.cars[picture.followed] : nullptr;
  std::vector<Boxes::Box> frames;
  for (const scene::Mirror mirror : scene::kAllMirrors) {
    const auto at = static_cast<std::size_t>(mirror);
    Glass& glass = glasses_[at];
    const bool shown = picture.mirrors[at];
    glass.camera->setNodeMask(shown && (!one || at == turn_) ? ~0U : 0U);
    glass.pane->setNodeMask(shown ? ~0U : 0U);
    if (!shown) continue;
    AimCamera(*glass.camera, scene::MirrorCamera(*body, mirror), scene::ShapeOf(mirror), kMirrorFar_m);
    glass.camera->setClearColor({air.horizon.x(), air.horizon.y(), air.horizon.z(), 1.0F});
    SetEye(*glass.camera->getOrCreateStateSet(), air, lit, glass.camera->getViewMatrix());
    shadow.SetEye(*glass.camera->getOrCreateStateSet(), glass.camera->getViewMatrix());
    heat.SetEye(*glass.camera->getOrCreateStateSet(), glass.camera->getViewMatrix());
    const Boxes::Box& box = glass.box;
    frames.push_back({box.left - kFrame_px, box.low - kFrame_px, box.right + kFrame_px, box.high + kFrame_px});
  }
  frames_.Set(frames);
}

}  // namespace rodeira::nodes
