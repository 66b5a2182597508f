// SPDX-License-Identifier: Apache-2.0
// A small OpenXR runtime without a headset: what the view calls, and what OpenXR's loader asks of a runtime. Two eyes
// of 320 x 240 pixels.
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>

#define XR_USE_GRAPHICS_API_OPENGL
#include <GL/glx.h>
#include <X11/Xutil.h>

#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

#include <cstring>
#include <deque>
#include <string>

#include "tests/nodes/view/headset/fake_headset.hpp"

namespace {

constexpr int kWidth_px = 320, kHeight_px = 240, kImages = 3;

struct Chain {
  GLuint textures[kImages] = {};
  std::uint32_t next = 0, released = 0;
  bool acquired = false;
};

FakeHeadset headset;
Chain chains[2];
int chains_made = 0;
std::deque<XrSessionState> states;
bool running = false, asked_what_open_gl = false, waited = false, begun = false;
XrTime now_ns = 1'000'000'000;

template <class Handle>
Handle HandleOf(std::uintptr_t number) {
  ++headset.living;
  return reinterpret_cast<Handle>(number);
}

XrResult Gone() {
  --headset.living;
  return XR_SUCCESS;
}

XrResult InOrder(bool right) {
  if (!right) ++headset.wrong;
  return right ? XR_SUCCESS : XR_ERROR_CALL_ORDER_INVALID;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateExtensions(const char*, std::uint32_t capacity, std::uint32_t* count,
                                                   XrExtensionProperties* out) {
  const char* names[] = {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME, XR_MNDX_EGL_ENABLE_EXTENSION_NAME};
  *count = headset.egl ? 2 : 1;
  for (std::uint32_t i = 0; i < *count && i < capacity; ++i) {
    std::strncpy(out[i].extensionName, names[i], XR_MAX_EXTENSION_NAME_SIZE - 1);
    out[i].extensionVersion = 1;
  }
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL CreateInstance(const XrInstanceCreateInfo*, XrInstance* out) {
  chains_made = 0;
  states.clear();
  running = asked_what_open_gl = waited = begun = false;
  *out = HandleOf<XrInstance>(1);
  return XR_SUCCESS;
}
XRAPI_ATTR XrResult XRAPI_CALL DestroyInstance(XrInstance) { return Gone(); }

XRAPI_ATTR XrResult XRAPI_CALL ResultToString(XrInstance, XrResult result, char* out) {
  std::strcpy(out, result == XR_ERROR_FORM_FACTOR_UNAVAILABLE ? "XR_ERROR_FORM_FACTOR_UNAVAILABLE"
                   : result == XR_ERROR_SESSION_LOST          ? "XR_ERROR_SESSION_LOST"
                                                              : "XR_ERROR");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetSystem(XrInstance, const XrSystemGetInfo*, XrSystemId* out) {
  *out = 7;
  return headset.plugged_in ? XR_SUCCESS : XR_ERROR_FORM_FACTOR_UNAVAILABLE;
}

XRAPI_ATTR XrResult XRAPI_CALL GetSystemProperties(XrInstance, XrSystemId, XrSystemProperties* out) {
  std::strcpy(out->systemName, "no headset at all");
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL GetRequirements(XrInstance, XrSystemId, XrGraphicsRequirementsOpenGLKHR* out) {
  out->minApiVersionSupported = XR_MAKE_VERSION(3, 0, 0);
  out->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
  asked_what_open_gl = true;
  return XR_SUCCESS;
}

// A runtime makes a context of its own that shares this one's pictures: whether it is told all that it needs. Empty: it
// is.
std::string WhyNotGlx(const XrGraphicsBindingOpenGLXlibKHR& glx) {
  if (glx.xDisplay != glXGetCurrentDisplay() || glx.glxContext != glXGetCurrentContext()) return "another context";
  if (glx.glxDrawable != glXGetCurrentDrawable()) return "another drawable";
  int config = 0, of_context = -1;
  if (glXGetFBConfigAttrib(glx.xDisplay, glx.glxFBConfig, GLX_FBCONFIG_ID, &config) != 0 ||
      glXQueryContext(glx.xDisplay, glx.glxContext, GLX_FBCONFIG_ID, &of_context) != 0)
    return "no configuration";
  if (of_context > 0 && config != of_context)
    return "configuration " + std::to_string(config) + " of a context of " + std::to_string(of_context);
  XVisualInfo* visual = glXGetVisualFromFBConfig(glx.xDisplay, glx.glxFBConfig);
  const unsigned long of_config = visual != nullptr ? visual->visualid : 0;
  if (visual != nullptr) XFree(visual);
  XWindowAttributes window;
  if (XGetWindowAttributes(glx.xDisplay, glx.glxDrawable, &window) == 0) return "no window";
  const unsigned long expected = XVisualIDFromVisual(window.visual);
  if (of_config != expected)
    return "a configuration of visual " + std::to_string(of_config) + " instead of " + std::to_string(expected);
  return expected == glx.visualid
             ? ""
             : "visual " + std::to_string(glx.visualid) + " instead of " + std::to_string(expected);
}

XRAPI_ATTR XrResult XRAPI_CALL CreateSession(XrInstance, const XrSessionCreateInfo* info, XrSession* out) {
  const auto* binding = static_cast<const XrBaseInStructure*>(info->next);
  if (!asked_what_open_gl) return XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING;
  if (binding == nullptr ||
      (binding->type != XR_TYPE_GRAPHICS_BINDING_EGL_MNDX && binding->type != XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR))
    return XR_ERROR_GRAPHICS_DEVICE_INVALID;
  if (binding->type == XR_TYPE_GRAPHICS_BINDING_EGL_MNDX) {
    const auto& egl = *reinterpret_cast<const XrGraphicsBindingEGLMNDX*>(binding);
    if (egl.display != eglGetCurrentDisplay() || egl.context != eglGetCurrentContext() || egl.getProcAddress == nullptr)
      return XR_ERROR_GRAPHICS_DEVICE_INVALID;
  }
  if (binding->type == XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR) {
    headset.refused = WhyNotGlx(*reinterpret_cast<const XrGraphicsBindingOpenGLXlibKHR*>(binding));
    if (!headset.refused.empty()) return XR_ERROR_GRAPHICS_DEVICE_INVALID;
    headset.by_glx = true;
  }
  states = {XR_SESSION_STATE_IDLE, XR_SESSION_STATE_READY};
  *out = HandleOf<XrSession>(2);
  return XR_SUCCESS;
}
XRAPI_ATTR XrResult XRAPI_CALL DestroySession(XrSession) { return Gone(); }

XRAPI_ATTR XrResult XRAPI_CALL BeginSession(XrSession, const XrSessionBeginInfo* info) {
  if (info->primaryViewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
    return XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED;
  running = true;
  for (const auto state : {XR_SESSION_STATE_SYNCHRONIZED, XR_SESSION_STATE_VISIBLE, XR_SESSION_STATE_FOCUSED})
    states.push_back(state);
  return XR_SUCCESS;
}
XRAPI_ATTR XrResult XRAPI_CALL EndSession(XrSession) {
  const XrResult result = InOrder(running);
  running = false;
  states.push_back(XR_SESSION_STATE_IDLE);
  states.push_back(XR_SESSION_STATE_EXITING);
  return result;
}

XRAPI_ATTR XrResult XRAPI_CALL PollEvent(XrInstance, XrEventDataBuffer* out) {
  if (headset.takes_off) states.push_back(XR_SESSION_STATE_STOPPING);
  headset.takes_off = false;
  if (states.empty()) return XR_EVENT_UNAVAILABLE;
  auto& event = reinterpret_cast<XrEventDataSessionStateChanged&>(*out);
  event = {XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED, nullptr, reinterpret_cast<XrSession>(2), states.front(), now_ns};
  states.pop_front();
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL CreateSpace(XrSession, const XrReferenceSpaceCreateInfo* info, XrSpace* out) {
  if (info->referenceSpaceType != XR_REFERENCE_SPACE_TYPE_LOCAL) return XR_ERROR_REFERENCE_SPACE_UNSUPPORTED;
  *out = HandleOf<XrSpace>(3);
  return XR_SUCCESS;
}
XRAPI_ATTR XrResult XRAPI_CALL DestroySpace(XrSpace) { return Gone(); }

XRAPI_ATTR XrResult XRAPI_CALL EnumerateViews(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t capacity,
                                              std::uint32_t* count, XrViewConfigurationView* out) {
  *count = 2;
  for (std::uint32_t i = 0; i < 2 && i < capacity; ++i)
    out[i] = {XR_TYPE_VIEW_CONFIGURATION_VIEW, nullptr, kWidth_px, 4096, kHeight_px, 4096, 1, 4};
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateFormats(XrSession, std::uint32_t capacity, std::uint32_t* count,
                                                std::int64_t* out) {
  const std::int64_t formats[] = {GL_RGBA16F, GL_RGBA8, GL_SRGB8_ALPHA8};
  *count = 3;
  for (std::uint32_t i = 0; i < 3 && i < capacity; ++i) out[i] = formats[i];
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL CreateChain(XrSession, const XrSwapchainCreateInfo* info, XrSwapchain* out) {
  if (chains_made == 2 || info->width != kWidth_px || info->height != kHeight_px || info->format != GL_SRGB8_ALPHA8)
    return XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED;
  Chain& chain = chains[chains_made];
  chain = Chain();
  glGenTextures(kImages, chain.textures);
  for (const GLuint texture : chain.textures) {
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, kWidth_px, kHeight_px);
  }
  glBindTexture(GL_TEXTURE_2D, 0);
  *out = HandleOf<XrSwapchain>(static_cast<std::uintptr_t>(10 + chains_made++));
  return XR_SUCCESS;
}

Chain& ChainOf(XrSwapchain handle) { return chains[reinterpret_cast<std::uintptr_t>(handle) - 10]; }

XRAPI_ATTR XrResult XRAPI_CALL DestroyChain(XrSwapchain handle) {
  glDeleteTextures(kImages, ChainOf(handle).textures);
  return Gone();
}

XRAPI_ATTR XrResult XRAPI_CALL EnumerateImages(XrSwapchain handle, std::uint32_t capacity, std::uint32_t* count,
                                               XrSwapchainImageBaseHeader* out) {
  *count = kImages;
  for (std::uint32_t i = 0; i < kImages && i < capacity; ++i)
    reinterpret_cast<XrSwapchainImageOpenGLKHR*>(out)[i].image = ChainOf(handle).textures[i];
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL AcquireImage(XrSwapchain handle, const XrSwapchainImageAcquireInfo*,
                                            std::uint32_t* out) {
  Chain& chain = ChainOf(handle);
  *out = chain.next;
  const XrResult result = InOrder(!chain.acquired && begun);
  chain.acquired = true;
  return result;
}
XRAPI_ATTR XrResult XRAPI_CALL WaitImage(XrSwapchain handle, const XrSwapchainImageWaitInfo*) {
  return InOrder(ChainOf(handle).acquired);
}
XRAPI_ATTR XrResult XRAPI_CALL ReleaseImage(XrSwapchain handle, const XrSwapchainImageReleaseInfo*) {
  Chain& chain = ChainOf(handle);
  const XrResult result = InOrder(chain.acquired);
  chain.acquired = false;
  chain.released = chain.next;
  chain.next = (chain.next + 1) % kImages;
  return result;
}

XRAPI_ATTR XrResult XRAPI_CALL WaitFrame(XrSession, const XrFrameWaitInfo*, XrFrameState* out) {
  if (headset.loses_frames) return XR_ERROR_SESSION_LOST;
  now_ns += 11'111'111;
  out->predictedDisplayTime = now_ns;
  out->predictedDisplayPeriod = 11'111'111;
  out->shouldRender = XR_TRUE;
  const XrResult result = InOrder(running && !waited);
  waited = true;
  return result;
}
XRAPI_ATTR XrResult XRAPI_CALL BeginFrame(XrSession, const XrFrameBeginInfo*) {
  const XrResult result = InOrder(waited && !begun);
  waited = false;
  begun = true;
  return result;
}

XRAPI_ATTR XrResult XRAPI_CALL LocateViews(XrSession, const XrViewLocateInfo* info, XrViewState* state,
                                           std::uint32_t capacity, std::uint32_t* count, XrView* out) {
  if (info->displayTime != now_ns) ++headset.wrong;
  state->viewStateFlags =
      headset.knows_where ? XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT : 0;
  *count = 2;
  for (std::uint32_t i = 0; i < 2 && i < capacity; ++i) {
    out[i].pose = headset.views[i].pose;
    out[i].fov = headset.views[i].fov;
  }
  return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL EndFrame(XrSession, const XrFrameEndInfo* info) {
  if (info->displayTime != now_ns) ++headset.wrong;
  const XrResult result = InOrder(begun);
  begun = false;
  ++headset.frames;
  headset.layers = static_cast<int>(info->layerCount);
  if (info->layerCount != 1) return result;
  const auto& layer = *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[0]);
  headset.width_px = kWidth_px;
  headset.height_px = kHeight_px;
  for (std::uint32_t i = 0; i < layer.viewCount && i < 2; ++i) {
    const Chain& chain = ChainOf(layer.views[i].subImage.swapchain);
    if (chain.acquired) ++headset.wrong;
    headset.said[i].pose = layer.views[i].pose;
    headset.said[i].fov = layer.views[i].fov;
    headset.rgba[i].resize(4U * kWidth_px * kHeight_px);
    glBindTexture(GL_TEXTURE_2D, chain.textures[chain.released]);
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, headset.rgba[i].data());
    glBindTexture(GL_TEXTURE_2D, 0);
  }
  return result;
}

XRAPI_ATTR XrResult XRAPI_CALL GetProcAddr(XrInstance, const char* name, PFN_xrVoidFunction* out) {
  const std::pair<const char*, PFN_xrVoidFunction> all[] = {
#define FAKE(NAME, FUNCTION) {NAME, reinterpret_cast<PFN_xrVoidFunction>(&FUNCTION)}
      FAKE("xrGetInstanceProcAddr", GetProcAddr),
      FAKE("xrEnumerateInstanceExtensionProperties", EnumerateExtensions),
      FAKE("xrCreateInstance", CreateInstance),
      FAKE("xrDestroyInstance", DestroyInstance),
      FAKE("xrResultToString", ResultToString),
      FAKE("xrGetSystem", GetSystem),
      FAKE("xrGetSystemProperties", GetSystemProperties),
      FAKE("xrGetOpenGLGraphicsRequirementsKHR", GetRequirements),
      FAKE("xrCreateSession", CreateSession),
      FAKE("xrDestroySession", DestroySession),
      FAKE("xrBeginSession", BeginSession),
      FAKE("xrEndSession", EndSession),
      FAKE("xrPollEvent", PollEvent),
      FAKE("xrCreateReferenceSpace", CreateSpace),
      FAKE("xrDestroySpace", DestroySpace),
      FAKE("xrEnumerateViewConfigurationViews", EnumerateViews),
      FAKE("xrEnumerateSwapchainFormats", EnumerateFormats),
      FAKE("xrCreateSwapchain", CreateChain),
      FAKE("xrDestroySwapchain", DestroyChain),
      FAKE("xrEnumerateSwapchainImages", EnumerateImages),
      FAKE("xrAcquireSwapchainImage", AcquireImage),
      FAKE("xrWaitSwapchainImage", WaitImage),
      FAKE("xrReleaseSwapchainImage", ReleaseImage),
      FAKE("xrWaitFrame", WaitFrame),
      FAKE("xrBeginFrame", BeginFrame),
      FAKE("xrLocateViews", LocateViews),
      FAKE("xrEndFrame", EndFrame),
#undef FAKE
  };
  for (const auto& [known, function] : all) {
    if (std::strcmp(name, known) != 0) continue;
    *out = function;
    return XR_SUCCESS;
  }
  *out = nullptr;
  return XR_ERROR_FUNCTION_UNSUPPORTED;
}

// What OpenXR's loader and a runtime say to each other first (its specification's "runtime interface negotiation").
struct LoaderInfo {
  int type;  // 1
  std::uint32_t version;
  std::size_t size;
  std::uint32_t least_interface, most_interface;
  XrVersion least_api, most_api;
};
struct RuntimeRequest {
  int type;  // 3
  std::uint32_t version;
  std::size_t size;
  std::uint32_t interface;
  XrVersion api;
  PFN_xrGetInstanceProcAddr get_proc_addr;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) XrResult xrNegotiateLoaderRuntimeInterface(const LoaderInfo* loader,
                                                                                             RuntimeRequest* runtime) {
  if (loader->type != 1 || runtime->type != 3) return XR_ERROR_INITIALIZATION_FAILED;
  runtime->interface = 1;
  runtime->api = XR_CURRENT_API_VERSION;
  runtime->get_proc_addr = GetProcAddr;
  return XR_SUCCESS;
}

extern "C" __attribute__((visibility("default"))) FakeHeadset* rodeira_fake_headset() { return &headset; }
