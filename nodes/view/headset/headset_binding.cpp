// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/headset/headset_binding.hpp"

// Its macros (None, Status …) stay in this file.
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xutil.h>

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace rodeira::nodes {
namespace {

// For a context that was made of a visual, without a configuration: one with its window's visual. Null: there is
// none.
GLXFBConfig ConfigOfWindow(Display* display, GLXDrawable window) {
  XWindowAttributes window_is;
  if (XGetWindowAttributes(display, window, &window_is) == 0) return nullptr;
  int count = 0;
  GLXFBConfig* configs = glXGetFBConfigs(display, XScreenNumberOfScreen(window_is.screen), &count);
  GLXFBConfig found = nullptr;
  for (int i = 0; i < count && found == nullptr; ++i) {
    int visual = 0;
    if (glXGetFBConfigAttrib(display, configs[i], GLX_VISUAL_ID, &visual) == Success &&
        static_cast<VisualID>(visual) == XVisualIDFromVisual(window_is.visual))
      found = configs[i];
  }
  if (configs != nullptr) XFree(configs);
  return found;
}

GLXFBConfig ConfigOf(Display* display, GLXContext context) {
  int id = -1, count = 0;
  if (glXQueryContext(display, context, GLX_FBCONFIG_ID, &id) != Success || id <= 0)
    return ConfigOfWindow(display, glXGetCurrentDrawable());
  const int wanted[] = {GLX_FBCONFIG_ID, id, 0};
  GLXFBConfig* configs = glXChooseFBConfig(display, DefaultScreen(display), wanted, &count);
  GLXFBConfig found = configs != nullptr && count > 0 ? configs[0] : nullptr;
  if (configs != nullptr) XFree(configs);
  return found;
}

std::optional<HeadsetBinding> BindingByGlx(GLXContext context) {
  Display* display = glXGetCurrentDisplay();
  if (display == nullptr) return std::nullopt;
  GLXFBConfig config = ConfigOf(display, context);
  if (config == nullptr) return std::nullopt;
  auto binding = std::make_shared<XrGraphicsBindingOpenGLXlibKHR>();
  *binding = {XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR, nullptr, display, 0, config, glXGetCurrentDrawable(), context};
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
  if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count != 1)
    config = nullptr;  // contexts without one exist
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

}  // namespace rodeira::nodes
