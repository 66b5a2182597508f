// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/headset/headset_eyes.hpp"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cmath>

namespace rodeira::nodes {
namespace {

constexpr XrDuration kPatience_ns = 5'000'000'000;  // with a picture that the runtime still shows

struct SwapchainImage {  // XrSwapchainImageOpenGLKHR; its header includes the window system's
  XrStructureType type = XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR;
  void* next = nullptr;
  std::uint32_t image = 0;
};

// The one with bytes that mean what ours do (sRGB), else another one of eight bits; 0: none.
std::int64_t FormatOf(XrSession session) {
  std::uint32_t count = 0;
  (void)xrEnumerateSwapchainFormats(session, 0, &count, nullptr);
  std::vector<std::int64_t> offered(count);
  (void)xrEnumerateSwapchainFormats(session, count, &count, offered.data());
  for (const std::int64_t format : {GL_SRGB8_ALPHA8, GL_RGBA8}) {
    if (std::find(offered.begin(), offered.end(), format) != offered.end()) return format;
  }
  return 0;
}

}  // namespace

scene::HeadsetEye EyeOf(const XrPosef& pose, const XrFovf& view) {
  Eigen::Matrix3d seat;  // OpenXR's axes in the seat's
  seat << 0.0, 0.0, -1.0, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  const auto& [x, y, z, w] = pose.orientation;
  const Eigen::Quaterniond turned(static_cast<double>(w), static_cast<double>(x), static_cast<double>(y),
                                  static_cast<double>(z));
  scene::HeadsetEye eye;
  eye.p_SE = seat * Eigen::Vector3f(pose.position.x, pose.position.y, pose.position.z).cast<double>();
  eye.q_SE = Eigen::Quaterniond(Eigen::Matrix3d(seat * turned.normalized().toRotationMatrix() * seat.transpose()));
  const auto edge = [](float angle_rad) { return std::tan(static_cast<double>(angle_rad)); };
  eye.window = {edge(view.angleLeft), edge(view.angleRight), edge(view.angleDown), edge(view.angleUp)};
  return eye;
}

base::Result<std::unique_ptr<HeadsetEyes>> HeadsetEyes::Make(XrInstance instance, XrSystemId system, XrSession session,
                                                             XrSpace space, Quality quality) {
  std::unique_ptr<HeadsetEyes> eyes(new HeadsetEyes(session, space));
  std::array<XrViewConfigurationView, 2> shapes{};
  for (auto& shape : shapes) shape.type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
  std::uint32_t count = 0;
  if (XR_FAILED(xrEnumerateViewConfigurationViews(instance, system, kTwoEyes, 2, &count, shapes.data())) ||
      count != 2) {
    return base::WrongInput("view.no_headset", "the headset has not two eyes; other ones are not drawn for");
  }
  const std::int64_t format = FormatOf(session);
  if (format == 0)
    return base::WrongInput("view.no_headset", "the headset's runtime takes no pictures of eight bits a colour");
  for (std::size_t i = 0; i < 2; ++i) {
    if (auto status = eyes->MakeEye(shapes[i], format, TraitsOf(quality).samples, eyes->eyes_[i]); !status)
      return status.error();
  }
  return eyes;
}

base::Status HeadsetEyes::MakeEye(const XrViewConfigurationView& shape, std::int64_t format, int samples, Eye& eye) {
  auto info = Of<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
  info.format = format;
  info.sampleCount = 1;
  info.width = shape.recommendedImageRectWidth;
  info.height = shape.recommendedImageRectHeight;
  info.faceCount = info.arraySize = info.mipCount = 1;
  std::uint32_t count = 0;
  std::vector<SwapchainImage> images;
  if (XR_SUCCEEDED(xrCreateSwapchain(session_, &info, &eye.chain)) &&
      XR_SUCCEEDED(xrEnumerateSwapchainImages(eye.chain, 0, &count, nullptr))) {
    images.resize(count);
    (void)xrEnumerateSwapchainImages(eye.chain, count, &count,
                                     reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data()));
  }
  for (const SwapchainImage& image : images) eye.textures.push_back(image.image);
  eye.buffer = std::make_unique<EyeBuffer>(static_cast<int>(info.width), static_cast<int>(info.height), samples,
                                           static_cast<unsigned>(format));
  if (eye.textures.empty() || !eye.buffer->whole())
    return base::WrongInput("view.no_headset", "the headset's pictures cannot be made in this OpenGL");
  return {};
}

HeadsetEyes::~HeadsetEyes() {
  for (const Eye& eye : eyes_) {
    if (eye.chain != XR_NULL_HANDLE) xrDestroySwapchain(eye.chain);
  }
}

bool HeadsetEyes::DrawOne(Eye& eye, const scene::HeadsetEye& from, const Headset::DrawEye& draw) {
  std::uint32_t which = 0;
  const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, kPatience_ns};
  if (XR_FAILED(xrAcquireSwapchainImage(eye.chain, nullptr, &which)) ||
      xrWaitSwapchainImage(eye.chain, &wait) != XR_SUCCESS)
    return false;
  draw(from, eye.buffer->target());
  eye.buffer->HandOverInto(eye.textures.at(which));
  return XR_SUCCEEDED(xrReleaseSwapchainImage(eye.chain, nullptr));
}

base::Result<std::optional<HeadsetEyes::Views>> HeadsetEyes::Draw(XrTime time, const Headset::DrawEye& draw) {
  const XrViewLocateInfo when{XR_TYPE_VIEW_LOCATE_INFO, nullptr, kTwoEyes, time, space_};
  auto known = Of<XrViewState>(XR_TYPE_VIEW_STATE);
  std::array<XrView, 2> found{};
  for (auto& view : found) view.type = XR_TYPE_VIEW;
  std::uint32_t count = 0;
  if (XR_FAILED(xrLocateViews(session_, &when, &known, 2, &count, found.data())))
    return base::Failed("view.no_headset", "the headset does not say where its eyes are");
  constexpr XrViewStateFlags kWhole = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
  if (count != 2 || (known.viewStateFlags & kWhole) != kWhole) return std::optional<Views>();
  Views views{};
  for (std::size_t i = 0; i < 2; ++i) {
    Eye& eye = eyes_[i];
    if (!DrawOne(eye, EyeOf(found[i].pose, found[i].fov), draw))
      return base::Failed("view.no_headset", "the headset gives its pictures back no more");
    const PictureTarget& size = eye.buffer->target();
    views[i] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                nullptr,
                found[i].pose,
                found[i].fov,
                {eye.chain, {{0, 0}, {size.width_px, size.height_px}}, 0}};
  }
  return std::optional<Views>(views);
}

}  // namespace rodeira::nodes
