// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/materials/material_library.hpp"

#include <fmt/format.h>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osg/Shader>
#include <osg/Texture2D>
#include <osg/VertexAttribDivisor>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/base/log.hpp"
#include "common/core/base/random.hpp"
#include "common/view/scene/vehicles/car_lights.hpp"
#include "nodes/view/materials/face_texture.hpp"
#include "nodes/view/materials/picture_texture.hpp"
#include "nodes/view/materials/plain_geometry.hpp"
#include "nodes/view/shaders/shaders.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kNoiseSize = 256;
constexpr float kFaceSlanted = 4.0F;  // a sign stands across the road: less often is enough
// Drawn in this order; the road's marks after the ground they lie on, the sky where nothing else is.
constexpr int kMarkBin = 1, kSkyBin = 2, kShadowBin = 3, kRainBin = 4;

// Noise in [0, 1] that repeats after kNoiseSize pixels.
double RepeatingNoise(int x, int y, int cell, std::uint64_t seed) {
  const int cells = kNoiseSize / cell;
  const auto corner = [&](int c, int r) {
    return base::RandomUniform({seed, static_cast<std::uint64_t>(c % cells), static_cast<std::uint64_t>(r % cells)});
  };
  const double u = static_cast<double>(x % cell) / cell, v = static_cast<double>(y % cell) / cell;
  const double a = u * u * (3.0 - 2.0 * u), b = v * v * (3.0 - 2.0 * v);
  const int c = x / cell, r = y / cell;
  return (corner(c, r) * (1.0 - a) + corner(c + 1, r) * a) * (1.0 - b) +
         (corner(c, r + 1) * (1.0 - a) + corner(c + 1, r + 1) * a) * b;
}

// `between`: also between two of its sizes.
osg::ref_ptr<osg::Texture2D> MakeNoise(bool between) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(kNoiseSize, kNoiseSize, 1, GL_RGB, GL_UNSIGNED_BYTE);
  for (int y = 0; y < kNoiseSize; ++y) {
    for (int x = 0; x < kNoiseSize; ++x) {
      const double fine =
          0.5 * RepeatingNoise(x, y, 2, 11) + 0.3 * RepeatingNoise(x, y, 8, 12) + 0.2 * RepeatingNoise(x, y, 32, 13);
      const double coarse =
          0.5 * RepeatingNoise(x, y, 64, 14) + 0.3 * RepeatingNoise(x, y, 32, 15) + 0.2 * RepeatingNoise(x, y, 8, 16);
      unsigned char* pixel = image->data(static_cast<unsigned>(x), static_cast<unsigned>(y));
      pixel[0] = static_cast<unsigned char>(std::lround(255.0 * fine));
      pixel[1] = static_cast<unsigned char>(std::lround(255.0 * coarse));
      pixel[2] = 128;
    }
  }
  osg::ref_ptr<osg::Texture2D> made = new osg::Texture2D(image);
  made->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  made->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  made->setFilter(osg::Texture::MIN_FILTER,
                  between ? osg::Texture::LINEAR_MIPMAP_LINEAR : osg::Texture::LINEAR_MIPMAP_NEAREST);
  made->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  return made;
}

}  // namespace

unsigned ShadowMaskOf(scene::Material material) {
  if (material == scene::Material::kMark) return kThrowsNone;
  return scene::IsGround(material) ? ~kThrowsShadow : kOnlyNear;
}

osg::ref_ptr<osg::Program> ProgramOf(const std::string& vertex, const std::string& fragment) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
  program->addBindAttribLocation("instance_place", kPlaceSlot);
  program->addBindAttribLocation("instance_shape", kShapeSlot);
  return program;
}

MaterialLibrary::MaterialLibrary(const QualityTraits& quality, bool repeats)
    : quality_(quality),
      repeats_(repeats),
      noise_(MakeNoise(quality.fine)),
      shadow_(ProgramOf(ShadowVertexShader(), ShadowFragmentShader())) {}

osg::ref_ptr<osg::StateSet> MaterialLibrary::MakeState(scene::Material material) {
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  state->setAttributeAndModes(ProgramOf(VertexShader(material), FragmentShader(material)));
  state->setTextureAttribute(0, noise_);
  state->addUniform(new osg::Uniform("noise", 0));
  state->setMode(GL_CULL_FACE, osg::StateAttribute::ON);
  if (material == scene::Material::kCarPaint || material == scene::Material::kMatt)
    state->addUniform(new osg::Uniform("pulse", 0.0F));
  if (material == scene::Material::kCarLamp)
    state->addUniform(new osg::Uniform(osg::Uniform::FLOAT, "glows", static_cast<int>(scene::kLamps)));
  if (material == scene::Material::kLamp) state->addUniform(new osg::Uniform("glow", 1.0F));
  if (material == scene::Material::kMark) {
    state->setAttributeAndModes(new osg::PolygonOffset(-1.0F, -4.0F));
    state->setMode(GL_POLYGON_OFFSET_FILL, osg::StateAttribute::ON);
    state->setRenderBinDetails(kMarkBin, "RenderBin");
  }
  return state;
}

