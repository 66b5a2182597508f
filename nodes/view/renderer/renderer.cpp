// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/renderer/renderer.hpp"

#include <osg/Camera>
#include <osg/CullFace>
#include <osg/MatrixTransform>
#include <osg/Uniform>
#include <osgDB/DatabasePager>
#include <osgUtil/Statistics>
#include <osgViewer/Renderer>
#include <osgViewer/Viewer>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <set>
#include <thread>

#include "common/core/base/file_cache.hpp"
#include "common/core/base/log.hpp"
#include "common/view/scene/terrain/far_plane.hpp"
#include "nodes/view/dynamic_objects/cabin_node.hpp"
#include "nodes/view/dynamic_objects/car_node.hpp"
#include "nodes/view/dynamic_objects/lights_node.hpp"
#include "nodes/view/dynamic_objects/vectors_node.hpp"
#include "nodes/view/materials/material_library.hpp"
#include "nodes/view/materials/model_file.hpp"
#include "nodes/view/materials/plain_geometry.hpp"
#include "nodes/view/materials/to_osg.hpp"
#include "nodes/view/overlays/heat_node.hpp"
#include "nodes/view/overlays/instruments.hpp"
#include "nodes/view/overlays/overlay.hpp"
#include "nodes/view/overlays/timeline_bar.hpp"
#include "nodes/view/paging/ground_nodes.hpp"
#include "nodes/view/paging/made_world.hpp"
#include "nodes/view/paging/paged_world.hpp"
#include "nodes/view/paging/tile_tree.hpp"
#include "nodes/view/renderer/aim_camera.hpp"
#include "nodes/view/renderer/mirrors.hpp"
#include "nodes/view/renderer/sun_shadow.hpp"
#include "nodes/view/shaders/air_uniforms.hpp"
#include "nodes/view/visual_database/built_world.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kFar_m = 15'000.0;
constexpr double kShadowsAhead_m = 35.0;

// About which place shadows are seen best: before the eye where it looks along the road, else about the car.
Eigen::Vector3d ShadowsAbout(const Picture& picture, const std::optional<scene::Body>& body,
                             const scene::Camera& camera) {
  if (!body) return camera.eye_W;
  const bool ahead = picture.camera == scene::CameraKind::kDriver || picture.camera == scene::CameraKind::kBonnet ||
                     picture.camera == scene::CameraKind::kChase;
  return body->p_WB_W + (ahead ? kShadowsAhead_m : 0.0) * (body->q_WB * Eigen::Vector3d::UnitX());
}

// Pagers stand about their tiles' middles.
std::vector<scene::TileKey> KeysOf(const PagedWorld& paged) {
  std::vector<scene::TileKey> tiles;
  for (const osg::PagedLOD* tile : paged.tiles) {
    const osg::Vec3d& middle = tile->getCenter();
    tiles.push_back({static_cast<std::int64_t>(std::floor(middle.x() / scene::kTile_m)),
                     static_cast<std::int64_t>(std::floor(middle.y() / scene::kTile_m))});
  }
  return tiles;
}

void AddFarPlane(MaterialLibrary& look, const road::World& world, const std::vector<scene::TileKey>& tiles,
                 osg::Group& group) {
  const scene::Mesh plane = scene::BuildFarPlane(world, tiles);
  if (plane.triangles.empty()) return;
  const scene::Mesh* const only = &plane;
  const osg::ref_ptr<osg::Node> node = look.Placed({&only, 1});
  node->setNodeMask(kThrowsNone);
  group.addChild(node);
}

// Looking a picture up several times along its slant takes the processor longer than all else in a frame together.
QualityTraits TraitsOn(const Surface& surface) {
  QualityTraits traits = TraitsOf(surface.quality());
  if (surface.draws_by_processor()) traits.slanted = 1.0F;
  return traits;
}

}  // namespace

struct Renderer::Parts {
  Parts(const road::World& world, const QualityTraits& quality, bool repeats)
      : look(quality, repeats), lights(look, world), vectors(look, world), shadow(*root, *scene, quality) {}

  MaterialLibrary look;
  Fleet fleet{look};
  CabinNode cabin{look};
  LightsNode lights;
  VectorsNode vectors;
  osg::ref_ptr<osg::Camera> overlay = MakeOverlay();
  osg::ref_ptr<osg::MatrixTransform> panels = new osg::MatrixTransform;
  Instruments instruments{*panels};
  TimelineBar timeline{*panels};
  osg::ref_ptr<osg::Group> root = new osg::Group;
  HeatNode heat{*panels, *root->getOrCreateStateSet()};
  osg::ref_ptr<osg::Group> scene = new osg::Group;  // the world and what moves in it: all that mirrors show too
  SunShadow shadow;
  Mirrors mirrors{*root, *scene, *overlay};
  osg::ref_ptr<osg::Node> rain = look.MakeRain();
  PagedWorld paged;  // without a root: all of the ground is there from the beginning
  osgViewer::Viewer viewer;
};

