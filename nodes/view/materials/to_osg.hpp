// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <osg/Matrixd>
#include <osg/Quat>
#include <osg/Vec3d>
#include <osg/Vec3f>

namespace rodeira::nodes {

// The same numbers.
inline osg::Vec3d ToOsg(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Not an overload of ToOsg: with both, an Eigen expression would be ambiguous.
inline osg::Vec3f ToOsgFloat(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

// From a body's frame, at p and turned by q, to its parent's.
inline osg::Matrixd ToOsg(const Eigen::Vector3d& p, const Eigen::Quaterniond& q) {
  return osg::Matrixd::rotate(osg::Quat(q.x(), q.y(), q.z(), q.w())) * osg::Matrixd::translate(p.x(), p.y(), p.z());
}

}  // namespace rodeira::nodes
