#pragma once

#include <osg/Matrixd>
#include <osg/StateSet>
#include <osg/Uniform>

#include <cstdint>

#include "common/scene/air.hpp"
#include "common/scene/moment.hpp"

namespace rodeira::view {

// The uniforms that are the same for all that is drawn: light, sky, fog, wetness, headlights. Vectors with the ending _eye are
// in the eye's frame.
class AirUniforms {
 public:
  explicit AirUniforms(osg::StateSet& root);

  void Set(const scene::Air& air, const osg::Matrixd& view);
  // The headlights of the car that the camera goes with; null: it has none.
  void SetLamps(const scene::CarPose* car, const scene::Air& air, const osg::Matrixd& view);
  void SetRain(std::int64_t time_ns, double aspect);

 private:
  void Set(const char* name, float value);
  void Set(const char* name, const osg::Vec3f& value);

  osg::StateSet& root_;
};

}  // namespace rodeira::view
