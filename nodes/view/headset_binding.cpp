#include "nodes/view/headset_binding.hpp"

// Its macros (None, Status …) stay in this file.
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glx.h>

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace rodeira::view {
namespace {

std::optional<HeadsetBinding> BindingByGlx(GLXContext context) {
  Display* display = glXGetCurrentDisplay();
  int id = 0, count = 0;
  if (display == nullptr || glXQueryContext(display, context, GLX_FBCONFIG_ID, &id) != Success) return std::nullopt;
  const int wanted[] = {GLX_FBCONFIG_ID, id, 0};
  GLXFBConfig* configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
  if (configs == nullptr) return std::nullopt;
  auto binding = std::make_shared<XrGraphicsBindingOpenGLXlibKHR>();
  *binding = {XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR, nullptr, display, 0, configs[0], glXGetCurrentDrawable(), context};
  XFree(configs);
  if (XVisualInfo* visual = glXGetVisualFromFBConfig(display, binding->glxFBConfig)) {
    binding->visualid = static_cast<std::uint32_t>(visual->visualid);
    XFree(visual);
  }
  return HeadsetBinding{{XR_KHR_OPENGL_ENABLE_EXTENSION_NAME}, binding};
}

std::optional<HeadsetBinding> BindingByEgl(EGLContext context) {
  const EGLDisplay display = eglGetCurrentDisplay();
  EGLint id = 0, count = 0;
  EGLConfig config = nullptr;
  if (eglQueryContext(display, context, EGL_CONFIG_ID, &id) != EGL_TRUE) return std::nullopt;
  const EGLint wanted[] = {EGL_CONFIG_ID, id, EGL_NONE};
  if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count != 1) config = nullptr;  // contexts without one exist
  auto binding = std::make_shared<XrGraphicsBindingEGLMNDX>();
  *binding = {XR_TYPE_GRAPHICS_BINDING_EGL_MNDX, nullptr, eglGetProcAddress, display, config, context};
  return HeadsetBinding{{XR_KHR_OPENGL_ENABLE_EXTENSION_NAME, XR_MNDX_EGL_ENABLE_EXTENSION_NAME}, binding};
}

}  // namespace

std::optional<HeadsetBinding> BindingOfCurrentContext() {
  if (GLXContext context = glXGetCurrentContext()) return BindingByGlx(context);
  if (EGLContext context = eglGetCurrentContext()) return BindingByEgl(context);
  return std::nullopt;
}

}  // namespace rodeira::view
