// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/ref_ptr>

#include <array>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/mesh/repeated.hpp"
#include "nodes/view/frame/quality.hpp"

namespace rodeira::nodes {

// The bits of node masks by which geometries are in the sun's shadow maps: what stands and moves, in the near one
// alone, and the ground, in both. The sky and what lies flat on the ground have neither.
inline constexpr unsigned kThrowsShadow = 0x2U, kGroundThrowsShadow = 0x4U;
inline constexpr unsigned kThrowsNone = ~(kThrowsShadow | kGroundThrowsShadow), kOnlyNear = ~kGroundThrowsShadow;
// The node mask of a geometry of this material.
unsigned ShadowMaskOf(scene::Material material);

// From the sources of its shaders, with the attributes of RepeatedGeometry in their slots.
osg::ref_ptr<osg::Program> ProgramOf(const std::string& vertex, const std::string& fragment);

// From the scene's plain meshes to OpenSceneGraph's nodes. What it makes belongs to one OpenGL context.
class MaterialLibrary {
 public:
  // `repeats`: whether what is repeated is drawn as one model at many places; otherwise merged.
  MaterialLibrary(const QualityTraits& quality, bool repeats);

  bool repeats() const { return repeats_; }
  // Makes what is otherwise made as it is needed. From then on several threads may ask for states, geometries and what
  // is placed.
  void MakeStates();
  // How a material is drawn; one shared state for each.
  osg::StateSet* StateOf(scene::Material material);
  // The same for a model that is drawn at many places.
  osg::StateSet* StateOfRepeated(scene::Material material);
  // The same for a sign with this picture; a new one.
  osg::ref_ptr<osg::StateSet> StateOfFace(osg::Texture2D& picture);
  // The same for ground on which a file's picture lies. Where it cannot be read a sentence is printed, once, and the
  // state is that of the ground without it. Several threads may ask.
  osg::ref_ptr<osg::StateSet> StateOfPicture(const std::string& file, bool repeats);
  // The mesh without its origin.
  osg::ref_ptr<osg::Geometry> GeometryOf(const scene::Mesh& mesh);
  // The same of a sign (kSign) with this picture instead of its face's.
  osg::ref_ptr<osg::Geometry> GeometryOf(const scene::Mesh& mesh, osg::ref_ptr<osg::Texture2D> picture);
  // The meshes at their places in the world. They must have the same origin, and at least one there must be.
  osg::ref_ptr<osg::MatrixTransform> Placed(std::span<const scene::Mesh* const> meshes);
  // Models at their many places in the world, or merged, as this look does it. They must have the same origin, and at
  // least one there must be.
  osg::ref_ptr<osg::MatrixTransform> Placed(std::span<const scene::Repeated> all);
  osg::ref_ptr<osg::Node> MakeSky();
  // Falling rain before everything, over the whole picture. Its state wants the uniforms time_s and aspect.
  osg::ref_ptr<osg::Node> MakeRain();
  // A soft shadow on the ground under a car, on z = 0 of its frame.
  osg::ref_ptr<osg::Node> MakeShadow(float rear_m, float front_m, float half_width_m);

 private:
  osg::ref_ptr<osg::Geometry> BareGeometryOf(const scene::Mesh& mesh);
  static osg::ref_ptr<osg::MatrixTransform> PlaceAt(const Eigen::Vector3d& origin_W);
  osg::ref_ptr<osg::StateSet> MakeState(scene::Material material);
  osg::ref_ptr<osg::StateSet> KnownFace(const std::string& face);

  const QualityTraits quality_;
  const bool repeats_;
  osg::ref_ptr<osg::Texture2D> noise_;  // repeats: fine in its red part, coarse in its green one
  osg::ref_ptr<osg::Program> shadow_;
  std::array<osg::ref_ptr<osg::StateSet>, scene::kMaterials> states_, repeated_states_;
  std::mutex mutex_;                                          // of the next two
  std::map<std::string, osg::ref_ptr<osg::StateSet>> faces_;  // of signs
  std::map<std::pair<std::string, bool>, osg::ref_ptr<osg::StateSet>> pictures_;
};

}  // namespace rodeira::nodes
