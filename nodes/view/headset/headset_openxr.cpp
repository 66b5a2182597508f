// SPDX-License-Identifier: Apache-2.0
#include <openxr/openxr.h>

#include <array>
#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "nodes/view/headset/headset.hpp"
#include "nodes/view/headset/headset_binding.hpp"
#include "nodes/view/headset/headset_eyes.hpp"

namespace rodeira::nodes {
namespace {

// "xrGetSystem: XR_ERROR_FORM_FACTOR_UNAVAILABLE". `instance` may be null.
std::string Said(XrInstance instance, const char* function, XrResult result) {
  char name[XR_MAX_RESULT_STRING_SIZE] = {};
  if (instance == XR_NULL_HANDLE || XR_FAILED(xrResultToString(instance, result, name)))
    return fmt::format("{}: {}", function, static_cast<int>(result));
  return fmt::format("{}: {}", function, name);
}

base::Result<XrInstance> MakeInstance(const std::vector<const char*>& extensions) {
  std::uint32_t count = 0;
  if (XR_FAILED(xrEnumerateInstanceExtensionProperties(nullptr, 0, &count, nullptr))) {
    return base::WrongInput(
        "view.no_openxr",
        "no OpenXR runtime answers on this PC; one that is running was expected (Monado, SteamVR), named by "
        "XR_RUNTIME_JSON or ~/.config/openxr/1/active_runtime.json");
  }
  std::vector<XrExtensionProperties> offered(count, {XR_TYPE_EXTENSION_PROPERTIES, nullptr, {}, 0});
  (void)xrEnumerateInstanceExtensionProperties(nullptr, count, &count, offered.data());
  for (const char* extension : extensions) {
    bool there = false;
    for (const XrExtensionProperties& one : offered) there = there || std::strcmp(one.extensionName, extension) == 0;
    if (!there)
      return base::WrongInput(
          "view.no_openxr",
          fmt::format("this PC's OpenXR runtime does not offer {}, which the view's OpenGL needs here", extension));
  }
  auto info = Of<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
  std::strncpy(info.applicationInfo.applicationName, "Rodeira", XR_MAX_APPLICATION_NAME_SIZE - 1);
  std::strncpy(info.applicationInfo.engineName, "Rodeira", XR_MAX_ENGINE_NAME_SIZE - 1);
  info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.enabledExtensionNames = extensions.data();
  XrInstance instance = XR_NULL_HANDLE;
  const XrResult made = xrCreateInstance(&info, &instance);
  if (XR_FAILED(made))
    return base::WrongInput("view.no_openxr", fmt::format("this PC's OpenXR runtime does not start ({})",
                                                          Said(XR_NULL_HANDLE, "xrCreateInstance", made)));
  return instance;
}

class OpenXrHeadset final : public Headset {
 public:
  explicit OpenXrHeadset(XrInstance instance) : instance_(instance) {}

  ~OpenXrHeadset() override {
    eyes_.reset();
    if (space_ != XR_NULL_HANDLE) xrDestroySpace(space_);
    if (session_ != XR_NULL_HANDLE) xrDestroySession(session_);
    xrDestroyInstance(instance_);
  }

  base::Status SetUp(const HeadsetBinding& binding, Quality quality) {
    XrSystemGetInfo wanted{XR_TYPE_SYSTEM_GET_INFO, nullptr, XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY};
    XrSystemId system = XR_NULL_SYSTEM_ID;
    if (const XrResult found = xrGetSystem(instance_, &wanted, &system); XR_FAILED(found)) {
      return base::WrongInput(
          "view.no_headset",
          fmt::format(
              "this PC's OpenXR runtime has no headset ({}); one that is plugged in and switched on was expected",
              Said(instance_, "xrGetSystem", found)));
    }
    auto properties = Of<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
    if (XR_SUCCEEDED(xrGetSystemProperties(instance_, system, &properties)))
      name_ = base::Printable(properties.systemName);
    AskWhatOpenGl(system);
    XrSessionCreateInfo session{XR_TYPE_SESSION_CREATE_INFO, binding.structure.get(), 0, system};
    if (auto status = Try("xrCreateSession", xrCreateSession(instance_, &session, &session_)); !status) return status;
    XrReferenceSpaceCreateInfo seat{XR_TYPE_REFERENCE_SPACE_CREATE_INFO,
                                    nullptr,
                                    XR_REFERENCE_SPACE_TYPE_LOCAL,
                                    {{0.0F, 0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 0.0F}}};
    if (auto status = Try("xrCreateReferenceSpace", xrCreateReferenceSpace(session_, &seat, &space_)); !status)
      return status;
    auto eyes = HeadsetEyes::Make(instance_, system, session_, space_, quality);
    if (!eyes) return eyes.error();
    eyes_ = std::move(eyes).value();
    return {};
  }

  const std::string& name() const override { return name_; }
  const std::string& gone() const override { return gone_; }

