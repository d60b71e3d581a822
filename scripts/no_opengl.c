/* SPDX-License-Identifier: BSD-3-Clause */
/* The three functions of libGLX.so.0 that Debian's OpenCV links: there is no OpenGL here. With this library in the wheel
   in place of the real one, a machine needs no X11 to import lrrt, which draws nothing through OpenGL. */

void* glXGetCurrentContext(void) { return 0; }

void* glXGetCurrentDisplay(void) { return 0; }

void* glXGetProcAddressARB(const unsigned char* name) {
  (void)name;
  return 0;
}
