// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/dynamic_objects/cabin_node.hpp"

#include <osg/Depth>

#include <algorithm>
#include <cmath>

#include "common/view/scene/camera/camera.hpp"
#include "common/view/scene/vehicles/cabin.hpp"
#include "nodes/view/materials/face_texture.hpp"
#include "nodes/view/materials/to_osg.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kDial_px = 512, kGear_px = 64;

// From a facing thing's frame to the eye's.
osg::Matrixd MatrixOf(const scene::CabinPose& place) {
  const Eigen::Vector3d o = place.ToE(Eigen::Vector3d::Zero());
  osg::Matrixd matrix;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = place.ToE(Eigen::Vector3d::Unit(axis)) - o;
    for (int k = 0; k < 3; ++k) matrix(axis, k) = along[k];
  }
  matrix.setTrans(ToOsg(o));
  return matrix;
}

// A square about the frame's origin with a picture on it.
osg::ref_ptr<osg::Geometry> Square(MaterialLibrary& look, double half_m, const scene::Raster& picture) {
  scene::Mesh mesh;
  mesh.material = scene::Material::kSign;
  for (const auto& [x, y] : {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(1.0, 1.0), std::pair(-1.0, 1.0)}) {
    mesh.Add({half_m * x, half_m * y, 0.0}, Eigen::Vector3d::UnitZ(), {});
    mesh.on_face.emplace_back(static_cast<float>(0.5 + 0.5 * x), static_cast<float>(0.5 + 0.5 * y));
  }
  mesh.AddTriangle(0, 1, 2);
  mesh.AddTriangle(0, 2, 3);
  return look.GeometryOf(mesh, MakeTexture(picture));
}

// Pointing along x, from behind the middle to its end; shines a little by itself.
scene::Mesh Needle(double radius_m) {
  scene::Mesh mesh;
  mesh.material = scene::Material::kLamp;
  const scene::Colour red = scene::Colour::Of(0xe8401c);
  const double half = 0.035 * radius_m, z = 0.0015;
  mesh.Add({-0.15 * radius_m, -half, z}, Eigen::Vector3d::UnitZ(), red);
  mesh.Add({0.90 * radius_m, -0.4 * half, z}, Eigen::Vector3d::UnitZ(), red);
  mesh.Add({0.90 * radius_m, 0.4 * half, z}, Eigen::Vector3d::UnitZ(), red);
  mesh.Add({-0.15 * radius_m, half, z}, Eigen::Vector3d::UnitZ(), red);
  mesh.AddTriangle(0, 1, 2);
  mesh.AddTriangle(0, 2, 3);
  return mesh;
}

}  // namespace

CabinNode::CabinNode(MaterialLibrary& look) : look_(look), group_(new osg::MatrixTransform) {
  group_->setNodeMask(0U);
  // Nothing but the cabin is nearer to the eye: it has the nearest hundredth of the depths for itself, and the car's
  // body, which is closed where people sit, stays behind it.
  group_->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 0.01));
  group_->getOrCreateStateSet()->setDefine("SUN_SHADOW", osg::StateAttribute::OFF);  // the roof would darken it all
}

void CabinNode::Build(const scene::CabinShape& shape) {
  group_->removeChildren(0, group_->getNumChildren());
  gears_.clear();
  group_->addChild(look_.GeometryOf(scene::BuildDashboard(shape.width_m, shape.eye_left_m)));
  group_->addChild(look_.GeometryOf(scene::BuildCabinBody(shape)));
  for (std::size_t i = 0; i < needles_.size(); ++i) {
    const scene::CabinDial& dial = scene::CabinDials()[i];
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(MatrixOf(dial.place));
    place->addChild(Square(look_, dial.radius_m, scene::DrawDial(dial.dial, kDial_px)));
    needles_[i] = new osg::MatrixTransform;
    needles_[i]->addChild(look_.GeometryOf(Needle(dial.radius_m)));
    place->addChild(needles_[i]);
    group_->addChild(place);
  }
  osg::ref_ptr<osg::MatrixTransform> gear_place = new osg::MatrixTransform(MatrixOf(scene::GearPlace()));
  for (std::int32_t gear = kLowestGear; gear <= kHighestGear; ++gear) {
    gears_.push_back(Square(look_, 0.5 * scene::kGearHeight_m, scene::DrawGear(gear, kGear_px)));
    gear_place->addChild(gears_.back());
  }
  group_->addChild(gear_place);
  osg::ref_ptr<osg::MatrixTransform> wheel_place = new osg::MatrixTransform(MatrixOf(scene::WheelPlace()));
  wheel_ = new osg::MatrixTransform;
  wheel_->addChild(look_.GeometryOf(scene::BuildSteeringWheel()));
  wheel_place->addChild(wheel_);
  group_->addChild(wheel_place);
}

void CabinNode::Show(const scene::CarPose* car) {
  group_->setNodeMask(car != nullptr ? ~0U : 0U);
  if (car == nullptr) return;
  const Eigen::Vector3d eye_B = scene::DriversEye_B(*car);
  if (const scene::CabinShape shape{car->width_m, car->height_m, eye_B.y(), eye_B.z()}; built_for_ != shape) {
    built_for_ = shape;
    Build(shape);
  }
  const Eigen::Vector3d at = car->p_WB_W + car->q_WB * eye_B;
  const Eigen::Quaterniond& q = car->q_WB;
  group_->setMatrix(osg::Matrixd::rotate(osg::Quat(q.x(), q.y(), q.z(), q.w())) * osg::Matrixd::translate(ToOsg(at)));
  const std::array<double, 3> values = {3.6 * std::fabs(car->speed_mps), car->engine_rpm,
                                        std::max(0.0, scene::kTank_l - car->fuel_used_l)};
  for (std::size_t i = 0; i < needles_.size(); ++i) {
    needles_[i]->setMatrix(osg::Matrixd::rotate(scene::NeedleAngle_rad(scene::CabinDials()[i].dial, values[i]),
                                                osg::Vec3d(0.0, 0.0, 1.0)));
  }
  const std::int32_t shown = std::clamp(car->gear, kLowestGear, kHighestGear);
  for (std::size_t i = 0; i < gears_.size(); ++i)
    gears_[i]->setNodeMask(static_cast<std::int32_t>(i) + kLowestGear == shown ? ~0U : 0U);
  wheel_->setMatrix(osg::Matrixd::rotate(car->steering_wheel_rad, osg::Vec3d(0.0, 0.0, 1.0)));
}

}  // namespace rodeira::nodes
