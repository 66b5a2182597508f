// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/materials/model_file.hpp"

#include <osg/MatrixTransform>
#include <osgDB/ReadFile>

#include <map>
#include <mutex>

namespace rodeira::nodes {

namespace {

std::mutex models_mutex;  // of the next, and of the nodes in it
std::map<std::string, osg::ref_ptr<osg::Node>> known_models;

}  // namespace

base::Status ReadModel(const std::string& file) {
  const std::lock_guard lock(models_mutex);
  auto& node = known_models[file];
  if (!node) node = osgDB::readRefNodeFile(file);
  if (!node) return base::WrongInput("view.wrong_model_file", "OpenSceneGraph cannot read this model", file);
  return {};
}

osg::ref_ptr<osg::Node> CopyOfModel(const std::string& file) {
  if (!ReadModel(file)) return {};
  const std::lock_guard lock(models_mutex);
  return osg::clone(known_models.at(file).get(), osg::CopyOp(osg::CopyOp::DEEP_COPY_ALL));
}

osg::ref_ptr<osg::Group> PlaceModels(const std::vector<scene::PlacedModel>& models) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  std::map<std::string, osg::ref_ptr<osg::Node>> copies;
  for (const scene::PlacedModel& model : models) {
    auto& copy = copies[model.file];
    if (!copy) copy = CopyOfModel(model.file);
    if (!copy) continue;
    const auto& [foot, x] = model.stand;
    // Row vectors, as OpenSceneGraph has them: the model's axes in the world, then its place.
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd(
        x.x(), x.y(), 0.0, 0.0, -x.y(), x.x(), 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, foot.x(), foot.y(), foot.z(), 1.0));
    place->addChild(copy);
    group->addChild(place);
  }
  return group;
}

}  // namespace rodeira::nodes
