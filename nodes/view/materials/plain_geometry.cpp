// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/materials/plain_geometry.hpp"

#include <SDL.h>
#include <osg/BoundingBox>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::nodes {
namespace {

osg::ref_ptr<osg::Vec4ubArray> ColoursOf(const scene::Mesh& mesh) {
  osg::ref_ptr<osg::Vec4ubArray> colours = new osg::Vec4ubArray;
  colours->reserve(mesh.colours.size());
  for (const scene::Colour& c : mesh.colours) colours->push_back({c.red, c.green, c.blue, 255});
  colours->setNormalize(true);
  return colours;
}

// Around all places: of each the box around the turned model.
osg::BoundingBox BoxOf(const osg::Vec3Array& model, const osg::Vec4Array& places, const osg::Vec4Array& shapes) {
  osg::BoundingBox one;
  for (const osg::Vec3& p : model) one.expandBy(p);
  osg::BoundingBox all;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const osg::Vec4 &at = places[i], &shape = shapes[i];
    for (unsigned corner = 0; corner < 8; ++corner) {
      const osg::Vec3 p = one.corner(corner);
      const float x = p.x() * shape.z(), y = p.y() * shape.z();
      all.expandBy(at.x() + shape.x() * x - shape.y() * y, at.y() + shape.y() * x + shape.x() * y,
                   at.z() + p.z() * shape.w());
    }
  }
  return all;
}

class KnownBox : public osg::Drawable::ComputeBoundingBoxCallback {
 public:
  explicit KnownBox(const osg::BoundingBox& box) : box_(box) {}
  osg::BoundingBox computeBound(const osg::Drawable&) const override { return box_; }

 private:
  osg::BoundingBox box_;
};

}  // namespace

osg::ref_ptr<osg::Geometry> PlainGeometry(const scene::Mesh& mesh) {
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array, normals = new osg::Vec3Array;
  positions->reserve(mesh.positions.size());
  normals->reserve(mesh.positions.size());
  for (const Eigen::Vector3f& p : mesh.positions) positions->push_back({p.x(), p.y(), p.z()});
  for (const Eigen::Vector3f& n : mesh.normals) normals->push_back({n.x(), n.y(), n.z()});
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setVertexArray(positions);
  geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
  geometry->setColorArray(ColoursOf(mesh), osg::Array::BIND_PER_VERTEX);
  geometry->addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES, mesh.triangles.begin(), mesh.triangles.end()));
  return geometry;
}

osg::ref_ptr<osg::Geometry> RepeatedGeometry(const scene::Repeated& repeated) {
  osg::ref_ptr<osg::Geometry> geometry = PlainGeometry(repeated.model);
  auto& colours = static_cast<osg::Vec4ubArray&>(*geometry->getColorArray());
  for (std::size_t i = 0; i < repeated.light.size();
       ++i) {  // a leaf says how light it is, in quarters, and that it has no colour of its own
    if (repeated.light[i] >= 0.0F)
      colours[i] = {static_cast<unsigned char>(std::lround(4.0F * repeated.light[i])), 0, 0, 0};
  }
  osg::ref_ptr<osg::Vec4Array> places = new osg::Vec4Array, shapes = new osg::Vec4Array;
  for (const scene::PlacedCopy& place : repeated.places) {
    const Eigen::Vector3f foot = (place.stand.foot_W - repeated.origin_W).cast<float>();
    const Eigen::Vector2f x = place.stand.x_W.cast<float>();
    const scene::Colour c = place.leaves;
    places->push_back({foot.x(), foot.y(), foot.z(), static_cast<float>(65536 * c.red + 256 * c.green + c.blue)});
    shapes->push_back({x.x(), x.y(), static_cast<float>(place.across), static_cast<float>(place.up)});
  }
  geometry->setVertexAttribArray(kPlaceSlot, places, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(kShapeSlot, shapes, osg::Array::BIND_PER_VERTEX);
  return geometry;
}

void Spread(osg::Geometry& repeated) {
  const auto* model = dynamic_cast<const osg::Vec3Array*>(repeated.getVertexArray());
  const auto* places = dynamic_cast<const osg::Vec4Array*>(repeated.getVertexAttribArray(kPlaceSlot));
  const auto* shapes = dynamic_cast<const osg::Vec4Array*>(repeated.getVertexAttribArray(kShapeSlot));
  RODEIRA_ASSERT(model != nullptr && places != nullptr && shapes != nullptr && places->size() == shapes->size());
  for (unsigned i = 0; i < repeated.getNumPrimitiveSets(); ++i)
    repeated.getPrimitiveSet(i)->setNumInstances(static_cast<int>(places->size()));
  repeated.setComputeBoundingBoxCallback(new KnownBox(BoxOf(*model, *places, *shapes)));
  repeated.dirtyBound();
}

bool CanRepeat() {
  return SDL_GL_ExtensionSupported("GL_ARB_draw_instanced") == SDL_TRUE &&
         SDL_GL_ExtensionSupported("GL_ARB_instanced_arrays") == SDL_TRUE;
}

}  // namespace rodeira::nodes