void MaterialLibrary::MakeStates() {
  for (int number = 0; number < scene::kMaterials; ++number)
    (void)StateOfRepeated(static_cast<scene::Material>(number));
}

osg::StateSet* MaterialLibrary::StateOf(scene::Material material) {
  auto& state = states_[static_cast<std::size_t>(material)];
  if (!state) state = MakeState(material);
  return state;
}

osg::StateSet* MaterialLibrary::StateOfRepeated(scene::Material material) {
  auto& state = repeated_states_[static_cast<std::size_t>(material)];
  if (state) return state;
  state = new osg::StateSet(*StateOf(material), osg::CopyOp::SHALLOW_COPY);
  state->setDefine("INSTANCED");
  for (const unsigned slot : {kPlaceSlot, kShapeSlot}) state->setAttribute(new osg::VertexAttribDivisor(slot, 1));
  return state;
}

osg::ref_ptr<osg::StateSet> MaterialLibrary::StateOfFace(osg::Texture2D& picture) {
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet(*StateOf(scene::Material::kSign), osg::CopyOp::SHALLOW_COPY);
  picture.setMaxAnisotropy(std::min(kFaceSlanted, quality_.slanted));
  state->setTextureAttribute(1, &picture);
  state->addUniform(new osg::Uniform("face", 1));
  return state;
}

osg::ref_ptr<osg::StateSet> MaterialLibrary::KnownFace(const std::string& face) {
  const std::lock_guard lock(mutex_);
  auto& state = faces_[face];
  if (!state) state = StateOfFace(*MakeFaceTexture(face));
  return state;
}

osg::ref_ptr<osg::StateSet> MaterialLibrary::StateOfPicture(const std::string& file, bool repeats) {
  const std::lock_guard lock(mutex_);
  auto& state = pictures_[{file, repeats}];
  if (state) return state;
  const auto picture = MakePictureTexture(file, repeats);
  if (!picture) {
    base::Log(base::LogLevel::kWarning, "",
              fmt::format("the ground is drawn without its picture: {}", picture.error().Text()));
    return state = StateOf(scene::Material::kGround);
  }
  picture.value()->setMaxAnisotropy(quality_.slanted);
  state = new osg::StateSet(*StateOf(scene::Material::kPicture), osg::CopyOp::SHALLOW_COPY);
  state->setTextureAttribute(1, picture.value());
  state->addUniform(new osg::Uniform("face", 1));
  state->addUniform(new osg::Uniform("repeats", repeats ? 1.0F : 0.0F));
  return state;
}

osg::ref_ptr<osg::Geometry> MaterialLibrary::BareGeometryOf(const scene::Mesh& mesh) {
  osg::ref_ptr<osg::Geometry> geometry = PlainGeometry(mesh);
  if (!mesh.on_face.empty()) geometry->setTexCoordArray(1, PlacesOnFace(mesh));
  geometry->setNodeMask(ShadowMaskOf(mesh.material));
  return geometry;
}

osg::ref_ptr<osg::Geometry> MaterialLibrary::GeometryOf(const scene::Mesh& mesh) {
  osg::ref_ptr<osg::Geometry> geometry = BareGeometryOf(mesh);
  if (mesh.material == scene::Material::kPicture)
    geometry->setStateSet(StateOfPicture(mesh.face, mesh.repeats));
  else if (mesh.material == scene::Material::kSign)
    geometry->setStateSet(KnownFace(mesh.face));
  else
    geometry->setStateSet(StateOf(mesh.material));
  return geometry;
}

osg::ref_ptr<osg::Geometry> MaterialLibrary::GeometryOf(const scene::Mesh& mesh, osg::ref_ptr<osg::Texture2D> picture) {
  osg::ref_ptr<osg::Geometry> geometry = BareGeometryOf(mesh);
  geometry->setStateSet(StateOfFace(*picture));
  return geometry;
}

osg::ref_ptr<osg::MatrixTransform> MaterialLibrary::PlaceAt(const Eigen::Vector3d& origin_W) {
  return new osg::MatrixTransform(osg::Matrixd::translate(origin_W.x(), origin_W.y(), origin_W.z()));
}

osg::ref_ptr<osg::MatrixTransform> MaterialLibrary::Placed(std::span<const scene::Mesh* const> meshes) {
  RODEIRA_ASSERT(!meshes.empty());
  const Eigen::Vector3d& origin = meshes.front()->origin_W;
  osg::ref_ptr<osg::MatrixTransform> place = PlaceAt(origin);
  for (const scene::Mesh* mesh : meshes) {
    RODEIRA_ASSERT(mesh->origin_W == origin);
    if (!mesh->triangles.empty()) place->addChild(GeometryOf(*mesh));
  }
  return place;
}