Renderer::Renderer(Surface& surface, const road::World& world, bool repeats)
    : surface_(surface),
      world_(world),
      parts_(std::make_unique<Parts>(world, TraitsOn(surface),
                                     repeats && TraitsOf(surface.quality()).instances && CanRepeat())) {}

Renderer::Renderer(Surface& surface, const road::World& world, const scene::WorldScene& standing, bool repeats)
    : Renderer(surface, world, repeats) {
  MaterialLibrary& look = parts_->look;
  osg::Group& group = *parts_->scene;
  std::vector<PlacedNode> land;
  std::vector<scene::TileKey> tiles;
  for (const scene::GroundTile& tile : standing.ground) {
    land.push_back(GroundNode(look, tile));
    tiles.push_back(tile.key);
  }
  for (const scene::TerrainTile& tile : standing.terrain) land.push_back(TerrainNode(look, tile));
  group.addChild(TileTree(land));
  AddFarPlane(look, world, tiles, group);
  SetUp();
}

base::Result<std::unique_ptr<Renderer>> Renderer::Make(Surface& surface, const road::World& world,
                                                       const std::filesystem::path& built, bool repeats) {
  std::unique_ptr<Renderer> renderer(new Renderer(surface, world, repeats));
  auto ground = ReadBuilt(built, renderer->parts_->look);
  if (!ground) return ground.error();
  renderer->Lay(std::move(ground).value());
  return renderer;
}

std::unique_ptr<Renderer> Renderer::Make(Surface& surface, const road::World& world, scene::ModelIsThere is_there,
                                         bool repeats) {
  std::unique_ptr<Renderer> renderer(new Renderer(surface, world, repeats));
  renderer->Lay(BuildVisualWorld(world, renderer->parts_->look, std::move(is_there), &base::UserCache()));
  renderer->parts_->viewer.getDatabasePager()->setUpThreads(std::max(1u, std::thread::hardware_concurrency()), 0);
  return renderer;
}

void Renderer::Lay(PagedWorld paged) {
  parts_->paged = std::move(paged);
  parts_->scene->addChild(parts_->paged.root);
  if (world_.network() != nullptr) AddFarPlane(parts_->look, world_, KeysOf(parts_->paged), *parts_->scene);
  SetUp();
}

// What moves, sky and texts, and the viewer.
void Renderer::SetUp() {
  Surface& surface = surface_;
  MaterialLibrary& look = parts_->look;
  osg::Group& root = *parts_->root;
  osg::Group& group = *parts_->scene;
  osg::ref_ptr<osg::Group> moving = new osg::Group;
  moving->setNodeMask(kOnlyNear);
  moving->addChild(parts_->fleet.node());
  moving->addChild(parts_->lights.node());
  moving->addChild(parts_->vectors.node());
  group.addChild(moving);
  group.addChild(look.MakeSky());
  root.addChild(&group);
  root.addChild(parts_->cabin.node());
  root.addChild(parts_->rain);
  parts_->overlay->addChild(parts_->panels);
  root.addChild(parts_->overlay);
  osg::StateSet* state = root.getOrCreateStateSet();
  state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  state->setMode(GL_MULTISAMPLE, osg::StateAttribute::ON);
  if (TraitsOf(surface.quality()).fine) state->setDefine("FINE");

  osgViewer::Viewer& viewer = parts_->viewer;
  viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer.setUpViewerAsEmbeddedInWindow(0, 0, surface.width_px(), surface.height_px());
  viewer.setLightingMode(osg::View::NO_LIGHT);
  viewer.setKeyEventSetsDone(0);
  viewer.setReleaseContextAtEndOfFrameHint(false);
  osg::Camera& camera = *viewer.getCamera();
  camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
  camera.setClearColor({0.8F, 0.86F, 0.91F, 1.0F});
  camera.setCullingMode(camera.getCullingMode() |
                        osg::CullSettings::FAR_PLANE_CULLING);  // what cannot be seen is not read either
  camera.setLODScale(TraitsOf(surface.quality()).detail_scale);
  viewer.setSceneData(&root);
  // What was read stays until the eye has left it (ReleaseFarTiles), also behind its back: turning round shows no gaps.
  if (parts_->paged.root)
    viewer.getDatabasePager()->setTargetMaximumNumberOfPageLOD(static_cast<unsigned>(parts_->paged.tiles.size()));
  viewer.realize();
}