  bool Begin() override {
    TakeEvents();
    if (!running_ || !gone_.empty()) return false;
    auto wait = Of<XrFrameWaitInfo>(XR_TYPE_FRAME_WAIT_INFO);
    auto begin = Of<XrFrameBeginInfo>(XR_TYPE_FRAME_BEGIN_INFO);
    frame_ = Of<XrFrameState>(XR_TYPE_FRAME_STATE);
    return Holds("xrWaitFrame", xrWaitFrame(session_, &wait, &frame_)) &&
           Holds("xrBeginFrame", xrBeginFrame(session_, &begin));
  }

  void Show(const DrawEye& draw) override {
    auto layer = Of<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
    layer.space = space_;
    std::array<XrCompositionLayerProjectionView, 2> views{};
    bool drawn = false;
    if (frame_.shouldRender == XR_TRUE) {
      auto pictures = eyes_->Draw(frame_.predictedDisplayTime, draw);
      if (!pictures)
        gone_ = pictures.error().message;
      else if ((drawn = pictures.value().has_value()))
        views = *pictures.value();
    }
    layer.viewCount = static_cast<std::uint32_t>(views.size());
    layer.views = views.data();
    const auto* const layers = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
    XrFrameEndInfo end{XR_TYPE_FRAME_END_INFO,           nullptr,         frame_.predictedDisplayTime,
                       XR_ENVIRONMENT_BLEND_MODE_OPAQUE, drawn ? 1U : 0U, &layers};
    (void)Holds("xrEndFrame", xrEndFrame(session_, &end));
  }

 private:
  base::Status Try(const char* function, XrResult result) const {
    if (XR_SUCCEEDED(result)) return {};
    return base::WrongInput("view.no_headset",
                            fmt::format("the headset cannot be used ({})", Said(instance_, function, result)));
  }

  bool Holds(const char* function, XrResult result) {
    if (XR_SUCCEEDED(result)) return true;
    gone_ = fmt::format("the headset shows nothing more ({})", Said(instance_, function, result));
    return false;
  }

  // OpenXR requires this query before a session is made. Any version of OpenGL from 3 on will do.
  void AskWhatOpenGl(XrSystemId system) {
    struct Requirements {  // XrGraphicsRequirementsOpenGLKHR; its header includes the window system's
      XrStructureType type = XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR;
      void* next = nullptr;
      XrVersion least = 0, most = 0;
    } requirements;
    PFN_xrVoidFunction ask = nullptr;
    if (XR_FAILED(xrGetInstanceProcAddr(instance_, "xrGetOpenGLGraphicsRequirementsKHR", &ask)) || ask == nullptr)
      return;
    (void)reinterpret_cast<XrResult(XRAPI_PTR*)(XrInstance, XrSystemId, Requirements*)>(ask)(instance_, system,
                                                                                             &requirements);
  }

  void TakeEvents() {
    auto event = Of<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    while (xrPollEvent(instance_, &event) == XR_SUCCESS) {
      if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) gone_ = "the headset's OpenXR runtime ends";
      if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED)
        TakeState(reinterpret_cast<const XrEventDataSessionStateChanged&>(event).state);
      event = Of<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    }
  }

  void TakeState(XrSessionState state) {
    if (state == XR_SESSION_STATE_READY) {
      XrSessionBeginInfo begin{XR_TYPE_SESSION_BEGIN_INFO, nullptr, kTwoEyes};
      running_ = Holds("xrBeginSession", xrBeginSession(session_, &begin));
    } else if (state == XR_SESSION_STATE_STOPPING) {
      running_ = false;
      (void)xrEndSession(session_);
    } else if (state == XR_SESSION_STATE_EXITING || state == XR_SESSION_STATE_LOSS_PENDING) {
      running_ = false;
      gone_ =
          state == XR_SESSION_STATE_EXITING ? "the headset was asked to show something else" : "the headset is gone";
    }
  }

  XrInstance instance_;
  XrSession session_ = XR_NULL_HANDLE;
  XrSpace space_ = XR_NULL_HANDLE;  // where the head was when it was last set straight: the driver's seat
  std::unique_ptr<HeadsetEyes> eyes_;
  XrFrameState frame_ = Of<XrFrameState>(XR_TYPE_FRAME_STATE);
  bool running_ = false;
  std::string name_ = "a headset";
  std::string gone_;
};

}  // namespace

base::Result<std::unique_ptr<Headset>> Headset::Open(Quality quality) {
  const auto binding = BindingOfCurrentContext();
  if (!binding)
    return base::WrongInput("view.no_headset", "a headset needs OpenGL by GLX or EGL, and this view's is neither");
  auto instance = MakeInstance(binding->extensions);
  if (!instance) return instance.error();
  auto headset = std::make_unique<OpenXrHeadset>(instance.value());
  if (auto status = headset->SetUp(*binding, quality); !status) return status.error();
  return std::unique_ptr<Headset>(std::move(headset));
}

}  // namespace rodeira::nodes