osg::ref_ptr<osg::MatrixTransform> MaterialLibrary::Placed(std::span<const scene::Repeated> all) {
  RODEIRA_ASSERT(!all.empty());
  osg::ref_ptr<osg::MatrixTransform> place = PlaceAt(all.front().origin_W);
  if (!repeats_) {
    for (const scene::Mesh& mesh : scene::Merged(all)) place->addChild(GeometryOf(mesh));
    return place;
  }
  for (const scene::Repeated& repeated : all) {
    RODEIRA_ASSERT(repeated.origin_W == all.front().origin_W);
    const osg::ref_ptr<osg::Geometry> geometry = RepeatedGeometry(repeated);
    Spread(*geometry);
    geometry->setNodeMask(ShadowMaskOf(repeated.model.material));
    geometry->setStateSet(StateOfRepeated(repeated.model.material));
    place->addChild(geometry);
  }
  return place;
}

osg::ref_ptr<osg::Node> MaterialLibrary::MakeSky() {
  osg::ref_ptr<osg::Vec3Array> directions = new osg::Vec3Array;
  osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
  const int around = quality_.fine ? 32 : 96,
            up = quality_.fine ? 16 : 64;  // where colours belong to vertices those lie closer
  for (int ring = 0; ring <= up; ++ring) {
    const double height = -0.6 + 2.1707963 * ring / up;  // from below the horizon to the zenith
    for (int k = 0; k < around; ++k) {
      const double angle = 6.283185307179586 * k / around;
      directions->push_back(osg::Vec3(static_cast<float>(std::cos(height) * std::cos(angle)),
                                      static_cast<float>(std::cos(height) * std::sin(angle)),
                                      static_cast<float>(std::sin(height))));
    }
  }
  for (int ring = 0; ring < up; ++ring) {
    for (int k = 0; k < around; ++k) {
      const int a = ring * around + k, b = ring * around + (k + 1) % around;
      for (const int index : {a, b, b + around, a, b + around, a + around})
        triangles->push_back(static_cast<GLushort>(index));
    }
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setVertexArray(directions);
  geometry->addPrimitiveSet(triangles);
  geometry->setCullingActive(false);
  osg::StateSet* state = geometry->getOrCreateStateSet();
  state->setAttributeAndModes(ProgramOf(SkyVertexShader(), SkyFragmentShader()));
  state->setTextureAttribute(0, noise_);
  state->addUniform(new osg::Uniform("noise", 0));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
  state->setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
  state->setRenderBinDetails(kSkyBin, "RenderBin");
  geometry->setNodeMask(kThrowsNone);
  return geometry;
}

osg::ref_ptr<osg::Node> MaterialLibrary::MakeRain() {
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, y] :
       {std::pair(-1.0F, -1.0F), std::pair(1.0F, -1.0F), std::pair(1.0F, 1.0F), std::pair(-1.0F, 1.0F)})
    corners->push_back({x, y, 0.0F});
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setVertexArray(corners);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4));
  geometry->setCullingActive(false);
  osg::StateSet* state = geometry->getOrCreateStateSet();
  state->setAttributeAndModes(ProgramOf(RainVertexShader(), RainFragmentShader()));
  state->setTextureAttribute(0, noise_);
  state->addUniform(new osg::Uniform("noise", 0));
  state->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  state->setRenderBinDetails(kRainBin, "RenderBin");
  return geometry;
}

osg::ref_ptr<osg::Node> MaterialLibrary::MakeShadow(float rear_m, float front_m, float half_width_m) {
  const float grown = 1.28F;
  const float middle = 0.5F * (rear_m + front_m), along = 0.5F * (front_m - rear_m) * 1.12F,
              aside = half_width_m * grown, z = 0.03F;
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec2Array> parts = new osg::Vec2Array;
  for (const auto& [u, v] :
       {std::pair(-1.0F, -1.0F), std::pair(1.0F, -1.0F), std::pair(1.0F, 1.0F), std::pair(-1.0F, 1.0F)}) {
    positions->push_back({middle + u * along, v * aside, z});
    parts->push_back({u, v});
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setVertexArray(positions);
  geometry->setTexCoordArray(0, parts);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4));
  osg::StateSet* state = geometry->getOrCreateStateSet();
  state->setAttributeAndModes(shadow_);
  state->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
  state->setAttributeAndModes(new osg::PolygonOffset(-3.0F, -16.0F));
  state->setMode(GL_POLYGON_OFFSET_FILL, osg::StateAttribute::ON);
  state->setRenderBinDetails(kShadowBin, "RenderBin");
  geometry->setNodeMask(kThrowsNone);
  return geometry;
}

}  // namespace rodeira::nodes