Renderer::~Renderer() { parts_->root->releaseGLObjects(parts_->viewer.getCamera()->getGraphicsContext()->getState()); }

scene::Camera Renderer::CameraOf(const Picture& picture) const {
  const auto body = scene::BodyAt(picture.moment, picture.followed);
  if (!body) return {};
  if (picture.eye && picture.camera == scene::CameraKind::kDriver) return scene::EyeCamera(*body, *picture.eye);
  if (picture.screen && picture.camera == scene::CameraKind::kDriver)
    return scene::ScreenCamera(*body, *picture.screen);
  return *scene::MakeCamera(picture.camera, picture.moment, picture.followed, picture.aim, world_);
}

base::Status Renderer::UseCarModel(const std::filesystem::path& file) {
  if (auto status = ReadModel(file.string()); !status) return status;
  parts_->fleet.WearModel(file.string());
  return {};
}

void Renderer::Draw(const Picture& picture) {
  osgViewer::Viewer& viewer = parts_->viewer;
  if (parts_->paged.root)
    RequestAhead(parts_->paged, *viewer.getDatabasePager(), *viewer.getFrameStamp(), ToOsg(CameraOf(picture).eye_W),
                 kFar_m);
  DrawOnce(picture, {0, surface_.width_px(), surface_.height_px()}, false);
}

void Renderer::DrawInto(const Picture& picture, const PictureTarget& target) { DrawOnce(picture, target, true); }

void Renderer::DrawOnce(const Picture& picture, const PictureTarget& target, bool whole) {
  const int width = target.width_px, height = target.height_px;
  const scene::Camera camera = CameraOf(picture);
  const bool is_car = picture.followed < picture.moment.cars.size();
  const auto body = scene::BodyAt(picture.moment, picture.followed);
  osg::Camera& eye = *parts_->viewer.getCamera();
  if (eye.getViewport() == nullptr || static_cast<int>(eye.getViewport()->width()) != width ||
      static_cast<int>(eye.getViewport()->height()) != height) {
    eye.getGraphicsContext()->resized(0, 0, width, height);
    eye.setViewport(0, 0, width, height);
  }
  eye.getGraphicsContext()->setDefaultFboId(target.framebuffer);  // to which it returns from mirrors and shadows
  Bind(target);
  const double aspect = static_cast<double>(width) / height;
  AimCamera(eye, camera, aspect, kFar_m);
  const scene::Air air = scene::MakeAir(picture.moment.weather);
  osg::StateSet& state = *parts_->root->getOrCreateStateSet();
  SetAir(state, air);
  SetEye(state, air, is_car ? &picture.moment.cars[picture.followed] : nullptr, eye.getViewMatrix());
  parts_->shadow.Show(state, air, ShadowsAbout(picture, body, camera));
  parts_->shadow.SetEye(state, eye.getViewMatrix());
  const PanelSize panels = PanelsOf(width, height);
  parts_->panels->setMatrix(
      osg::Matrixd::scale(static_cast<double>(panels.scale), static_cast<double>(panels.scale), 1.0));
  parts_->heat.Show(state, picture.heat, panels);
  parts_->heat.SetEye(state, eye.getViewMatrix());
  SetRain(state, picture.moment.time_ns, aspect);
  parts_->rain->setNodeMask(air.rain > 0.0F ? ~0U : 0U);
  parts_->fleet.Show(picture.moment,
                     picture.camera == scene::CameraKind::kDriver ? std::optional(picture.followed) : std::nullopt,
                     picture.chosen, air.headlights > 0.0F);
  parts_->cabin.Show(is_car && picture.cabin && picture.camera == scene::CameraKind::kDriver
                         ? &picture.moment.cars[picture.followed]
                         : nullptr);
  parts_->lights.Show(picture.moment.lights);
  parts_->vectors.Show(picture);
  FitOverlay(*parts_->overlay, width, height);
  parts_->mirrors.Show(picture, body, air, parts_->shadow, parts_->heat, width, height,
                       !whole && TraitsOf(surface_.quality()).mirrors_in_turn);
  parts_->instruments.Show(picture, panels, picture.timeline ? TimelinePlace::kHeight : 0.0F);
  parts_->timeline.Show(picture.timeline, panels);
  parts_->viewer.frame(static_cast<double>(picture.moment.time_ns) * 1e-9);
  if (parts_->paged.root && !parts_->viewer.getDatabasePager()->getRequestsInProgress())
    ReleaseFarTiles(parts_->paged, ToOsg(camera.eye_W), kFar_m, static_cast<double>(eye.getLODScale()));
}

void Renderer::DrawWhole(const Picture& picture, const scene::Progress& progress) {
  const PictureTarget target{0, surface_.width_px(), surface_.height_px()};
  DrawInto(picture, target);
  if (!parts_->paged.root) return;
  osgDB::DatabasePager* const pager = parts_->viewer.getDatabasePager();
  double share = 0.0;
  bool has_pixels = true;
  // Each level of a tile is asked for when the one before it is there.
  while (!has_pixels || pager->getRequestsInProgress()) {
    if (!pager->getRequestsInProgress()) {
      DrawInto(picture, target);
      has_pixels = true;
      continue;
    }
    while (IsReading(*pager)) {
      const double there = static_cast<double>(HeldLevels() + pager->getDataToMergeListSize());
      share = std::max(share, there / (there + 1.0 + static_cast<double>(pager->getFileRequestListSize())));
      if (progress) progress(share);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    has_pixels = RequestVisible(picture, target);
  }
}

bool Renderer::RequestVisible(const Picture& picture, const PictureTarget& target) {
  const unsigned context = parts_->viewer.getCamera()->getGraphicsContext()->getState()->getContextID();
  const bool discards = osg::isGLExtensionOrVersionSupported(context, "GL_EXT_transform_feedback", 3.0F);
  if (discards) glEnable(GL_RASTERIZER_DISCARD);
  DrawInto(picture, target);
  if (discards) glDisable(GL_RASTERIZER_DISCARD);
  return !discards;
}

std::size_t Renderer::HeldLevels() const { return nodes::HeldLevels(parts_->paged); }

PictureCost Renderer::CostOfLast() const {
  auto& renderer = dynamic_cast<osgViewer::Renderer&>(*parts_->viewer.getCamera()->getRenderer());
  osgUtil::Statistics counted;
  renderer.getSceneView(0)->getStats(counted);  // the one that a single thread draws by
  PictureCost cost;
  cost.calls = static_cast<std::size_t>(counted.numDrawables + counted.numFastDrawables);
  for (const auto& [mode, primitives] : counted.getPrimitiveValueMap()) cost.triangles += primitives.second / 3;
  return cost;
}

Image Renderer::Read() const {
  Image image;
  image.width_px = surface_.width_px();
  image.height_px = surface_.height_px();
  const auto row = 3 * static_cast<std::size_t>(image.width_px);
  std::vector<std::uint8_t> upward(row * static_cast<std::size_t>(image.height_px));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image.width_px, image.height_px, GL_RGB, GL_UNSIGNED_BYTE, upward.data());
  image.rgb.reserve(upward.size());
  for (std::size_t y = static_cast<std::size_t>(image.height_px); y-- > 0;) {
    const auto begin = upward.begin() + static_cast<std::ptrdiff_t>(y * row);
    image.rgb.insert(image.rgb.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  return image;
}

base::Result<std::unique_ptr<Renderer>> RendererOf(Surface& surface, const road::World& world,
                                                   const std::filesystem::path& built, bool repeats,
                                                   const scene::Progress& progress) {
  if (!built.empty()) return Renderer::Make(surface, world, built, repeats);
  // The ground is made later, too: what it asks outlives this function.
  const auto is_there = [told = std::make_shared<std::set<std::string>>()](const std::string& file) {
    const base::Status read = ReadModel(file);
    if (!read && told->insert(file).second)
      base::Log(base::LogLevel::kWarning, "",
                fmt::format("{}; what it is of is drawn without it", read.error().Text()));
    return read.ok();
  };
  if (world.network() != nullptr) return Renderer::Make(surface, world, is_there, repeats);
  const scene::WorldScene standing =
      scene::BuildWorldScene(world, is_there, progress);  // the renderer has its own copy
  return std::make_unique<Renderer>(surface, world, standing, repeats);
}

base::Result<Image> RenderStill(const road::World& world, const Picture& picture, int width_px, int height_px,
                                const std::filesystem::path& built, Quality quality) {
  auto surface = Surface::Open(SurfaceKind::kOffscreen, width_px, height_px, "Rodeira", false, 0, quality);
  if (!surface) return surface.error();
  auto renderer = RendererOf(*surface.value(), world, built);
  if (!renderer) return renderer.error();
  renderer.value()->DrawWhole(picture);
  return renderer.value()->Read();
}

}  // namespace rodeira::nodes
